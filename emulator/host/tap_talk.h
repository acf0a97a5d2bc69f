#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/host/live_observer.h"
#include "emulator/host/tap.h"
#include "emulator/host/tap_cutter.h"
#include "emulator/record/pcapng.h"

namespace fauxboard::host {

/// Makes the talk of a board and a screen of the bytes that pass a tap: lines for a log and a recording,
/// packets for a capture.
///
/// Which end is the board shows in what is said: the first line that only one of the two can have said (see
/// record::telling_direction) decides, once and for all. What came before is kept back until then, up to
/// `undecided_limit` lines and packets; after those, the guess stands: the board is end B.
class TapTalk final : public TapObserver {
  public:
    static constexpr std::size_t undecided_limit = 32;
    static constexpr SimTime packet_pause{100'000};  ///< the start of a line is a packet after such a pause

    /// `lines` hears each line as a live board's observer does: on_sent from the board, on_received from the
    /// screen, ends of lines off, NULs left in. `packets` may be null. `board`: the end that is the board,
    /// where that is known. All outlive this.
    TapTalk(LiveObserver& lines, record::PcapngWriter* packets, std::optional<TapSide> board);

    void on_passed(SimTime now, TapSide from, std::string_view bytes) override;
    void on_link(SimTime now, TapSide side, link::LinkState state, std::string_view why) override;

    /// When tick() wants to be called next; `machine::never` if not at all.
    SimTime due() const;
    void tick(SimTime now);
    /// The tap has ended: what is unfinished or kept back goes out.
    void finish();

    /// Nothing while it has not been decided.
    std::optional<TapSide> board() const { return board_; }
    /// Lines that came from there.
    std::uint64_t lines(TapSide from) const { return of(from).lines; }

  private:
    struct Side {
        TapCutter line{TapCutter::LoneCr::ends};
        TapCutter packet{TapCutter::LoneCr::waits};
        SimTime heard{0};  ///< when the last bytes came
        std::uint64_t lines = 0;
    };
    struct Item {
        SimTime t;
        TapSide from;
        bool packet;
        std::string bytes;
    };

    void line(SimTime now, TapSide from, std::string_view piece);
    void put(SimTime now, TapSide from, bool packet, std::string_view bytes);
    void tell(SimTime now, TapSide from, bool packet, std::string_view bytes);
    void decide(TapSide board);
    Side& of(TapSide side) { return sides_[static_cast<std::size_t>(side)]; }
    const Side& of(TapSide side) const { return sides_[static_cast<std::size_t>(side)]; }

    LiveObserver& lines_;
    record::PcapngWriter* packets_;
    std::optional<TapSide> board_;
    std::array<Side, 2> sides_;
    std::vector<Item> undecided_;
};

}  // namespace fauxboard::host
