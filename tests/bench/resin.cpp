// How soon a resin board's first reply comes: its clients wait a tenth of a second for a line.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/host/profile_files.h"
#include "emulator/machine/memory_volume.h"
#include "emulator/sliced/sample.h"
#include "tests/bench/child.h"
#include "tests/bench/figure.h"

namespace fauxboard::bench {
namespace {

using machine::SimTime;
using Clock = std::chrono::steady_clock;

constexpr const char* profile_name = "elegoo-mars-pro";
constexpr double limit_ms = 20;
constexpr const char* file_name = "box.cbddlp";

/// Requests and how the first line of each reply begins. Together they leave the board as it was.
struct Question {
    std::string request;
    std::string start;
};
std::vector<Question> questions() {
    return {{"M4000", "ok B:"},
            {"M4006", "ok '"},
            {"M114", "ok C:"},
            {"M20", "Begin"},
            {std::string("M23 ") + file_name, "File opened:"},
            {std::string("M6030 '") + file_name + "'", "ok N:"},
            {"M27", "SD printing"},
            {"M33", "ok N:"}};
}

/// In the board's own time: from the request's last byte to the first byte of its reply.
std::vector<Figure> virtual_reply(const Settings&) {
    const auto profile = host::load_profile_by_name(profile_name);
    machine::BuiltInEntry file;
    file.name = file_name;
    file.content = sliced::make_sample({});
    machine::MemoryVolume stick({file});
    machine::Services services;
    services.sd = &stick;
    board::Board board(profile, services, {});
    SimTime now{0};
    board.power_on(now);
    const auto rest = [&](SimTime time) {
        now += time;
        while (board.advance(now) <= now || !board.output().empty()) {
            board.clear_output();
        }
    };
    rest(std::chrono::seconds(3));
    double longest_ms = 0;
    for (const Question& question : questions()) {
        rest(SimTime{1'000'777});
        const SimTime asked = now;
        board.receive(now, question.request + "\r\n");
        while (board.output().empty()) {
            const SimTime due = board.advance(now);
            if (board.output().empty()) {
                if (due > asked + std::chrono::seconds(1)) {
                    throw std::runtime_error("no reply to " + question.request);
                }
                now = std::max(now, due);
            }
        }
        if (!board.output().starts_with(question.start)) {
            throw std::runtime_error("another reply to " + question.request);
        }
        longest_ms = std::max(longest_ms, machine::to_seconds(board.time() - asked) * 1000);
        board.clear_output();
    }
    return {{"resin board, longest first reply, board's time", "ms", longest_ms, {}, limit_ms}};
}

/// The same over a real pseudo-terminal, by the clock on the wall.
std::vector<Figure> pty_reply(const Settings& settings) {
    std::string folder = (std::filesystem::temp_directory_path() / "fauxboard-bench-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
        throw std::runtime_error("no temporary folder");
    }
    std::ofstream(folder + "/" + file_name, std::ios::binary) << sliced::make_sample({});
    std::vector<double> all;
    std::vector<double> starts;  // of M6030 alone
    {
        BoardChild board(settings.program, {"--profile", profile_name, "--sd", folder});
        Peer peer(board.path());
        peer.line("chitu_initial_file_autorun!");
        for (int round = 0; round < (settings.smoke ? 2 : 200); ++round) {
            for (const Question& question : questions()) {
                const auto asked = Clock::now();
                peer.write(question.request + "\r\n");
                peer.line(question.start);
                const double ms = std::chrono::duration<double, std::milli>(Clock::now() - asked).count();
                all.push_back(ms);
                if (question.request.starts_with("M6030")) {
                    starts.push_back(ms);
                }
            }
        }
    }
    std::filesystem::remove_all(folder);
    std::sort(all.begin(), all.end());
    const double p99 = all[all.size() * 99 / 100];
    return {{"resin board, first reply over a pty, p50", "ms", median(all), {}, limit_ms},
            {"resin board, first reply over a pty, p99", "ms", p99, {}, limit_ms},
            {"resin board, M6030 over a pty, p50", "ms", median(starts), {}, limit_ms}};
}

}  // namespace

std::vector<Benchmark> resin_benchmarks() {
    return {{"resin", "the first reply of a resin board, in its own time", virtual_reply},
            {"resin-pty", "the same over a pseudo-terminal, M6030 included", pty_reply}};
}

}  // namespace fauxboard::bench
