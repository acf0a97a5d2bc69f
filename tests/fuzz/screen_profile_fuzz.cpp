// A screen profile's text: it loads, or it is refused with sentences. What loads must run.

#include <algorithm>
#include <array>
#include <string>

#include "emulator/screen/screen.h"
#include "protocol/framing.h"
#include "tests/fuzz/screen_support.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using machine::SimTime;

constexpr std::array<std::string_view, 8> said{
    "L1 X1 Y2 Z3 F4",       "L3 PS:0 VL:0 MT:1 FT:0 AL:1 ST:1 WF:1 FN:a PG:1 TM:1 LA:1 LC:1",
    "L7 begin file list:0", "L7 P0 a.gcode",
    "L18 P26 S1",           "L21 P0 S0",
    "L24 P0 A1 B2 C3 D4",   "L9 DN:a;DM:b;SN:c;FV:d;PV:e;HV:f;"};

void check_problems(const behaviour::ProfileError& error) {
    require(!error.problems().empty(), "a profile is refused without a word");
    for (const behaviour::Problem& problem : error.problems()) {
        require(!problem.message.empty(), "a problem without a message");
        require(!problem.file.empty(), "a problem that does not name its file");
    }
}

void run(const std::shared_ptr<const screen::ScreenProfile>& profile) {
    screen::Screen screen(profile);
    SimTime now{0};
    const auto pass = [&](SimTime time) {
        now += time;
        for (int i = 0; i < 1000 && (screen.advance(now) <= now || !screen.output().empty()); ++i) {
            screen.clear_output();
        }
    };
    screen.power_on(now);
    pass(std::chrono::seconds(61));
    for (const std::string_view line : said) {
        screen.receive(now, protocol::frame(line));
        pass(std::chrono::seconds(1));
    }
    for (const screen::Button& button : profile->buttons) {
        screen.press(button.path, now);
        pass(SimTime{100'000});
    }
    for (const screen::Page& page : profile->pages) {
        require(!screen.show(page.path).empty(), "a page that cannot be shown");
    }
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard;
    const behaviour::SourceText source{"fuzzed.json",
                                       std::string(data, data + std::min<std::size_t>(size, 16384))};
    try {
        fuzz::run(screen::load_screen(source, fuzz::screen_finder()));
    } catch (const behaviour::ProfileError& error) {
        fuzz::check_problems(error);
    }
    return 0;
}
