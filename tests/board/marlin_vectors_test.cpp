// The dialect of Marlin boards, byte for byte: the vectors in virtual time, on both lines.

#include <doctest/doctest.h>

#include <string>

#include "tests/support/marlin.h"

using namespace fauxboard;
using namespace fauxboard::testing;

TEST_CASE("Marlin: every vector, byte for byte, on the screen's line") {
    for (const MarlinVector& vector : marlin_vectors()) {
        CAPTURE(vector.name);
        MarlinBench bench(marlin_profile());
        if (!vector.world.empty()) {
            bench.world(vector.world);
        }
        bench.forget();
        for (const std::string& line : vector.send) {
            bench.say(line);
        }
        CHECK(bench.said() == vector.reply);
    }
}

TEST_CASE("Marlin: any split of the bytes is answered alike") {
    for (const MarlinVector& vector : marlin_vectors()) {
        CAPTURE(vector.name);
        MarlinBench bench(marlin_profile());
        if (!vector.world.empty()) {
            bench.world(vector.world);
        }
        bench.forget();
        for (const std::string& line : vector.send) {
            for (const char byte : line + "\r\n") {
                bench.feed({&byte, 1});
            }
            bench.run_for(0.05);
        }
        CHECK(bench.said() == vector.reply);
    }
}
