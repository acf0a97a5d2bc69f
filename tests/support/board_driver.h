#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"

namespace fauxboard::testing {

/// A shipped profile, loaded once per program.
std::shared_ptr<const behaviour::Profile> shipped_profile(std::string_view name);

/// What a line of the board says: the body of a frame whose checksum is right, else "raw:" and the line.
std::string said(std::string_view line);
/// The same of a board without frames too: there an "L2 ..." is as it stands.
std::string said(std::string_view line, const behaviour::Profile& profile);

/// The texts, a line each: what a failed comparison can show.
std::string join(const std::vector<std::string>& texts);

/// A board in virtual time, with all it said. Seconds count from its first power-on.
class BoardDriver final : private board::Observer {
  public:
    struct Line {
        double at = 0;
        std::string line;  ///< as on the wire, line end left off
        std::string body;  ///< said(line); of a board without frames an "L2 ..." is as it stands
    };
    struct Received {
        double at = 0;
        board::Channel channel{};
        std::string line;
        board::Verdict verdict{};
    };
    struct Reply {
        double at = 0;
        std::string line;
    };
    struct Setup {
        bool pacing = true;
        std::uint64_t seed = 1;
        machine::Services services{};
        double power_on_at = 0;
    };

    explicit BoardDriver(std::string_view profile = "geeetech-a30t") : BoardDriver(profile, Setup{}) {}
    BoardDriver(std::string_view profile, const Setup& setup)
        : BoardDriver(shipped_profile(profile), setup) {}
    BoardDriver(std::shared_ptr<const behaviour::Profile> profile, const Setup& setup);

    void run_until(double seconds);
    void run_for(double seconds) { run_until(now_ + seconds); }
    /// Runs on to the next reply to the USB side, but not beyond `seconds`; false when none came by then.
    bool run_until_reply(double seconds);
    double now() const { return now_; }

    /// Runs on into the stretch of the next round in which the schedule has nothing to say: 0.85 s from
    /// slot 4. Holds for the shipped profiles as long as nothing stalled the schedule.
    void run_to_quiet();

    /// The screen sends these requests, framed, in one go.
    void press_all(const std::vector<std::string>& bodies);
    void press(std::string_view body) { press_all({std::string(body)}); }
    /// Presses and gives what the board says within `seconds` from then.
    std::vector<std::string> ask(std::string_view body, double seconds = 0.6);
    /// Bytes from the screen as they are.
    void feed(std::string_view bytes);
    /// A line from the USB side, without its end.
    void host(std::string_view line);
    /// Something done to the machine; the phrase must exist.
    void world(std::string_view phrase);
    /// Tells the screen's firmware, so that L21 stops, and runs on until the answer is there.
    void meet_screen();
    /// The boot is over, the screen is known, and the board is in a stretch in which it says nothing by
    /// itself.
    void finish_boot();
    /// The whole hotend at once at that temperature.
    void heat_nozzle(double c);

    const std::vector<Line>& lines() const { return lines_; }
    /// What was said from `from` up to but not at `to`.
    std::vector<Line> between(double from, double to) const;
    std::vector<std::string> bodies(double from, double to = 1e9) const;
    /// The same as "0.05 L1 ...": times to the hundredth of a second.
    std::vector<std::string> timed(double from, double to = 1e9) const;
    /// Those of them that start so.
    std::vector<Line> matching(std::string_view start, double from = 0, double to = 1e9) const;
    /// What the board said to the USB side; somebody is there from the first host() on.
    const std::vector<Reply>& replies() const { return replies_; }
    const std::vector<Received>& received() const { return received_; }
    const std::vector<std::string>& notices() const { return notices_; }
    /// All that was said with its times to the microsecond, a line each.
    const std::string& transcript() const { return transcript_; }
    /// All bytes for the screen.
    const std::string& bytes() const { return bytes_; }

    double number(std::string_view path) const;
    std::string text(std::string_view path) const;

    board::Board& board() { return board_; }
    machine::Machine& machine() { return board_.machine(); }

  private:
    void on_received(board::SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(board::SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(board::SimTime now, board::Level level, std::string_view text) override;
    void take_output();

    std::vector<Line> lines_;
    std::vector<Reply> replies_;
    std::vector<Received> received_;
    std::vector<std::string> notices_;
    std::string transcript_;
    std::string bytes_;
    double now_ = 0;
    board::Board board_;
};

}  // namespace fauxboard::testing
