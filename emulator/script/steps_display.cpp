// Steps at the screen that is part of a board, or at a virtual one: touches by pixel and by name, pictures.

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "emulator/script/compiler.h"

namespace fauxboard::script::rows {
namespace {

using behaviour::found;
using behaviour::ObjectReader;

constexpr SimTime usual_touch{120'000};
constexpr SimTime shortest_touch{1'000};
constexpr SimTime longest_touch = std::chrono::minutes(10);
constexpr int most_pixels = 4096;

bool is_pixel(const Json& value) {
    return value.is_array() && value.size() == 2 && value[0].is_number_integer() &&
           value[1].is_number_integer();
}

int pixel(const Json& number) {
    return static_cast<int>(std::clamp<std::int64_t>(number.get<std::int64_t>(), -1, most_pixels));
}

void compile_touch(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("touch");
    out.lasts = usual_touch;
    if (const Json* lasts = reader.get("for")) {
        out.lasts = c.time(*lasts, reader.pointer("for"), shortest_touch, longest_touch);
    }
    if (value.is_string()) {
        out.text = value.get<std::string>();
        out.words = fmt::format("touch \"{}\"", out.text);
    } else if (is_pixel(value)) {
        out.x = pixel(value[0]);
        out.y = pixel(value[1]);
        out.words = fmt::format("touch {}, {}", out.x, out.y);
    } else {
        c.findings().add(at, found(value) + "; expected the name of a control, or a pixel: [240, 160]");
        return;
    }
    c.needs_screen(at, "touch");
}

std::string run_touch(Acting& acting, const Step& step) {
    control::Display* display = acting.stage.display();
    if (display == nullptr) {
        return "the board of this run has no screen to touch";
    }
    std::string why;
    acting.stage.visit([&](board::Board& board, SimTime now) {
        board.refresh(now);
        why = step.text.empty() ? display->touch(now, step.x, step.y, step.lasts).why
                                : display->touch(now, step.text, step.lasts).why;
    });
    return why;
}

void compile_screenshot(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("screenshot");
    const std::string file = value.is_string() ? value.get<std::string>() : "";
    // It is kept beside what else the run writes, nowhere else.
    if (!file.ends_with(".png") || file.size() > 100 || file.front() == '.' ||
        file.find('/') != std::string::npos) {
        c.findings().add(at,
                         found(value) + "; expected the name of a picture without a folder: \"main.png\"");
        return;
    }
    out.text = file;
    out.words = fmt::format("screenshot \"{}\"", file);
    c.needs_screen(at, "screenshot");
}

std::string run_screenshot(Acting& acting, const Step& step) {
    control::Display* display = acting.stage.display();
    if (display == nullptr) {
        return "the board of this run has no screen to take a picture of";
    }
    std::string png;
    acting.stage.visit([&](board::Board& board, SimTime now) {
        board.refresh(now);
        png = display->png(now);
    });
    return acting.stage.keep_picture(step.text, png);
}

constexpr std::array touch_keys{KeyInfo{"for", "time", "how long the finger stays; left out: 120ms"}};

constexpr std::array display_table{
    StepKind{"touch", "control, or [x, y]",
             "a finger is put on the board's screen, at a control of the page that is open or at a pixel; "
             "touches follow one another",
             R"j({"touch": "Stop", "for": "120ms"})j", touch_keys, Role::act, compile_touch, run_touch},
    StepKind{"screenshot",
             "file",
             "keeps a picture of the board's screen in the folder that the run is started in",
             R"j({"screenshot": "printing.png"})j",
             {},
             Role::act,
             compile_screenshot,
             run_screenshot},
};

}  // namespace

std::span<const StepKind> display_steps() {
    return display_table;
}

}  // namespace fauxboard::script::rows
