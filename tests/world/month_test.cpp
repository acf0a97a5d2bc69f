// A month of a touch screen's requests on a bad line: after each stretch of faults the next good request is
// answered, and the memory at its end is that of its first day.

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>

#include "emulator/board/board.h"
#include "emulator/fault/dice.h"
#include "emulator/fault/faults.h"
#include "emulator/host/profile_files.h"
#include "emulator/world/cast.h"
#include "protocol/command.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

using machine::SimTime;
using namespace std::chrono_literals;

constexpr SimTime month = 24h * 30;
constexpr std::uint64_t whole = 24'000'000;  ///< requests
constexpr std::uint64_t at_a_stretch = 250;  ///< between two good ones
constexpr SimTime between = month / whole;
constexpr SimTime patience = 8s;
/// By which the heap may grow after the first day: queues that had never been so full. Of a byte for each 400
/// requests it would be more.
constexpr std::size_t rooms = 60'000;

constexpr std::array kinds{"drop",
                           "garble",
                           "garble:bytes=3",
                           "duplicate:copies=2",
                           "delay:jitter=1s",
                           "slow:rate=300B/s",
                           "cut",
                           "cut:line_end=lost",
                           "merge",
                           "nul_burst",
                           "nul_burst:where=inside,bytes=40",
                           "stray_ok",
                           "wrong_checksum",
                           "silence:for=2s",
                           "disconnect:for=3s"};

/// A board at one end of a line with faults, requests at the other.
class Month {
  public:
    explicit Month(const std::string& profile)
        : cast_(make_cast(host::load_profile_by_name(profile))), board_(cast_.profile, {}, {}) {
        const auto waits = [this](const std::string& request) { return is_until_done(request); };
        cast_.requests.erase(std::remove_if(cast_.requests.begin(), cast_.requests.end(), waits),
                             cast_.requests.end());
        board_.connect(board::Channel::main, true);
        board_.power_on(now_);
        pass(30s);
    }

    /// One more stretch of requests under faults of its own, and a good one behind it.
    void stretch() {
        for (std::uint64_t faults = 1 + dice_.below(3); faults > 0; --faults) {
            const std::string kind = kinds[dice_.below(kinds.size())];
            faults_.add(now_, fault::fault_from_text(
                                  fmt::format("{}{}probability={:.3f},seed={}", kind,
                                              kind.find(':') == std::string::npos ? ":" : ",",
                                              0.01 + 0.3 * dice_.fraction(), dice_.below(1U << 31U))));
        }
        for (std::uint64_t i = 1; i < at_a_stretch; ++i) {
            say(cast_.requests[dice_.below(cast_.requests.size())]);
            pass(between);
        }
        for (const fault::FaultStatus& status : faults_.list(now_)) {
            spoiled += status.acted;
        }
        faults_.clear(now_);
        pass(2s);  // what was held back comes
        ask();
        requests += at_a_stretch;
    }
    bool hung() { return board_.machine().hung(); }

    std::uint64_t requests = 0;
    std::uint64_t spoiled = 0;
    std::uint64_t good = 0;
    std::uint64_t answered = 0;
    SimTime slowest{0};

  private:
    /// What stands behind one of these is answered when the machine is done, as on a real board.
    bool is_until_done(const std::string& request) const {
        protocol::Command command;
        const auto* const rules = protocol::parse_command(request, command)
                                      ? cast_.profile->rules_for(board::Channel::main, command)
                                      : nullptr;
        return rules != nullptr && std::any_of(rules->begin(), rules->end(),
                                               [](const behaviour::Rule& rule) { return rule.until_done; });
    }
    void ask() {
        const Probe& probe = cast_.probes[0].value();
        heard_.clear();
        const SimTime asked = now_;
        faults_.to_board().push(now_, "\r\n");  // the last fault may have taken a line end
        say(probe.request);
        while (!probe.answered_by(heard_) && now_ - asked < patience) {
            pass(10ms);
        }
        ++good;
        answered += probe.answered_by(heard_) ? 1 : 0;
        slowest = std::max(slowest, now_ - asked);
    }

    void say(std::string_view body) {
        faults_.to_board().push(now_, protocol::frame(body));
        carry();
    }

    void pass(SimTime time) {
        const SimTime end = now_ + time;
        while (now_ < end) {
            now_ = std::min({end, std::max(now_, board_due_), std::max(now_, faults_due_)});
            board_due_ = board_.advance(now_);
            carry();
        }
        // A line that nobody listens to is not kept for ever.
        heard_.erase(0, heard_.size() > 4096 ? heard_.size() - 4096 : 0);
    }

    void carry() {
        board_.connect(board::Channel::main, faults_.connected(now_));
        faults_.to_screen().push(now_, board_.output());
        board_.clear_output();
        faults_due_ = faults_.advance(now_);
        heard_ += faults_.to_screen().output();
        faults_.to_screen().clear_output();
        if (!faults_.to_board().output().empty()) {
            board_.receive(now_, faults_.to_board().output());
            faults_.to_board().clear_output();
            board_due_ = now_;
        }
    }

    Cast cast_;
    board::Board board_;
    fault::Faults faults_;
    fault::Dice dice_{2026, 11, 30};
    SimTime now_{0};
    SimTime board_due_{0};
    SimTime faults_due_{0};
    std::string heard_;
};

std::size_t heap_bytes() {
    return ::mallinfo2().uordblks;
}

/// FAUXBOARD_MONTH=1 plays all of it; else as much as a test may take.
std::uint64_t wanted_requests() {
    return std::getenv("FAUXBOARD_MONTH") != nullptr ? whole : whole / 400;
}

TEST_CASE("a month of requests on a bad line: the next good one is always answered, and memory is flat") {
    const std::uint64_t wanted = wanted_requests();
    Month life("geeetech-a30t");
    const auto start = std::chrono::steady_clock::now();
    std::size_t first = 0;
    std::size_t most = 0;
    while (life.requests < wanted && !life.hung()) {
        life.stretch();
        const std::size_t now = heap_bytes();
        const bool settling = life.requests <= wanted / 30;
        (settling ? first : most) = std::max(settling ? first : most, now);
    }
    CHECK_FALSE(life.hung());
    CHECK(life.answered == life.good);
    CHECK(life.spoiled > wanted / 20);
    CHECK(most <= first + rooms);
    MESSAGE(life.requests
            << " requests in " << life.requests / (whole / 30) << " of 30 days, " << life.spoiled
            << " lines spoiled; " << life.answered << " of " << life.good
            << " good ones answered, the slowest in "
            << std::chrono::duration_cast<std::chrono::milliseconds>(life.slowest).count()
            << " ms; heap on the first day " << first << ", after it at most " << most << " bytes; "
            << std::chrono::ceil<std::chrono::seconds>(std::chrono::steady_clock::now() - start).count()
            << " s of this computer");
}

}  // namespace
}  // namespace fauxboard::world
