// Arbitrary touches of the MKS DLP board's screen.
//
// Each five bytes of the input are a touch: x and y, in 2 pixels each, how long it lasts (0.1 s), how long
// nobody touches it afterwards (0.2 s), and what happens then (see happen()). The first byte chooses the
// program.

#include <array>
#include <memory>
#include <string>

#include "emulator/fault/kind.h"
#include "emulator/fault/printer_fault.h"
#include "emulator/fault/spec.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/machine/memory_volume.h"
#include "emulator/screen/scene.h"
#include "emulator/sliced/sample.h"
#include "emulator/touch/touch_screen.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using machine::SimTime;

struct Kit {
    std::shared_ptr<const behaviour::Profile> profile;
    std::shared_ptr<const screen::ScreenProfile> screen;
};
const Kit& kit_of(bool later) {
    static std::array<Kit, 2> kits;
    Kit& kit = kits[later ? 1 : 0];
    if (!kit.profile) {
        kit.profile = host::load_profile_by_name(later ? "mks-dlp-0.08" : "mks-dlp");
        kit.screen = host::load_own_screen(kit.profile->screen);
    }
    return kit;
}

/// Something to print, settings right and wrong, and what is none of these.
void fill(machine::MemoryVolume& stick) {
    sliced::Sample wishes;
    wishes.layers = 2;
    wishes.width = 1440;
    wishes.height = 2560;
    static const std::string sample = sliced::make_sample(wishes);
    const auto add = [&](std::string_view name, std::string_view bytes) {
        require(stick.create(name) && stick.append(name, 0, bytes), "the stick is full");
    };
    add("a.cbddlp", sample);
    add("b.photon", "no picture");
    add("c.acfg", "[ZMotor]\nmax_pos = 90\n");
    add("d.acfg", "[ZMotor]\nfoo = 1\n");
}

class Play {
  public:
    explicit Play(const Kit& kit) : screen_(kit.screen) {
        fill(stick_);
        machine::Services services;
        services.udisk = &stick_;
        board::Options options;
        options.front = &screen_;
        board_ = std::make_unique<board::Board>(kit.profile, services, options);
        board_->power_on(now_);
        run(SimTime{2'500'000});
    }

    void touch(int x, int y, SimTime how_long) {
        const auto touched = screen_.touch(now_, x, y, how_long);
        if (touched.why.empty()) {
            require(touched.done >= now_ && touched.done <= now_ + how_long + SimTime{1'000'000},
                    "a touch that never ends");
            run(touched.done - now_);
        }
        look();
    }
    void run(SimTime by) {
        const SimTime end = now_ + by;
        while (now_ < end) {
            const SimTime next = board_->advance(end);
            require(board_->time() >= now_, "time goes back");
            now_ = std::max(now_, std::min(next, end));
        }
    }
    /// What a person does beside touching it.
    void happen(unsigned what) {
        constexpr std::array<std::string_view, 4> done{"stick_errors:for=5s",
                                                       "switch_open:switch=lower,for=60s", "board_reset",
                                                       "panel_crc:share=2,for=30s"};
        if (what < done.size()) {
            board_->tinker(now_, [&](machine::Machine& machine) {
                machine.faults.add(now_, fault::to_request(fault::fault_from_text(done[what])));
            });
        }
    }
    void look() {
        const screen::Scene scene = screen_.scene(board_->machine());
        require(!scene.page.empty(), "no page");
        for (const screen::SceneControl& control : scene.controls) {
            require(control.at.width >= 0 && control.at.height >= 0 && control.at.x >= 0 &&
                        control.at.y >= 0 && control.at.x + control.at.width <= scene.width &&
                        control.at.y + control.at.height <= scene.height,
                    "a control beyond the glass");
        }
        require(scene.texts.size() < 200, "texts without end");
        require(number("watch.lit_moving") == 0, "the lamp shines while the platform moves");
        require(number("watch.into_model") == 0, "the platform goes into the model");
    }

  private:
    double number(std::string_view path) const {
        return behaviour::find_field(path)->get(board_->machine()).number;
    }

    machine::MemoryVolume stick_;
    touch::TouchScreen screen_;
    std::unique_ptr<board::Board> board_;
    SimTime now_{0};
};

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard::fuzz;
    constexpr std::size_t most_touches = 60;
    constexpr std::size_t bytes_of_one = 5;
    Play play(kit_of(size != 0 && (data[0] & 1) != 0));
    for (std::size_t i = 0, at = 1; i < most_touches && at + bytes_of_one <= size; ++i, at += bytes_of_one) {
        play.touch(data[at] * 2, data[at + 1] * 2, SimTime{(data[at + 2] % 40U) * 100'000});
        play.run(SimTime{data[at + 3] * 200'000});
        play.happen(data[at + 4]);
    }
    // Left alone, it comes to rest, and can be touched again.
    play.run(SimTime{600'000'000});
    play.touch(240, 160, SimTime{120'000});
    return 0;
}
