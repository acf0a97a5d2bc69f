// The real program on a real pseudo-terminal, against an echo program on another.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/framing.h"
#include "tests/bench/child.h"
#include "tests/bench/figure.h"

namespace fauxboard::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view request_body = "M290 Z0.01";
constexpr std::string_view reply_start = "N-0 L24 P5";

/// What one side of the comparison has shown so far.
struct Side {
    Child& child;
    Peer& peer;
    std::vector<double> latencies{};
    double cpu = 0;

    void ask(const std::string& request, int times) {
        const double before = child.cpu_seconds();
        for (int i = 0; i < times; ++i) {
            const auto start = Clock::now();
            peer.write(request);
            peer.line(reply_start);
            latencies.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
        }
        cpu += child.cpu_seconds() - before;
    }
    double cpu_per_reply() const { return cpu * 1e6 / static_cast<double>(latencies.size()); }
};

std::vector<Figure> talk(const Settings& settings) {
    const std::string request = protocol::frame(request_body);
    BoardChild board(settings.program, {"--no-pacing"});
    Peer board_peer(board.path());
    board_peer.write(request);
    const std::string reply = board_peer.line(reply_start);
    EchoChild echo(reply);
    Peer echo_peer(echo.path());

    Side measured{board, board_peer};
    Side least{echo, echo_peer};
    const int rounds = settings.smoke ? 2 : 60;
    const int times = settings.smoke ? 20 : 500;
    measured.ask(request, times);  // both warm
    least.ask(request, times);
    for (Side* side : {&measured, &least}) {
        side->latencies.clear();
        side->cpu = 0;
    }
    for (int round = 0; round < rounds; ++round) {  // in turns, so that what disturbs disturbs both
        measured.ask(request, times);
        least.ask(request, times);
    }
    return {
        {"request to reply over a pty, p50", "us", median(measured.latencies), median(least.latencies), 1.4},
        {"processor time per reply over a pty", "us", measured.cpu_per_reply(), least.cpu_per_reply(), 1.5}};
}

std::vector<Figure> idle(const Settings& settings) {
    BoardChild board(settings.program, {});
    Peer peer(board.path());
    peer.write(protocol::frame("M2134 FW:V1.02.xx"));
    peer.line("N-0 L9");
    peer.count_lines(settings.smoke ? 0.1 : 3);  // what is left of the boot
    const double cpu = board.cpu_seconds();
    const std::uint64_t wake_ups = board.wake_ups();
    const double seconds = settings.smoke ? 0.5 : 21.5;
    const std::size_t frames = std::max<std::size_t>(peer.count_lines(seconds), 1);
    const auto woken = static_cast<double>(board.wake_ups() - wake_ups);
    return {{"idle on a pty: wake-ups per frame", "", woken / static_cast<double>(frames), {}, 2},
            {"idle on a pty: processor time per second",
             "us",
             (board.cpu_seconds() - cpu) * 1e6 / seconds,
             {},
             200}};
}

std::vector<Figure> day(const Settings& settings) {
    std::string name = (std::filesystem::temp_directory_path() / "fauxboard-bench-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
        throw std::runtime_error("no temporary folder");
    }
    const std::string profile = name + "/heated.json";
    std::ofstream(profile) << R"({"name": "heated", "extends": "geeetech-a30t",
        "defaults": {"heaters.nozzle.target": 200, "heaters.bed.target": 60, "screen.known": true}})";
    const std::vector<std::string> arguments{"run",     "--pty",      "--quiet",
                                             "--speed", "max",        "--profile",
                                             profile,   "--duration", settings.smoke ? "10min" : "24h"};
    const double seconds = time_program(settings.program, arguments);
    std::filesystem::remove_all(name);
    return {{"24 h idle with heaters on, run --speed max", "s", seconds, {}, 1}};
}

}  // namespace

std::vector<Benchmark> pty_benchmarks() {
    return {{"pty", "latency and processor time of a reply over a pseudo-terminal, against an echo program",
             talk},
            {"idle", "a board with a silent peer: how often it wakes up", idle},
            {"run-day", "a day of `fauxboard run --speed max`", day}};
}

}  // namespace fauxboard::bench
