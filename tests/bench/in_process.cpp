// What a board costs where no line is in between.

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/bench/allocations.h"
#include "tests/bench/figure.h"
#include "tests/bench/mix.h"

namespace fauxboard::bench {
namespace {

using board::Board;
using machine::SimTime;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::shared_ptr<const behaviour::Profile> profile() {
    static const auto loaded = host::load_profile_by_name("geeetech-a30t");
    return loaded;
}

/// A board without pacing that takes the mix pass after pass: a request each millisecond, then a minute in
/// which what was begun (homing) comes to its end.
class Subject {
  public:
    Subject() : board_(profile(), {}, {false, 1, nullptr}), requests_(recorded_mix()) {
        board_.power_on(now_);
        say("M104 S200");
        rest(std::chrono::minutes(4));
        say("G28");
        rest(std::chrono::minutes(1));
    }

    const std::vector<std::string>& requests() const { return requests_; }

    /// One pass over the mix; `take(bytes)` gets what each request is answered with.
    template <class Take>
    void pass(Take&& take) {
        pass_over(requests_.size(), take);
    }

    /// The same but for the homing: the next pass then finds all as if the last one had gone on and on.
    template <class Take>
    void warm(Take&& take) {
        pass_over(requests_.size() - 1, take);
    }

    void rest(SimTime time) {
        now_ += time;
        while (board_.advance(now_) <= now_) {
            board_.clear_output();
        }
        board_.clear_output();
    }

  private:
    template <class Take>
    void pass_over(std::size_t count, Take&& take) {
        for (std::size_t i = 0; i < count; ++i) {
            now_ += std::chrono::milliseconds(1);
            board_.receive(now_, requests_[i]);
            take(board_.output());
            board_.clear_output();
            board_.advance(now_);
        }
    }

    void say(std::string_view body) {
        board_.receive(now_, protocol::frame(body));
        board_.clear_output();
    }

    SimTime now_{0};
    Board board_;
    std::vector<std::string> requests_;
};

/// The floor: finds the line end, XORs request and reply, copies a reply made beforehand.
class Floor {
  public:
    Floor(std::vector<std::string> requests, std::vector<std::string> replies)
        : requests_(std::move(requests)), replies_(std::move(replies)) {
        output_.reserve(1024);
    }

    unsigned pass() {
        unsigned sum = 0;
        for (std::size_t i = 0; i < requests_.size(); ++i) {
            const std::string& request = requests_[i];
            const void* const end = std::memchr(request.data(), '\n', request.size());
            const auto length = static_cast<std::size_t>(static_cast<const char*>(end) - request.data());
            sum += protocol::xor_checksum(std::string_view(request).substr(0, length));
            sum += protocol::xor_checksum(replies_[i]);
            output_.append(replies_[i]);
            sum += static_cast<unsigned char>(output_[0]);
            output_.clear();
        }
        return sum;
    }

  private:
    std::vector<std::string> requests_;
    std::vector<std::string> replies_;
    std::string output_;
};

std::vector<Figure> mix(const Settings& settings) {
    Subject subject;
    std::vector<std::string> replies;
    subject.pass([&](std::string_view bytes) { replies.emplace_back(bytes.empty() ? " " : bytes); });
    subject.rest(std::chrono::minutes(1));
    Floor floor(subject.requests(), replies);
    const auto per_pass = static_cast<double>(subject.requests().size());
    const int rounds = settings.smoke ? 3 : 2000;
    constexpr int floor_passes = 20;  // of the same length as a pass through the board
    std::vector<double> measured;
    std::vector<double> least;
    volatile unsigned sink = 0;
    for (int round = 0; round < rounds; ++round) {
        std::size_t bytes = 0;
        subject.warm([&](std::string_view output) { bytes += output.size(); });
        auto start = Clock::now();
        subject.pass([&](std::string_view output) { bytes += output.size(); });
        measured.push_back(seconds_since(start) * 1e9 / per_pass);
        start = Clock::now();
        for (int i = 0; i < floor_passes; ++i) {
            sink = sink + floor.pass();
        }
        least.push_back(seconds_since(start) * 1e9 / per_pass / floor_passes);
        sink = sink + static_cast<unsigned>(bytes);
        subject.rest(std::chrono::minutes(1));
    }
    return {{"mix of requests through a board", "ns/request", median(measured), median(least), 10}};
}

std::vector<Figure> allocation(const Settings& settings) {
    Subject subject;
    std::size_t bytes = 0;
    const auto passes = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            subject.pass([&](std::string_view output) { bytes += output.size(); });
            subject.rest(std::chrono::minutes(1));
        }
    };
    passes(3);
    const std::uint64_t before = allocations().calls;
    const std::size_t requests = settings.smoke ? 1000 : 100'000;
    passes(requests / subject.requests().size() + 1);
    const auto calls = static_cast<double>(allocations().calls - before);  // before the figure makes some
    return {{"allocations in 100 000 requests", "calls", calls, {}, 0}};
}

std::vector<Figure> memory(const Settings& settings) {
    const std::size_t count = settings.smoke ? 10 : 1000;
    profile();
    std::vector<std::unique_ptr<Board>> boards;
    boards.reserve(count);
    const std::int64_t before = allocations().live_bytes;
    for (std::size_t i = 0; i < count; ++i) {
        auto& board =
            *boards.emplace_back(std::make_unique<Board>(profile(), machine::Services{}, board::Options{}));
        SimTime now{0};
        board.power_on(now);
        for (const std::string& request : recorded_mix()) {
            now += std::chrono::milliseconds(100);
            board.receive(now, request);
            while (board.advance(now) <= now) {
                board.clear_output();
            }
            board.clear_output();
        }
    }
    const auto held = static_cast<double>(allocations().live_bytes - before);
    return {
        {"memory of a board beyond its profile", "KiB", held / 1024 / static_cast<double>(count), {}, 64}};
}

std::vector<Figure> day(const Settings& settings) {
    Board board(profile(), {}, {});
    SimTime now{0};
    board.power_on(now);
    board.receive(now, protocol::frame("M2134 FW:V1.02.xx") + protocol::frame("M104 S200") +
                           protocol::frame("M140 S60"));
    const auto start = Clock::now();
    now += settings.smoke ? SimTime(std::chrono::minutes(10)) : SimTime(std::chrono::hours(24));
    while (board.advance(now) <= now) {
        board.clear_output();
    }
    return {{"24 h idle with heaters on, in process", "s", seconds_since(start), {}, 1}};
}

}  // namespace

std::vector<Benchmark> in_process_benchmarks() {
    return {{"mix", "the recorded mix of requests through a whole board, without pacing", mix},
            {"allocations", "operator new in the steady state", allocation},
            {"memory", "heap of one board of a thousand that share a profile", memory},
            {"day", "a day of an idle board with heaters on, in virtual time", day}};
}

}  // namespace fauxboard::bench
