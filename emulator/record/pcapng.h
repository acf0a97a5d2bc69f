#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "emulator/link/output_file.h"
#include "emulator/machine/sim_time.h"
#include "protocol/catalogue.h"

namespace fauxboard::record {

// Captures for Wireshark: pcapng (IETF draft-ietf-opsawg-pcapng), little endian, link type
// LINKTYPE_RTAC_SERIAL.
//
// That link type is the registered one for the bytes of a serial line: Wireshark opens it with nothing
// installed, with the direction in words, where LINKTYPE_USER0 shows an error until the user has set it up.
// Each packet begins with its 12 bytes: seconds and microseconds since 1970 (big endian), the event (1: the
// board transmits, 2: it receives), the control lines (none) and two zeros.
//
// Two interfaces, "board" and "other end": who said it. The direction stands in each packet's flags as well,
// as the board sees it: what it says is outbound.

inline constexpr std::uint16_t pcapng_link_type = 250;
inline constexpr std::size_t pcapng_event_bytes = 12;

/// The blocks that a capture starts with: one section, two interfaces.
std::string pcapng_head();

/// One packet. `since_epoch` is real time.
std::string pcapng_packet(machine::SimTime since_epoch, protocol::Direction direction,
                          std::string_view bytes);

// Captures of something else than a line hold its bytes as they are, in a link type that is left to users:
// Wireshark shows them with the dissector in tools/fauxboard.lua.
inline constexpr std::uint16_t pcapng_user_type = 152;  // LINKTYPE_USER5

/// One section, one interface.
std::string pcapng_user_head(std::string_view interface, std::string_view description);
std::string pcapng_user_packet(machine::SimTime since_epoch, bool outbound, std::string_view bytes);

/// Writes a capture, each packet at once, so that a kill loses none.
class PcapngWriter {
  public:
    /// Told once, when the capture had to end early: a full disk ends the capture, not the tap.
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// Creates or empties `file`. `start`: real time, since 1970, at which the tap's time was 0. Throws
    /// link::HostError: see link::OutputFile.
    PcapngWriter(std::string file, machine::SimTime start, OnTrouble on_trouble,
                 std::string_view head = pcapng_head(), std::chrono::milliseconds patience = {});

    void packet(machine::SimTime now, protocol::Direction direction, std::string_view bytes);
    /// A packet that was made already.
    void block(std::string_view packet);
    /// No more comes; what a slow reader has not taken by now it may lose, which is told.
    void finish();
    machine::SimTime start() const { return start_; }
    std::uint64_t packets() const { return packets_; }

  private:
    bool write(std::string_view block);

    std::string file_;
    machine::SimTime start_;
    OnTrouble on_trouble_;
    link::OutputFile out_;
    std::uint64_t packets_ = 0;
};

}  // namespace fauxboard::record
