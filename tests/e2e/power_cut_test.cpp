// kill -9 in the middle of prints: whatever the moment, the next start offers the right place.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tests/e2e/program.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::e2e {
namespace {

constexpr int cuts = 100;

struct Bench {
    TemporaryFolder folder;
    std::string content;

    Bench() {
        testing::SlicedFile wishes;
        wishes.moves = 60'000;
        wishes.layers = 200;
        content = testing::make_sliced_file(wishes);
        std::filesystem::create_directory(folder.file("card"));
        std::ofstream(folder.file("card/part.gcode"), std::ios::binary) << content;
    }
    Args arguments() const {
        return {"run",
                "--pty",
                "--sd",
                folder.file("card"),
                "--eeprom",
                folder.file("eeprom"),
                "--no-pacing",
                "--speed",
                "200",
                "--control",
                folder.file("control"),
                "-q"};
    }
    /// Of the running board.
    double number(const std::string& field) const {
        const Result result = run({"ctl", folder.file("control"), "get", field});
        CAPTURE(result.out);
        CAPTURE(result.errors);
        REQUIRE(result.code == 0);
        const std::size_t at = result.out.find_first_of("0123456789", result.out.find(field) + field.size());
        REQUIRE(at != std::string::npos);
        return std::stod(result.out.substr(at));
    }
};

TEST_CASE("a hundred kills at any moment of a print: the job is offered, at a line, and never further back") {
    const Bench bench;
    std::mt19937 random(20);
    double last = 0;
    int moved = 0;
    for (int cut = 0; cut < cuts; ++cut) {
        CAPTURE(cut);
        Program program(bench.arguments());
        Peer screen(program.ready()["path"]);
        if (cut == 0) {
            screen.ask("M23 part.gcode", "L14");
            REQUIRE(contains(screen.ask("M24", "L3 PS:1"), "L3 PS:1"));
        } else {
            REQUIRE(contains(screen.lines().find("L16 P0 15"), "L16 P0 15"));
            const double byte = bench.number("power_loss.byte");
            REQUIRE(byte >= last);
            REQUIRE(byte <= static_cast<double>(bench.content.size()));
            REQUIRE((byte == 0 || bench.content[static_cast<std::size_t>(byte) - 1] == '\n'));
            moved += byte > last ? 1 : 0;
            last = byte;
            REQUIRE(contains(screen.ask("M2130 P0 S1", "L3 PS:3"), "L3 PS:3"));
        }
        for (unsigned lines = static_cast<unsigned>(random() % 40); lines > 0; --lines) {
            REQUIRE(screen.lines().next() != "(silence)");
        }
        volatile unsigned rest = static_cast<unsigned>(random() % 1'000'000);
        while (rest > 0) {
            const unsigned next = rest - 1;
            rest = next;
        }
        program.signal(SIGKILL);
        CHECK(program.wait() == 1000 + SIGKILL);
    }
    CHECK(moved > cuts / 4);
    CHECK_FALSE(std::filesystem::exists(bench.folder.file("eeprom.broken")));
}

}  // namespace
}  // namespace fauxboard::e2e
