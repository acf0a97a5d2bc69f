// One file's whole life on a resin board: up over a bad network, listed, printed, paused, resumed, stopped,
// printed to its end, and down again. What is asked at each step is what programs that watch a print ask.

#include <doctest/doctest.h>

#include <cstdio>

#include "tests/support/resin_bench.h"
#include "tests/support/resin_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

constexpr std::uint64_t big = 50'000'000;

/// A file that can be printed, with bytes behind its pictures up to the size wanted.
struct BigFile {
    BigFile() {
        ResinFile wishes;
        wishes.layers = 5;
        wishes.bottom_layers = 1;
        wishes.exposure_s = 4;
        wishes.bottom_exposure_s = 10;
        made = make_resin_file(wishes);
    }
    std::string at(std::uint64_t offset, std::size_t size) const {
        std::string out = pattern(offset, size);
        if (offset < made.bytes.size()) {
            made.bytes.copy(out.data(), size, offset);
        }
        return out;
    }
    MadeResinFile made;
};

}  // namespace

TEST_CASE("chitu cycle: 50 MB up over a network that spoils one in fifty, printed, and down the same") {
    const BigFile file;
    ResinBench bench("elegoo-mars-pro", 2 * big + 1'000'000);
    CHECK(bench.ask("M4006") == "ok 'none'\r\n");
    TransferClient client = bench.client({0.02, 3});
    const auto content = [&](std::uint64_t at, std::size_t size) { return file.at(at, size); };
    REQUIRE(client.upload("big one.ctb", big, content) == "");
    CHECK(client.lost > 200);
    CHECK(client.damaged > 100);
    CHECK(client.repeated > 100);
    CHECK(bench.ask("M20").find("\r\nbig one.ctb 50000000\r\n") != std::string::npos);

    const auto end_of = [&](std::size_t layers) -> unsigned long {
        return layers == 0 ? 0 : file.made.layer_ends[layers - 1];
    };
    const auto file_is = [&](unsigned long byte, unsigned long bytes, unsigned long halted) {
        unsigned long d[3] = {9, 9, 9};
        const std::string status = bench.ask("M4000", 0.01);
        REQUIRE(std::sscanf(status.c_str() + status.find(" D:"), " D:%lu/%lu/%lu ", d, d + 1, d + 2) == 3);
        CHECK(d[0] == byte);
        CHECK(d[1] == bytes);
        CHECK(d[2] == halted);
        CHECK(bench.ask("M27", 0.01) == (bytes == 0
                                             ? std::string("Error:It's not printing now!\r\nok N:0\r\n")
                                             : "SD printing byte " + std::to_string(byte) + "/" +
                                                   std::to_string(bytes) + "\r\nok N:0\r\n"));
        CHECK(bench.ask("M4006", 0.01) == "ok 'big one.ctb'\r\n");
    };
    const auto z_is = [&](double mm) {
        double z = -1;
        REQUIRE(std::sscanf(bench.ask("M114", 0.01).c_str(),
                            "ok C: X:0.000000 Y:0.000000 Z:%lf E:0.000000\r\n", &z) == 1);
        CHECK(z == doctest::Approx(mm).epsilon(0.001));
    };
    const auto expose = [&](int layer) {  // runs on into the exposure of that layer, from 0
        REQUIRE(bench.reaches("job.layer", layer));
        for (int i = 0; bench.text("resin.phase") != "exposing"; ++i) {
            REQUIRE(i < 100'000);
            bench.run_for(0.01);
        }
    };

    CHECK(bench.ask("M6030 'big one.ctb'") == "ok N:0\r\n");
    file_is(0, big, 0);
    expose(1);
    file_is(end_of(1), big, 0);
    z_is(0.1);

    CHECK(bench.ask("M25") == "ok N:0\r\n");
    file_is(end_of(1), big, 0);
    bench.run_for(20);
    const double done = bench.number("job.layer");  // the pause may have come behind the layer's end
    file_is(end_of(static_cast<std::size_t>(done)), big, 1);
    CHECK(bench.number("resin.led") == 0);
    z_is(bench.number("resin.z"));
    CHECK(bench.number("resin.z") > 25);

    CHECK(bench.ask("M24") == "ok N:0\r\n");
    file_is(end_of(static_cast<std::size_t>(done)), big, 0);
    expose(2);
    file_is(end_of(2), big, 0);
    z_is(0.15);

    CHECK(bench.ask("M33") == "ok N:0\r\n");
    file_is(0, 0, 1);
    bench.run_for(120);
    z_is(155);

    CHECK(bench.ask("M6030 'big one.ctb'") == "ok N:0\r\n");
    for (int layer = 0; layer < 5; ++layer) {
        expose(layer);
        file_is(end_of(static_cast<std::size_t>(layer)), big, 0);
        z_is(0.05 * (layer + 1));
    }
    for (int i = 0; bench.number("job.active") == 1; ++i) {
        REQUIRE(i < 10'000);
        bench.run_for(0.1);
    }
    file_is(0, 0, 1);
    z_is(155);

    std::uint64_t same = 0;
    std::uint64_t at = 0;
    REQUIRE(client.download("big one.ctb", big, [&](std::string_view bytes) {
        same += bytes == file.at(at, bytes.size()) ? bytes.size() : 0;
        at += bytes.size();
    }) == "");
    CHECK(same == big);
}
