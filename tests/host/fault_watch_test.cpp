#include "emulator/host/fault_watch.h"

#include <doctest/doctest.h>

#include "emulator/fault/printer_fault.h"
#include "emulator/host/profile_files.h"
#include "tests/support/loose_faults.h"

namespace fauxboard::host {
namespace {

using fault::fault_from_text;
using namespace std::chrono_literals;

TEST_CASE("faults of line and printer are told when they begin and when they are over, once") {
    board::Board board(load_profile_by_name("geeetech-a30t"), {}, {});
    board.power_on(0s);
    testing::LooseFaults lines;
    std::vector<std::string> said;
    FaultWatch* self = nullptr;
    FaultWatch watch(board, lines, [&](const std::string& sentence) {
        said.push_back(sentence);
        self->on_notice(0s, board::Level::info, sentence);  // it is one of those that are told
    });
    self = &watch;
    const auto news = [&] {
        watch.look();
        return std::exchange(said, {});
    };
    CHECK(news().empty());
    const auto id = lines.add(fault_from_text("drop:to_screen,every=2"));
    CHECK(news() == std::vector<std::string>{"fault 1, drop:to_screen,every=2, is on the line"});
    CHECK(news().empty());
    board.machine().faults.add(0s, fault::to_request(fault_from_text("jam:at=10s,for=5s")));
    const auto pass = [&](SimTime end) {
        while (board.advance(end) <= end) {
            board.clear_output();
        }
        board.clear_output();
    };
    pass(9s);
    CHECK(news().empty());
    pass(11s);
    const auto begun = news();
    REQUIRE(begun.size() == 1);
    CHECK(begun[0].starts_with("fault p1, jam:"));
    CHECK(begun[0].ends_with(", begins"));
    lines.remove(id);
    CHECK(news() == std::vector<std::string>{"fault 1, drop:to_screen,every=2, is off the line"});
    pass(16s);
    const auto over = news();
    REQUIRE(over.size() == 1);
    CHECK(over[0].ends_with(", is over"));
    CHECK(news().empty());
}

TEST_CASE("it asks to be called when a fault of the printer begins or ends") {
    board::Board board(load_profile_by_name("geeetech-a30t"), {}, {});
    board.power_on(0s);
    const testing::LooseFaults lines;
    std::vector<std::string> said;
    std::vector<board::SimTime> asked;
    FaultWatch watch(
        board, lines, [&](const std::string& sentence) { said.push_back(sentence); },
        [&](board::SimTime when) { asked.push_back(when); });
    watch.look();
    CHECK(asked.empty());  // a board without faults pays nothing
    board.machine().faults.add(0s, fault::to_request(fault_from_text("jam:at=10s,for=5s")));
    for (const auto expected : {board::SimTime(10s), board::SimTime(15s), machine::never}) {
        watch.look();
        REQUIRE_FALSE(asked.empty());
        CHECK(asked.back() == expected);
        if (expected != machine::never) {
            board.refresh(expected);
            board.clear_output();
        }
    }
    REQUIRE(said.size() == 2);
    CHECK(said[1].ends_with(", is over"));
}

}  // namespace
}  // namespace fauxboard::host
