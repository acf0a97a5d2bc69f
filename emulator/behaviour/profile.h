#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/frame_template.h"
#include "emulator/behaviour/rules.h"
#include "emulator/behaviour/source.h"
#include "emulator/machine/kind.h"
#include "emulator/machine/machine_config.h"
#include "protocol/framing.h"

namespace fauxboard::behaviour {

using machine::SimTime;

/// The lines of a control board.
enum class Channel : std::uint8_t {
    main,     ///< the one `run --port` opens: the plug of a touch screen, the serial line of a resin board
    host,     ///< the USB port of a board with a screen, where a PC sends G-code
    network,  ///< datagrams
};
inline constexpr std::size_t channel_count = 3;

/// How commands are framed on the main line.
enum class Framing : std::uint8_t {
    frames,    ///< "N-0 M105*10"; a profile says "smartto"
    lines,     ///< "M105", or "N12 M105*36"; number and checksum are taken off and not judged; "gcode"
    commands,  ///< as on the USB side: numbers, resends, a queue, one command after the other; "marlin"
};

/// How the main line is spoken.
struct LineConfig {
    Framing framing = Framing::frames;
    bool framed = true;  ///< frames that do not say theirs leave as "N-0 ...*XOR"; else as bare lines
    unsigned baud = 115200;
    protocol::ChecksumPolicy checksum = protocol::ChecksumPolicy::required;
    unsigned queue_lines = 64;  ///< requests waiting for their tick; more are lost, as in the board's buffer
    std::string peer = "screen";  ///< what logs call the other end
    bool optional = false;        ///< nothing need be there: the board may run with its USB side alone
    bool none = false;            ///< the board has no line at all
    SimTime unfinished{0};  ///< a line without an end is taken for whole after so long a silence; 0: never
    /// A small board's receiving ring, emptied with each tick, and the longest line; 0: as much as there is.
    /// With either, NULs end a line's text, and comments are left out.
    unsigned ring_bytes = 0;
    unsigned line_bytes = 0;
    char comment = 0;  ///< begins a comment; 0: nothing does
    std::string
        codes;  ///< the first of these letters in a line begins its command, whatever stands before it
    bool small() const { return ring_bytes != 0 || line_bytes != 0; }
};

/// One message the board can send: one line, or several that leave together.
struct Frame {
    struct Line {
        FrameTemplate text;
        bool for_each_entry = false;  ///< once per entry of the card's listing
        bool all_files = false;       ///< which is that of all files, not of the folder shown
        std::vector<Condition> when;  ///< only then, or of these entries only
    };
    std::string name;
    protocol::FrameStyle style = protocol::FrameStyle::framed;
    protocol::LineEnd end = protocol::LineEnd::crlf;
    bool chunk = false;         ///< no lines: the block of a file that transfer.block read
    std::optional<Channel> to;  ///< nothing: the channel that asked; the main line, if nobody asked
    std::optional<std::size_t>
        cell;                 ///< of a board that queues codes: where its arguments are kept until it leaves
    bool everywhere = false;  ///< to the main line and to the USB side
    std::vector<Line> lines;
    std::vector<ActionCall> then;  ///< done when it is queued
    std::vector<const Field*>
        watched;  ///< fields some slot compares with their values when this was last sent
};

/// One slot of the schedule.
struct Slot {
    std::optional<std::size_t> frame;  ///< nothing: an empty slot
    std::vector<Condition> when;
    std::vector<std::size_t> when_changed;  ///< indices into Frame::watched: send only if one differs
    std::vector<std::size_t>
        or_changed;  ///< indices into Frame::watched: send also in a silent round if one differs
    unsigned every_rounds = 1;
    unsigned first_round = 0;
    std::optional<std::size_t> only_with;  ///< only in rounds in which this frame went out
    bool always = false;                   ///< due by time alone: nothing but the round count decides
    bool now = false;                      ///< written at once instead of on the transmit tick
    bool starts_told = false;              ///< what is so at power-on counts as told
};

struct Schedule {
    SimTime slot{300'000};
    SimTime first{0};  ///< of slot 0, from power-on
    std::vector<Slot> slots;
    std::vector<std::vector<Condition>> frozen_while;  ///< any of them

    bool frozen(const Scope& scope) const {
        for (const std::vector<Condition>& conditions : frozen_while) {
            if (all_hold(conditions, scope)) {
                return true;
            }
        }
        return false;
    }
};

/// What a profile calls a code or a line of its own, and its fields by their keys.
struct CodeWords {
    std::string title;
    std::map<std::string, std::string, std::less<>> fields;
};

/// Rules by code: what every request is looked up in.
class CodeTable {
  public:
    /// The rules of a code, none at first. References last until the next new code.
    std::vector<Rule>& operator[](std::uint32_t key);
    /// Null when the code has none.
    const std::vector<Rule>* find(std::uint32_t key) const {
        if (slots_.empty()) {
            return nullptr;
        }
        for (std::size_t at = place(key);; at = (at + 1) & (slots_.size() - 1)) {
            const std::uint32_t index = slots_[at];
            if (index == no_entry) {
                return nullptr;
            }
            if (entries_[index].key == key) {
                return &entries_[index].rules;
            }
        }
    }

  private:
    struct Entry {
        std::uint32_t key;
        std::vector<Rule> rules;
    };
    static constexpr std::uint32_t no_entry = ~std::uint32_t{0};

    /// Where to look first: the upper bits of a product spread codes that lie close together.
    std::size_t place(std::uint32_t key) const { return (key * 0x9E3779B1U >> 16U) & (slots_.size() - 1); }

    void enter(std::size_t index);

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> slots_;  ///< indices of entries; a power of two of them, at least half empty
};

/// A profile, checked and compiled: everything a board of this kind says and does. Immutable, shared by all
/// its boards.
class Profile {
  public:
    std::string name;
    std::string title;
    std::string screen;              ///< name of the screen that is part of the board; empty: it has none
    std::vector<std::string> files;  ///< what it was read from, base first
    /// For logs, by how a line begins: "M2999", "L18 P26 S3". See own_words.h.
    std::map<std::string, CodeWords, std::less<>> words;
    LineConfig line;
    SimTime tick{50'000};
    SimTime first_tick{0};  ///< from power-on
    /// A longer message leaves in pieces of at most so many bytes, of whole lines, a tick each; 0: never.
    unsigned burst_bytes = 0;
    unsigned piece_bytes = 0;
    unsigned queue_codes = 0;    ///< frames that can wait, if the board stores which and not what; else 0
    std::size_t code_cells = 0;  ///< of Frame::cell
    std::vector<Frame> frames;
    std::vector<Send> boot;
    Schedule schedule;
    std::vector<VariableInfo> variables;
    std::vector<ActionCall> defaults;  ///< put into the machine at every power-on, before the EEPROM
    std::shared_ptr<const machine::MachineConfig> machine;
    const machine::Kind* kind = nullptr;  ///< of machine: what `machine` is a configuration of
    /// Rules for an event of the kind, by machine::event_index().
    std::vector<std::vector<Rule>> events;
    const std::vector<Rule>& rules_for(machine::EventId event) const {
        return events[machine::event_index(*kind, event)];
    }

    /// Rules for a request on the main line and the network, or of the USB host; null when there are none.
    const std::vector<Rule>* rules_for(Channel channel, const protocol::Command& command) const {
        const bool host = channel == Channel::host || line.framing == Framing::commands;
        return find(host ? host_requests : requests, command);
    }

    struct RequestTable {
        /// The key of the rules for all that has none of its own.
        static constexpr std::string_view any_request = "*";
        const std::vector<Rule>* any() const;  ///< null: there are none
        CodeTable codes;                       ///< by code_key
        std::map<std::string, std::vector<Rule>, std::less<>> words;
    };
    RequestTable requests;
    RequestTable host_requests;
    std::vector<std::string> urgent;  ///< numbers of the M codes whose rules are carried out at once

    static std::uint32_t code_key(char letter, std::uint32_t number) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(letter)) << 16U | (number & 0xFFFFU);
    }

  private:
    static const std::vector<Rule>* find(const RequestTable& table, const protocol::Command& command);
};

/// Checks and compiles. Throws ProfileError with everything that is wrong.
std::shared_ptr<const Profile> load_profile(const SourceText& source, const SourceFinder& find);

}  // namespace fauxboard::behaviour
