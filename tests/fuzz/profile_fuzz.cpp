// A profile's text: it loads, or it is refused with sentences. What loads must run.

#include <algorithm>
#include <array>
#include <string>

#include "protocol/framing.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using machine::SimTime;

constexpr std::array<std::string_view, 12> requests{"log hello", "M2134 FW:V1.02.xx", "M115",        "M105",
                                                    "M104 S200", "M20 LCD",           "M2139",       "M500",
                                                    "G28",       "M290 Z0.01",        "M2140 S5 R1", "X"};

void check_problems(const behaviour::ProfileError& error) {
    require(!error.problems().empty(), "a profile is refused without a word");
    for (const behaviour::Problem& problem : error.problems()) {
        require(!problem.message.empty(), "a problem without a message");
        require(!problem.file.empty(), "a problem that does not name its file");
    }
}

void run(const std::shared_ptr<const behaviour::Profile>& profile, bool pacing) {
    board::Board board(profile, {}, {pacing, 7, nullptr});
    const auto take = [&](SimTime, std::string_view bytes) { check_output(bytes, false); };
    constexpr std::size_t stops = 2000;
    board.power_on(SimTime{0});
    SimTime now{0};
    for (const std::string_view request : requests) {
        board.receive(now, protocol::frame(request));
        board.receive(now, std::string(request) + "\n", board::Channel::host);
        check_output(board.output(), false);
        board.clear_output();
        now += std::chrono::seconds(1);
        advance_to(board, now, stops, take);
    }
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard;
    const behaviour::SourceText source{"fuzzed.json",
                                       std::string(data, data + std::min<std::size_t>(size, 16384))};
    try {
        const auto profile = behaviour::load_profile(source, fuzz::shipped_finder());
        fuzz::run(profile, true);
        fuzz::run(profile, false);
    } catch (const behaviour::ProfileError& error) {
        fuzz::check_problems(error);
    }
    return 0;
}
