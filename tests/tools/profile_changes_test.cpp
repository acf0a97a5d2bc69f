#include "tools/profile_changes.h"

#include <doctest/doctest.h>

#include <fstream>

#include "tests/tools/helpers.h"

using namespace fauxboard;

TEST_CASE("a changed profile: what is in force at once, at the board's next start, at the program's") {
    const tests::TemporaryFile file("mine.json", "");
    const auto write = [&](const std::string& more) {
        std::ofstream(file.path()) << R"({"name": "mine", "extends": "geeetech-a30t")" << more << "}";
    };
    write("");
    tools::ProfileChanges changes(file.path());
    write(R"(, "frames": {"L14.x": "L14 x"})");
    CHECK(changes.what_waits().empty());
    write(R"(, "identity": {"model": "B"}, "boot": ["L1"])");
    CHECK(changes.what_waits() ==
          "; boot at the board's next start; identity at the next start of this program");
    write(R"(, "identity": {"model": "B"}, "boot": ["L1"], "machine": {"udisk_port": true})");
    CHECK(changes.what_waits() == "; machine, identity at the next start of this program");
    write(R"(, "boot": ["L1"])");
    CHECK(changes.what_waits().empty());
}
