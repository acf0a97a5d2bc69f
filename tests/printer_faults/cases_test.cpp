// Every fault of the printer, begun by the control channel and by the command line's spec, with the board and
// the touch screen of both printers: frames, state and page as they should be, then mended; and the board
// goes on.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "emulator/fault/kind.h"
#include "tests/printer_faults/cases.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

enum class How { control, command_line };

/// The first of `wanted` that is not said, in that order; "" when all are.
std::string missing(const std::vector<std::string>& said, const std::vector<std::string>& wanted,
                    std::string_view silent) {
    auto at = said.begin();
    for (const std::string& start : wanted) {
        if (start == silent) {
            continue;
        }
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

void check(const FaultCase& c, How how, bool a30) {
    const std::string title(c.title);
    CAPTURE(title);
    CAPTURE(static_cast<int>(how));
    CAPTURE(a30);
    const std::string name = a30 ? "geeetech-a30" : "geeetech-a30t";
    Rig rig(name, name, how == How::control ? std::vector<std::string>{} : std::vector{timed(c)});
    begin(rig, c, how);

    const std::string_view silent = a30 ? c.a30_silent : "";
    const auto said = rig.said_since(fault_at_s);
    CAPTURE(join(said));
    CHECK(missing(said, c.said, silent) == "");
    for (const std::string& start : c.not_said) {
        CHECK(std::none_of(said.begin(), said.end(),
                           [&](const std::string& body) { return body.starts_with(start); }));
    }
    const int page = (a30 && c.a30_page ? c.a30_page : c.page).value_or(-1);
    CHECK(rig.exception_page().value_or(-1) == page);
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
    CHECK(missing(after, c.said_back, silent) == "");
    CHECK(rig.number("faults." + std::string(c.kind())) == 0);
    check_fields(rig, c.state_back);
    CHECK(rig.answers());
    CHECK(rig.crashes() == "");
}

}  // namespace

TEST_CASE("faults of the printer, by the control channel") {
    for (const FaultCase& c : fault_cases()) {
        check(c, How::control, false);
    }
}

TEST_CASE("faults of the printer, by the command line's spec with its time") {
    for (const FaultCase& c : fault_cases()) {
        check(c, How::command_line, false);
    }
}

TEST_CASE("faults of the printer, with the other board and its screen, which none of them crashes") {
    for (const FaultCase& c : fault_cases()) {
        check(c, How::control, true);
    }
}

TEST_CASE("every fault of the table has a case, and no case is of another") {
    std::set<std::string_view> tried;
    for (const FaultCase& c : fault_cases()) {
        CHECK(machine::find_fault(c.kind()) != nullptr);
        tried.insert(c.kind());
    }
    for (const machine::FaultInfo* row : machine::fault_rows()) {
        const machine::FaultInfo& info = *row;
        CAPTURE(std::string(info.name));
        CHECK(tried.contains(info.name));
    }
}
