// A whole board, fed arbitrary bytes at arbitrary times.
//
// The input is a script: two digits, then one step a line. The first digit adds up 1 (no pacing), 2 (run it
// again byte by byte: the answers must be the same), 4 (with an observer), 8 (a card that can be
// written to); the second chooses the profile. Steps:
//   s M115      a request from the screen, framed rightly
//   r ~M115|    bytes from the screen as they are: ~ is LF, ` is CR, ^ is NUL, | is CR LF
//   h M105~     the same from the USB side
//   w card out  something done to the machine; unknown names are refused
//   a 1500      ms go by
//   j 30000     ms go by in which nobody calls the board
//   b 10        the next step comes with a time this many ms ago
//   l 1         another profile is put in force
//   p           power off and on

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "protocol/framing.h"
#include "tests/fuzz/support.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::fuzz {
namespace {

using board::Board;
using machine::SimTime;

constexpr std::array<std::string_view, 3> profiles{"geeetech-a30t", "geeetech-a30", "geeetech-a30t-no-card"};
constexpr SimTime longest{900'000'000};  ///< virtual, of one script
constexpr std::size_t many_stops = 20'000;
/// What one step may put out: 16 KiB without pacing, what one more rule says, and host lines, which are
/// answered at once, with one frame each.
constexpr std::size_t output_bound = 256UL * 1024;
constexpr std::uint64_t card_room = 4096;
constexpr std::string_view old_content = "G28";

/// Looks at every byte it is told of, so that a sanitizer sees a view that is not alive.
class Witness final : public board::Observer {
  public:
    void on_received(SimTime now, board::Channel, std::string_view line, board::Verdict) override {
        look(now, line);
    }
    void on_sent(SimTime now, board::Channel, std::string_view line) override { look(now, line); }
    void on_notice(SimTime now, board::Level, std::string_view text) override { look(now, text); }

  private:
    void look(SimTime now, std::string_view text) {
        require(now >= last_, "the observer's time went back");
        last_ = now;
        sum_ += protocol::xor_checksum(text);
    }
    SimTime last_{0};
    unsigned sum_ = 0;
};

/// One run of one script. The transcript is everything said and when.
class Run {
  public:
    static constexpr std::size_t heads = 2;

    /// Mode (a digit) and profile.
    Run(const std::array<unsigned, heads>& head, bool split)
        : split_(split),
          board_(shipped_profile(profiles[head[1] % profiles.size()]), services((mode_of(head[0]) & 8U) != 0),
                 {(mode_of(head[0]) & 1U) == 0, 7, (mode_of(head[0]) & 4U) != 0 ? &witness_ : nullptr}) {
        board_.power_on(now_);
    }

    void step(std::string_view line);
    /// The board must come to rest, and then still answer.
    void finish();
    const std::string& transcript() const { return transcript_; }

  private:
    machine::Services services(bool writable) {
        disk_.put("old.gco", std::string(old_content));
        disk_.set_room(card_room);
        machine::Services made;
        made.sd = writable ? &disk_ : nullptr;
        return made;
    }
    void feed(bool host, std::string_view bytes);
    void pass(SimTime time);
    void take(SimTime time, std::string_view output);

    bool split_;
    testing::MemoryDisk disk_;
    Witness witness_;
    SimTime now_{0};
    SimTime back_{0};
    Board board_;
    std::string transcript_;
    std::string unfinished_;  ///< the beginning of a line whose end is still to come
    bool answered_ = false;
};

void Run::take(SimTime time, std::string_view output) {
    // A long list may leave in pieces, which end where they end.
    unfinished_.append(output);
    const std::size_t end = unfinished_.rfind("\r\n");
    if (end != std::string::npos) {
        check_output(std::string_view(unfinished_).substr(0, end + 2), true);
        unfinished_.erase(0, end + 2);
    }
    require(unfinished_.size() <= output_bound, "a line without an end");
    require(output.size() <= output_bound, "output grows without bound");
    answered_ = answered_ || output.find("L9 DN:") != std::string_view::npos;
    transcript_.append(std::to_string(time.count())).append(" ").append(output);
}

void Run::feed(bool host, std::string_view bytes) {
    if (bytes.empty()) {
        return;  // no link hands over nothing; a call at all makes the board catch up
    }
    const SimTime when = std::max(SimTime{0}, now_ - back_);
    const auto give = [&](std::string_view piece) {
        board_.receive(when, piece, host ? board::Channel::host : board::Channel::main);
    };
    if (split_) {
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            give(bytes.substr(i, 1));
        }
    } else {
        give(bytes);
    }
    const bool spoke = !board_.output().empty();
    require(board_.output(board::Channel::host).size() <= output_bound,
            "output to the host grows without bound");
    if (spoke) {
        take(board_.time(), board_.output());
    }
    board_.clear_output();
}

void Run::pass(SimTime time) {
    now_ += time;
    advance_to(board_, now_, many_stops, [this](SimTime t, std::string_view bytes) { take(t, bytes); });
}

void Run::step(std::string_view line) {
    if (line.size() > 1 && line[1] != ' ') {
        return;
    }
    const std::string_view text = line.substr(std::min<std::size_t>(line.size(), 2));
    unsigned number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    const SimTime ms{std::int64_t{number} * 1000};
    switch (line[0]) {
        case 's':
            feed(false, protocol::frame(text.substr(0, protocol::max_line_bytes)));
            break;
        case 'r':
            feed(false, unescape(text));
            break;
        case 'h':
            feed(true, unescape(text));
            break;
        case 'w':
            board_.world(now_, text);
            break;
        case 'a':
            pass(std::clamp(ms, SimTime{0}, longest - std::min(now_, longest)));
            break;
        case 'j':
            now_ += std::min(ms, longest - std::min(now_, longest));
            break;
        case 'b':
            back_ = ms;
            return;
        case 'l':
            board_.reload(shipped_profile(profiles[number % profiles.size()]));
            break;
        case 'p':
            board_.power_on(now_);
            break;
        default:
            return;
    }
    back_ = SimTime{0};
}

void Run::finish() {
    feed(false, "\n");
    // A small board answers nothing while it homes or heats up, one code after the other.
    pass(std::chrono::hours(1));
    answered_ = false;
    // Twice: where a small ring was full, a line end may be lost, and the first one hangs behind half a line.
    for (int i = 0; i < 2; ++i) {
        feed(false, protocol::frame("M115"));
        pass(std::chrono::seconds(10));
    }
    // A script may have sent the head so far that such a board is still at it.
    require(answered_ || board_.machine().restless(), "the board does not answer any more");
    // A file is there whole, was never touched, or was deleted. Lines written end with CR LF.
    const std::string* const old = disk_.content("old.gco");
    require(old == nullptr || old->empty() || *old == old_content || old->ends_with("\r\n"),
            "half a file stands under its name");
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fauxboard::fuzz::play_fuzzed<fauxboard::fuzz::Run>(data, size);
}
