#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

class Storage;

/// A file on its way onto the chosen disk, or off it, piece by piece. One at a time: it belongs to whoever
/// began it, and others are refused until it is closed, or until nothing came from its owner for
/// `idle_limit`.
///
/// An upload is written beside, and takes its name when it is finished: half a file never stands in place of
/// a whole one. Each function leaves its result in `outcome`, and says whether that is `done`.
class Transfer {
  public:
    /// Who speaks: a number of the caller's.
    using Peer = std::uint64_t;
    enum class Mode : std::uint8_t { none, upload, download };
    enum class Outcome : std::uint8_t {
        done,
        busy,      ///< another one's file is open, or an upload of the same one
        in_use,    ///< the file is being printed
        not_open,  ///< there is nothing to go on with
        no_name,   ///< a name that cannot be a file's
        no_disk,
        missing,       ///< no such file, or it cannot be read
        resend,        ///< a damaged piece, or not the one that is next: see expected()
        write_failed,  ///< full, gone, write-protected, or more than `max_bytes`
        at_end,        ///< no bytes from there on
    };

    static constexpr Peer serial_line = 0;
    /// The lines that are spoken as hosts speak are peers from here on, each one of its own.
    static constexpr Peer first_host_line = ~Peer{0} - 7;
    static constexpr Peer host_line(std::size_t number) { return first_host_line + number; }
    static constexpr bool is_host_line(Peer peer) { return peer >= first_host_line; }
    static constexpr bool is_network(Peer peer) { return peer != serial_line && !is_host_line(peer); }
    static constexpr std::size_t max_block = 1280;
    static constexpr SimTime idle_limit = std::chrono::seconds(30);
    static constexpr std::uint64_t max_bytes = 0x8000'0000;

    explicit Transfer(Storage& storage) : storage_(storage) {}

    /// Forgets what was open; what was written of it stays on the disk, as when the power goes.
    void power_on();

    /// M28. Again by its owner before the first piece, it is as if the first had been lost. A file of that
    /// name is replaced when it is finished, also one that is spelled otherwise where the disk does not tell
    /// cases apart. `in_use` is the path of a file that must stay, empty for none: also for finish().
    bool upload(SimTime now, Peer peer, std::string_view name, std::string_view in_use = {});
    /// A piece; not `intact` when its checksum was wrong.
    bool piece(SimTime now, Peer peer, bool intact, std::uint64_t offset, std::string_view bytes);
    /// M29: the upload is whole and takes its name. It is over even when that fails.
    bool finish(SimTime now, Peer peer, std::string_view in_use = {});
    /// M6032.
    bool download(SimTime now, Peer peer, std::string_view name);
    /// M3001, M3000 I: where the next block begins, to the byte.
    bool seek(SimTime now, Peer peer, std::uint64_t offset);
    /// The next block, into the start of `out`; `got` bytes of it. It began at `got` before position().
    bool block(SimTime now, Peer peer, std::span<char> out, std::size_t& got);
    /// M30: a file of the chosen disk goes; `name` counts from its root.
    bool remove(std::string_view name);
    /// M22: what is open is closed; of an upload nothing remains.
    bool close(SimTime now, Peer peer);

    /// What may become of a piece of an upload, or of a block of a download, on its way.
    enum class Mishap : std::uint8_t { none, lost, answer_lost, damaged, repeated };
    /// A network that misbehaves on purpose: how many of them meet with what, 0 to 1 each. A block is the
    /// answer itself.
    struct Trouble {
        double lost = 0;
        double answers_lost = 0;
        double damaged = 0;
        double repeated = 0;
        bool any() const { return lost > 0 || answers_lost > 0 || damaged > 0 || repeated > 0; }
        /// For a draw of 0 up to but not 1. Shares of more than 1 together: the first ones win.
        Mishap mishap(double draw) const;
    };
    Trouble trouble;  ///< outlives a reset of the board

    Outcome outcome = Outcome::done;
    /// Who sent the request that is being carried out; the board says it.
    Peer asker = serial_line;

    /// The block that goes out: what block() was last told to fill. It begins at position() less its size.
    struct Block {
        std::array<char, max_block> room{};
        std::size_t size = 0;
        std::string_view view() const { return {room.data(), size}; }
    };
    Block last_block;  ///< of the request that is being carried out

    Mode mode() const { return mode_; }
    bool by_network() const { return is_network(asker); }
    /// Whether this one's upload is open, so that what it sends may be pieces.
    bool takes_from(Peer peer) const { return mode_ == Mode::upload && peer == owner_; }
    /// As it was asked for; stays when it is over.
    const std::string& name() const { return name_; }
    /// The name that was last asked for, refused or not.
    const std::string& asked() const { return asked_; }
    /// Whether the disk had a file of the name when the upload began.
    bool existed() const { return existed_; }
    /// The place in the file that the next piece or block begins at.
    std::uint64_t position() const { return position_; }
    /// Of the file that is downloaded.
    std::uint64_t bytes() const { return bytes_; }

  private:
    bool say(Outcome result);
    /// Whether `peer` may begin: nothing is open, or what is has been left alone. Closes that then.
    bool may_begin(SimTime now, Peer peer);
    /// Whether `peer` may go on with what is open.
    bool may_go_on(SimTime now, Peer peer, Mode mode);
    void drop();
    /// Whether the disk has the file already, and where.
    bool look_for(std::string_view name);

    Storage& storage_;
    Mode mode_ = Mode::none;
    Peer owner_ = 0;
    SimTime last_{0};
    int disk_ = 0;
    std::string name_;
    std::string asked_;
    std::string path_;
    std::string beside_;    ///< where an upload lies until it is finished
    std::string replaced_;  ///< path of the file that the upload takes the place of
    bool existed_ = false;
    std::uint64_t position_ = 0;
    std::uint64_t bytes_ = 0;
};

/// "no_disk": for conditions.
std::string_view to_string(Transfer::Outcome outcome);
std::string_view to_string(Transfer::Mode mode);

}  // namespace fauxboard::machine
