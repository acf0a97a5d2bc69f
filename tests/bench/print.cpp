// What a print costs: a sliced file through a whole board, in virtual time and as fast as it goes.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/bench/allocations.h"
#include "tests/bench/figure.h"
#include "tests/support/printers.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::bench {
namespace {

using machine::JobStatus;
using machine::SimTime;
using Clock = std::chrono::steady_clock;

constexpr double least_lines_per_second = 300'000;
constexpr double ns_per_s = 1e9;
/// A name or a message that is longer than the one before; not a piece of the file.
constexpr double most_growth_kib = 1;

struct Print {
    double ns_per_line = 0;
    double growth_kib = 0;  ///< of the heap, from the start of the job to its highest point
};

/// Prints the file on `disk` from its first line to its last.
Print print(testing::MemoryDisk& disk) {
    machine::Services services;
    services.sd = &disk;
    board::Board board(host::load_profile_by_name("geeetech-a30t"), services, {});
    SimTime now{0};
    board.power_on(now);
    board.receive(now, protocol::frame("M2134 FW:V1") + protocol::frame("M23 x.gcode"));
    const auto advance = [&] {
        now = std::max(now, board.advance(now));
        board.clear_output();
    };
    // The boot messages are through, and each buffer has its size.
    while (now < std::chrono::seconds(5)) {
        advance();
    }
    board.receive(now, protocol::frame("M24"));
    while (testing::filament_printer(board.machine()).runner.counts().lines == 0 &&
           now < std::chrono::seconds(30)) {
        advance();
    }
    const std::int64_t held = allocations().live_bytes;
    std::int64_t most = held;
    const std::uint64_t before = testing::filament_printer(board.machine()).runner.counts().lines;
    const auto start = Clock::now();
    while (board.machine().job.status() == JobStatus::printing) {
        advance();
        most = std::max(most, allocations().live_bytes);
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const auto lines =
        static_cast<double>(testing::filament_printer(board.machine()).runner.counts().lines - before);
    return {seconds * ns_per_s / lines, static_cast<double>(most - held) / 1024};
}

std::vector<Figure> job(const Settings& settings) {
    testing::SlicedFile wishes;
    if (settings.smoke) {
        wishes.moves = 300;
        wishes.layers = 3;
    }
    testing::MemoryDisk disk;
    disk.put("x.gcode", testing::make_sliced_file(wishes));
    std::vector<double> costs;
    double growth = 0;
    for (int round = 0; round < (settings.smoke ? 1 : 5); ++round) {
        const Print one = print(disk);
        costs.push_back(one.ns_per_line);
        growth = std::max(growth, one.growth_kib);
    }
    return {{"a line of G-code through a whole board",
             "ns/line",
             median(std::move(costs)),
             {},
             ns_per_s / least_lines_per_second},
            {"memory that a print takes as it goes on", "KiB", growth, {}, most_growth_kib}};
}

}  // namespace

std::vector<Benchmark> print_benchmarks() {
    return {{"print", "a sliced file of 60 000 moves, in virtual time; at least 300 000 lines/s", job}};
}

}  // namespace fauxboard::bench
