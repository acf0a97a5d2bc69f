#include <doctest/doctest.h>

#include "protocol/framing.h"
#include "tests/fault/helpers.h"

using namespace fauxboard::fault;
namespace protocol = fauxboard::protocol;

TEST_CASE("wrong_checksum: acts, is repeatable, ends, both ways") {
    check_edits("wrong_checksum");
}

TEST_CASE("wrong_checksum: the checksum is always another one, the line stays") {
    const std::string line = protocol::frame("L7 star*in*name.gco");
    for (int seed = 0; seed < 300; ++seed) {
        const std::string out = spoiled("wrong_checksum:seed=" + std::to_string(seed), line);
        REQUIRE(out.ends_with("\r\n"));
        const auto frame = protocol::unframe(std::string_view(out).substr(0, out.size() - 2),
                                             protocol::ChecksumPolicy::required);
        CHECK(frame.fault == protocol::FrameFault::checksum_wrong);
        CHECK(frame.body == "L7 star*in*name.gco");
    }
}

TEST_CASE("wrong_checksum: other lines pass and do not count") {
    LineRig rig;
    rig.add("wrong_checksum:every=2");
    const std::string others = "log Geeetech LCD OK\r\nM23 a.gco\r\nN-0 L14 Pausing*\r\nN-0 L1*1\r\n";
    CHECK(rig.push(others) == others);
    CHECK(rig.status().seen == 0);
    CHECK(rig.push(frames(1)) == frames(1));
    CHECK(rig.push(others) == others);
    CHECK(rig.push(frames(1)) != frames(1));
    CHECK(rig.status().seen == 2);
    CHECK(rig.status().acted == 1);
}
