#include "emulator/host/line_faults.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/support/loose_faults.h"

namespace fauxboard::host {
namespace {

using fault::fault_from_text;
using fault::fault_to_text;

TEST_CASE("faults of two lines under one numbering, each on the line that it names") {
    testing::LooseFaults main;
    testing::LooseFaults usb;
    LineFaults all(main, &usb);
    CHECK(all.add(fault_from_text("drop:every=2")) == 1);
    CHECK(all.add(fault_from_text("garble:line=usb")) == 2);
    CHECK(all.add(fault_from_text("silence:at=1s")) == 3);
    REQUIRE(all.list().size() == 3);
    CHECK(all.list()[1].id == 2);
    CHECK(fault_to_text(all.list()[1].spec) == "garble:line=usb");
    CHECK(main.list().size() == 2);
    CHECK(usb.list().size() == 1);
    CHECK(all.change(1, fault_from_text("drop:line=usb,every=3")));
    CHECK(main.list().size() == 1);
    CHECK(usb.list().size() == 2);
    CHECK(all.list()[0].id == 1);
    CHECK(all.change(2, fault_from_text("cut:line=usb")));
    CHECK(fault_to_text(all.list()[1].spec) == "cut:line=usb");
    CHECK_FALSE(all.change(9, fault_from_text("cut")));
    CHECK(all.remove(1));
    CHECK_FALSE(all.remove(1));
    CHECK(usb.list().size() == 1);
    all.clear();
    CHECK(all.list().empty());
    CHECK(main.list().empty());
    CHECK(usb.list().empty());
}

TEST_CASE("on a board with the USB side alone a fault that names no line is for that") {
    testing::LooseFaults main;
    testing::LooseFaults usb;
    LineFaults all(main, &usb, false);
    all.add(fault_from_text("drop:every=2"));
    CHECK(main.list().empty());
    REQUIRE(usb.list().size() == 1);
    CHECK(fault_to_text(all.list()[0].spec) == "drop:line=usb,every=2");
    CHECK(all.change(1, fault_from_text("drop:every=3")));
    CHECK(fault_to_text(all.list()[0].spec) == "drop:line=usb,every=3");
    CHECK_THROWS_WITH_AS(all.add(fault_from_text("drop:line=main")), doctest::Contains("no main line here"),
                         fault::FaultSpecError);
}

TEST_CASE("a fault for a line that is not there is refused, and nothing is changed") {
    testing::LooseFaults main;
    LineFaults none(main, nullptr, false);
    CHECK_THROWS_WITH_AS(none.add(fault::fault_from_text("garble")),
                         "fault \"garble\": this board has no line that it could spoil",
                         fault::FaultSpecError);
    CHECK(main.list().empty());
    LineFaults all(main, nullptr);
    all.add(fault_from_text("drop"));
    CHECK_THROWS_WITH_AS(all.add(fault_from_text("drop:line=usb")), doctest::Contains("no USB side here"),
                         fault::FaultSpecError);
    CHECK_THROWS_AS(all.change(1, fault_from_text("drop:line=usb")), fault::FaultSpecError);
    CHECK(all.list().size() == 1);
}

}  // namespace
}  // namespace fauxboard::host
