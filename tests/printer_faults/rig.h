#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/control/hub.h"
#include "emulator/control/session.h"
#include "emulator/screen/screen.h"

namespace fauxboard::testing {

using machine::SimTime;

/// A card with one long file, long.gcode: homing, heating, then an hour of moves that extrude.
class LongCard final : public machine::Volume {
  public:
    LongCard();
    bool list(std::string_view folder, std::vector<machine::CardEntry>& out) const override;
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;

  private:
    std::string text_;
};

/// A board with the long card, its touch screen, and a client of its control channel, in virtual time.
/// Seconds count from power-on.
class Rig final : private control::Target, private board::Observer {
  public:
    struct Line {
        double at = 0;
        std::string body;  ///< as said() gives it
    };

    /// `specs` are there from the start, as `run --fault` has them.
    explicit Rig(const std::string& board, const std::string& screen,
                 const std::vector<std::string>& specs = {});

    void run_until(double seconds);
    void run_for(double seconds) { run_until(machine::to_seconds(now_) + seconds); }
    double now() const { return machine::to_seconds(now_); }

    /// The request is sent to the board as the screen does, framed.
    void press(std::string_view body);
    void host(std::string_view line);
    /// A request on the control channel; gives the answer.
    control::Json ask(const control::Json& request);
    /// The same, which must be done.
    control::Json do_it(const control::Json& request);
    control::Json add_fault(const std::string& spec) { return do_it({{"op", "faults.add"}, {"spec", spec}}); }

    /// What the board said from `from` on.
    std::vector<std::string> said_since(double from) const;
    double number(std::string_view path);
    std::string text(std::string_view path);
    /// The code of the exception page that is open; nothing when none is.
    std::optional<int> exception_page() const;
    /// Sentences of the lines that the screen would crash on.
    std::string crashes() const;
    /// The board still answers a request.
    bool answers();
    machine::Machine& machine() { return board_.machine(); }
    std::uint64_t requests_lost() const { return board_.counters().requests_lost; }

  private:
    const board::Board& board() const override { return board_; }
    void visit(const std::function<void(board::Board&, SimTime)>& use) override;
    SimTime skip(SimTime by) override { return now_ + by; }
    void quit() override {}
    fault::FaultControl* faults() override { return nullptr; }
    control::Json status() const override { return control::Json::object(); }
    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;
    void exchange();

    LongCard card_;
    control::Hub hub_;
    board::Board board_;
    screen::Screen screen_;
    control::Session session_;
    std::vector<Line> lines_;
    SimTime now_{0};
    SimTime board_due_{0};
    SimTime screen_due_{0};
};

}  // namespace fauxboard::testing
