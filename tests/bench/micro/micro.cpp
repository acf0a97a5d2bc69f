// Where a request's time goes: one benchmark a room, and one a kind of request. For looking closer when a
// ratio of fauxboard_bench is beyond its limit; nothing depends on these numbers.

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "emulator/board/board.h"
#include "emulator/host/profile_files.h"
#include "protocol/command.h"
#include "protocol/framing.h"

namespace {

using namespace fauxboard;
using machine::SimTime;

std::shared_ptr<const behaviour::Profile> profile() {
    static const auto loaded = host::load_profile_by_name("geeetech-a30t");
    return loaded;
}

void split_line(benchmark::State& state) {
    const std::string line = protocol::frame("M290 Z0.15");
    protocol::LineSplitter splitter;
    for (auto _ : state) {
        splitter.feed(line, [](std::string_view found) { benchmark::DoNotOptimize(found.data()); });
    }
}
BENCHMARK(split_line);

void unframe(benchmark::State& state) {
    const std::string line = protocol::frame("M290 Z0.15");
    const std::string_view bare = std::string_view(line).substr(0, line.size() - 2);
    for (auto _ : state) {
        benchmark::DoNotOptimize(protocol::unframe(bare, protocol::ChecksumPolicy::required));
    }
}
BENCHMARK(unframe);

void parse(benchmark::State& state) {
    const std::string body = "M290 Z0.15";
    protocol::Command command;
    for (auto _ : state) {
        benchmark::DoNotOptimize(protocol::parse_command(body, command));
        benchmark::ClobberMemory();
    }
}
BENCHMARK(parse);

void write_frame(benchmark::State& state) {
    std::array<char, 64> out{};
    for (auto _ : state) {
        benchmark::DoNotOptimize(protocol::write_frame(out, "L24 P5 A0.15", protocol::FrameStyle::framed));
    }
}
BENCHMARK(write_frame);

void load_profile(benchmark::State& state) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(host::load_profile_by_name("geeetech-a30t"));
    }
}
BENCHMARK(load_profile)->Unit(benchmark::kMillisecond);

/// A homed board with a hot nozzle, without pacing, that is sent the same request every millisecond.
void request(benchmark::State& state, const std::string& body) {
    board::Board board(profile(), {}, {false, 1, nullptr});
    SimTime now{0};
    board.power_on(now);
    const auto say = [&](std::string_view text, SimTime then) {
        board.receive(now, protocol::frame(text));
        now += then;
        do {
            board.clear_output();
        } while (board.advance(now) <= now);
    };
    say("M104 S200", std::chrono::minutes(4));
    say("G28", std::chrono::minutes(1));
    const std::string line = protocol::frame(body);
    for (auto _ : state) {
        now += std::chrono::milliseconds(1);
        board.receive(now, line);
        benchmark::DoNotOptimize(board.output().data());
        board.clear_output();
        board.advance(now);
    }
}
BENCHMARK_CAPTURE(request, M290, "M290 Z0.15");
BENCHMARK_CAPTURE(request, M2140_S5, "M2140 S5");
BENCHMARK_CAPTURE(request, M105, "M105");
BENCHMARK_CAPTURE(request, M27, "M27");
BENCHMARK_CAPTURE(request, M165, "M165 A40 B30 C30");
BENCHMARK_CAPTURE(request, M2138, "M2138 S1");
BENCHMARK_CAPTURE(request, M2134, "M2134 FW:V1.02.xx");
BENCHMARK_CAPTURE(request, M20_LCD, "M20 LCD");
BENCHMARK_CAPTURE(request, M500, "M500");

}  // namespace

BENCHMARK_MAIN();
