// What a board costs that speaks as a host does.

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/bench/figure.h"

namespace fauxboard::bench {
namespace {

using board::Board;
using machine::SimTime;
using Clock = std::chrono::steady_clock;

constexpr int rounds = 5;

/// A board and lines for it; each is answered at once.
class Talk {
  public:
    Talk(std::string_view profile, std::vector<std::string> lines)
        : board_(host::load_profile_by_name(profile), {}, {false, 1, nullptr}), lines_(std::move(lines)) {
        board_.power_on(now_);
        rest(SimTime{5'000'000});
    }

    /// Seconds a line of `count` lines, one each millisecond, takes; all are answered.
    double seconds(std::size_t count) {
        const auto start = Clock::now();
        for (std::size_t i = 0; i < count; ++i) {
            now_ += SimTime{1000};
            board_.receive(now_, lines_[i % lines_.size()]);
            bytes_ += board_.output().size();
            board_.clear_output();
            board_.advance(now_);
        }
        return std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(count);
    }
    std::size_t bytes() const { return bytes_; }

  private:
    void rest(SimTime time) {
        now_ += time;
        while (board_.advance(now_) <= now_) {
            board_.clear_output();
        }
        board_.clear_output();
    }

    SimTime now_{0};
    Board board_;
    std::vector<std::string> lines_;
    std::size_t bytes_ = 0;
};

/// The temperatures, asked for on the main line of either: each answer holds six numbers and more.
std::vector<Figure> reply_cost(const Settings& settings) {
    const std::size_t count = settings.smoke ? 100 : 20'000;
    Talk smartto("geeetech-a30t", {protocol::frame("M105")});
    Talk marlin("marlin", {"M105\n"});
    std::vector<double> theirs;
    std::vector<double> ours;
    for (int i = 0; i < rounds; ++i) {
        theirs.push_back(smartto.seconds(count) * 1e9);
        ours.push_back(marlin.seconds(count) * 1e9);
    }
    return {{"a reply of Marlin, against one of Smartto", "ns", median(ours), median(theirs), 1.0}};
}

/// A host that streams moves with numbers and checksums as fast as they are acknowledged, on a machine that
/// takes no time: each move ends before the next comes.
std::vector<Figure> stream_cost(const Settings& settings) {
    const std::size_t count = settings.smoke ? 100 : 100'000;
    std::vector<std::string> lines{"M110 N0\n"};
    for (std::size_t i = 1; i < count; ++i) {
        std::string line = "N" + std::to_string(i) + " G1 X" + std::to_string(10 + i % 90) + "." +
                           std::to_string(i % 1000) + " Y" + std::to_string(10 + i % 70) + " F6000";
        lines.push_back(line + "*" + std::to_string(protocol::xor_checksum(line)) + "\n");
    }
    Board board(host::load_profile_by_name("marlin"), {}, {false, 1, nullptr});
    SimTime now{0};
    board.power_on(now);
    std::vector<double> each;
    for (int i = 0; i < rounds; ++i) {
        std::size_t oks = 0;
        const auto start = Clock::now();
        for (const std::string& line : lines) {
            board.receive(now, line);
            while (board.output().find("ok\n") == std::string_view::npos) {
                board.clear_output();
                board.advance(now + SimTime{3'600'000'000});
                now = board.time();
            }
            ++oks;
            board.clear_output();
        }
        each.push_back(std::chrono::duration<double>(Clock::now() - start).count() * 1e6 /
                       static_cast<double>(oks));
    }
    return {{"a streamed line with its ok; 100 000 a second", "us", median(each), std::nullopt, 10}};
}

}  // namespace

std::vector<Benchmark> marlin_benchmarks() {
    return {{"reply", "what a reply of a Marlin board costs", reply_cost},
            {"stream", "what a line of a host that streams costs", stream_cost}};
}

}  // namespace fauxboard::bench
