// Every fault of the printer, begun by the control channel and by the command line's spec, with the board and
// the touch screen of both printers: frames, state and page as they should be, then mended; and the board
// goes on.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "emulator/fault/kind.h"
#include "tests/printer_faults/cases.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

enum class How { control, command_line };

/// The exception page that each opens on the A30's screen. Its board says less than the A30T's: it has no
/// detector for a jam, a text instead of a page for a dead end stop and for the probe, and no pages for what
/// was refused.
constexpr int no_page = -1;
constexpr std::pair<std::string_view, int> a30_pages[] = {
    {"a network that nobody uses", no_page},
    {"filament out, idle", no_page},
    {"filament out, printing", 0},
    {"jam: the board notices nothing", no_page},
    {"card removed, idle", 8},
    {"card removed, printing", 8},
    {"card broken, printing", 8},
    {"file missing, when it is selected", no_page},
    {"file missing, printing", no_page},
    {"file unreadable, when it is selected", no_page},
    {"file unreadable, printing", no_page},
    {"open thermistor, off: nothing to notice", no_page},
    {"open thermistor, heated", 2},
    {"open thermistor of the bed, printing", 5},
    {"shorted thermistor, off", 2},
    {"shorted thermistor of the bed", 3},
    {"shorted thermistor, a host prints", 2},
    {"shorted thermistor of the bed, a host prints", 3},
    {"dead heater, heating up", 2},
    {"dead heater, printing", no_page},  // any change counts: opens 4 when it has nearly cooled down
    {"dead bed, held", 3},
    {"runaway, printing", no_page},
    {"runaway of the bed", no_page},
    {"nozzle too hot: off, and still heating", 2},
    {"nozzle too hot, printing", 4},
    {"bed too hot", 3},
    {"3D Touch alarm", no_page},
    {"3D Touch alarm, homing", no_page},
    {"end stop of X never triggers", no_page},
    {"probe never triggers", no_page},
    {"cold extrusion, loading", no_page},
    {"cold extrusion, load pressed", no_page},
    {"motors off: homing is lost and cannot be done", no_page},
    {"motors off, printing: the board prints on", no_page},
    {"refused, when a file is selected", no_page},
    {"refused, when a file is started", no_page},
    {"end the tuning?", no_page},
    {"wait for user, idle", no_page},
    {"wait for user, printing", no_page},
    {"hang, printing: neither heard nor said anything", no_page},
    {"hang with a watchdog", no_page},
    {"reset, printing", no_page},
    {"brown-out, idle", no_page},
    {"brown-out, printing: the job is offered again", no_page},
};

/// The first of `wanted` that is not said, in that order; "" when all are.
std::string missing(const std::vector<std::string>& said, const std::vector<std::string>& wanted) {
    auto at = said.begin();
    for (const std::string& start : wanted) {
        at = std::find_if(at, said.end(), [&](const std::string& body) { return body.starts_with(start); });
        if (at == said.end()) {
            return start;
        }
        ++at;
    }
    return "";
}

void check_fields(Rig& rig, const Fields& fields) {
    for (const auto& field : fields) {
        CAPTURE(std::string(field.first));
        CHECK(rig.number(field.first) == field.second);
    }
}

std::string timed(const FaultCase& c) {
    return c.spec + (c.spec.find(':') == std::string::npos ? ":" : ",") +
           "at=" + std::to_string(static_cast<int>(fault_at_s)) + "s";
}

void begin(Rig& rig, const FaultCase& c, How how) {
    rig.run_until(5);
    if (c.before != nullptr) {
        c.before(rig);
    }
    REQUIRE(rig.now() < fault_at_s - 0.5);
    rig.run_until(fault_at_s - 0.01);
    CHECK(rig.number("faults." + std::string(c.kind())) == 0);
    rig.run_until(fault_at_s);
    if (how == How::control) {
        rig.add_fault(c.spec);
    }
    if (c.during != nullptr) {
        c.during(rig);
    } else {
        rig.run_for(3);
    }
}

void check(const FaultCase& c, How how) {
    const std::string title(c.title);
    CAPTURE(title);
    CAPTURE(static_cast<int>(how));
    Rig rig("geeetech-a30t", "geeetech-a30t",
            how == How::control ? std::vector<std::string>{} : std::vector{timed(c)});
    begin(rig, c, how);

    const auto said = rig.said_since(fault_at_s);
    CAPTURE(join(said));
    CHECK(missing(said, c.said) == "");
    for (const std::string& start : c.not_said) {
        CHECK(std::none_of(said.begin(), said.end(),
                           [&](const std::string& body) { return body.starts_with(start); }));
    }
    CHECK(rig.exception_page().value_or(-1) == c.page.value_or(-1));
    check_fields(rig, c.state);

    const double from = rig.now();
    if (c.back != nullptr) {
        c.back(rig);
    } else {
        rig.do_it({{"op", "faults.clear"}});
        rig.run_for(3);
    }
    const auto after = rig.said_since(from);
    CAPTURE(join(after));
    CHECK(missing(after, c.said_back) == "");
    CHECK(rig.number("faults." + std::string(c.kind())) == 0);
    check_fields(rig, c.state_back);
    CHECK(rig.answers());
    CHECK(rig.crashes() == "");
}

}  // namespace

TEST_CASE("faults of the printer, by the control channel") {
    for (const FaultCase& c : fault_cases()) {
        check(c, How::control);
    }
}

TEST_CASE("faults of the printer, by the command line's spec with its time") {
    for (const FaultCase& c : fault_cases()) {
        check(c, How::command_line);
    }
}

TEST_CASE(
    "faults of the printer, with the A30's board and its screen: the page that each opens, and no crash") {
    std::map<std::string_view, int> pages;
    for (const auto& [title, page] : a30_pages) {
        pages.emplace(title, page);
    }
    for (const FaultCase& c : fault_cases()) {
        const std::string title(c.title);
        CAPTURE(title);
        Rig rig("geeetech-a30", "geeetech-a30", {});
        begin(rig, c, How::control);
        CAPTURE(join(rig.said_since(fault_at_s)));
        const auto page = pages.find(c.title);
        CHECK(page != pages.end());
        CHECK(rig.exception_page().value_or(no_page) == (page != pages.end() ? page->second : no_page));
        rig.do_it({{"op", "faults.clear"}});
        rig.run_for(120);
        CHECK(rig.answers());
        CHECK(rig.crashes() == "");
    }
}

TEST_CASE("every fault that a printer with a nozzle can have has a case, and no case is of another") {
    const machine::Kind& kind = Rig("geeetech-a30t", "geeetech-a30t").machine().kind();
    std::set<std::string_view> tried;
    for (const FaultCase& c : fault_cases()) {
        const machine::FaultInfo* const info = machine::find_fault(c.kind());
        REQUIRE(info != nullptr);
        CHECK(machine::has_fault(kind, *info));
        tried.insert(c.kind());
    }
    for (const machine::FaultInfo* row : machine::fault_rows()) {
        const machine::FaultInfo& info = *row;
        CAPTURE(std::string(info.name));
        CHECK(tried.contains(info.name) == machine::has_fault(kind, info));
    }
}
