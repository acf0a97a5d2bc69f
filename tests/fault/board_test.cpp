// A real board behind a line that misbehaves, both ways, and after it is mended.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/fault/kind.h"
#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/fault/helpers.h"

using namespace fauxboard;
using namespace fauxboard::fault;

namespace {

/// A board, a screen that asks twice a second, and the line between them.
class Bench {
  public:
    Bench() : board_(host::load_profile_by_name("geeetech-a30t"), {}, {true, 1, nullptr}) {
        board_.power_on(now_);
    }

    void add(std::string_view spec) { faults.add(now_, fault_from_text(spec)); }
    void clear() { faults.clear(now_); }
    /// Runs that long; gives what the screen gets.
    std::string run(SimTime time) {
        heard_.clear();
        for (const SimTime end = now_ + time; now_ < end; now_ += ms(10)) {
            if (now_.count() % 500'000 == 0) {
                faults.to_board().push(now_, protocol::frame("M115"));
            }
            faults.advance(now_);
            carry();
        }
        return heard_;
    }
    const board::Counters& counters() const { return board_.counters(); }

    Faults faults;

  private:
    void carry() {
        while (true) {
            board_.receive(now_, faults.to_board().output());
            faults.to_board().clear_output();
            board_.advance(now_);
            if (board_.output().empty()) {
                break;
            }
            faults.to_screen().push(board_.time(), board_.output());
            board_.clear_output();
        }
        faults.advance(now_);
        heard_.append(faults.to_screen().output());
        faults.to_screen().clear_output();
    }

    SimTime now_{0};
    std::string heard_;
    board::Board board_;
};

/// How many lines are whole frames with a right checksum, and how many are not.
std::pair<std::size_t, std::size_t> judge(std::string_view bytes) {
    std::pair<std::size_t, std::size_t> sums{0, 0};
    protocol::LineSplitter splitter;
    splitter.feed(bytes, [&](std::string_view line) {
        const auto frame = protocol::unframe(line, protocol::ChecksumPolicy::required);
        ++(frame.fault == protocol::FrameFault::none ? sums.first : sums.second);
    });
    return sums;
}

std::size_t answers(std::string_view bytes) {
    std::size_t n = 0;
    for (std::size_t at = bytes.find("L9 DN:"); at != std::string_view::npos;
         at = bytes.find("L9 DN:", at + 1)) {
        ++n;
    }
    return n;
}

}  // namespace

TEST_CASE("board: every kind of fault, both ways, and after it is cleared the board works on") {
    const std::string specs[] = {"drop:probability=0.3",
                                 "garble:probability=0.3",
                                 "duplicate:every=2",
                                 "delay:time=200ms,jitter=100ms",
                                 "slow:rate=100B/s",
                                 "cut:probability=0.3",
                                 "merge:probability=0.3",
                                 "nul_burst:probability=0.3,where=inside",
                                 "stray_ok:every=2",
                                 "wrong_checksum:every=2",
                                 "silence:probability=0.3,for=700ms",
                                 "disconnect:probability=0.3,for=700ms"};
    CHECK(std::size(specs) == kinds().size());
    for (const std::string& spec : specs) {
        CAPTURE(spec);
        Bench clean;
        Bench bench;
        CHECK(bench.run(ms(20'000)) == clean.run(ms(20'000)));
        bench.add(spec);
        CHECK(bench.run(ms(20'000)) != clean.run(ms(20'000)));
        const FaultStatus status = bench.faults.list(SimTime{0}).at(0);
        CHECK(status.acted > 5);
        CHECK(bench.faults.to_screen().list(SimTime{0}).at(0).acted > 0);
        CHECK(bench.faults.to_board().list(SimTime{0}).at(0).acted > 0);

        bench.clear();
        bench.run(ms(3000));  // a line cut in two at the end of the fault, and what is queued
        const std::uint64_t bad = bench.counters().bad_frames;
        const std::string after = bench.run(ms(20'000));
        CHECK(bench.faults.connected(ms(43'000)));
        CHECK(answers(after) == 40);
        CHECK(judge(after).second == 0);
        CHECK(bench.counters().bad_frames == bad);
    }
}

TEST_CASE("board: all faults together, twice the same") {
    const auto course = [] {
        Bench bench;
        for (const char* spec : {"silence:probability=0.01,seed=1", "drop:probability=0.1,seed=2",
                                 "garble:probability=0.1,seed=3", "duplicate:probability=0.1,seed=4",
                                 "cut:probability=0.1,seed=5", "merge:probability=0.1,seed=6",
                                 "nul_burst:probability=0.1,seed=7", "wrong_checksum:probability=0.1,seed=8",
                                 "delay:probability=0.5,jitter=200ms,seed=9", "slow:rate=11520B/s",
                                 "disconnect:every=50,for=1s"}) {
            bench.add(spec);
        }
        const std::string spoiled = bench.run(ms(60'000));
        bench.clear();
        bench.run(ms(3000));
        const std::string after = bench.run(ms(10'000));
        CHECK(answers(after) == 20);
        CHECK(judge(after).second == 0);
        return spoiled;
    };
    const std::string once = course();
    CHECK(judge(once).first > 20);
    CHECK(judge(once).second > 5);
    CHECK(course() == once);
}
