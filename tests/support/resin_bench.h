#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/fault/faults.h"
#include "tests/support/sliced_file.h"
#include "tests/support/transfer_client.h"

namespace fauxboard::testing {

/// A resin board in virtual time with both its ways in, a serial line whose bytes meet faults and a network,
/// and a stick in memory that can be written to.
class ResinBench {
  public:
    explicit ResinBench(std::string_view profile = "elegoo-mars-pro", std::uint64_t room = 100'000'000,
                        machine::EepromStore* eeprom = nullptr);

    /// As in `run --fault`: of the line, or of the printer.
    void fault(std::string_view spec);
    void clear_faults();

    void run_for(double seconds);
    /// What comes over the serial line within `seconds` of a request, with its line end.
    std::string ask(const std::string& line, double seconds = 0.1) { return say(line + "\r\n", seconds); }
    std::string say(std::string_view bytes, double seconds = 0.1);
    /// The answers to one datagram, at once.
    std::vector<std::string> send(std::string_view datagram, std::uint64_t peer = 11);
    TransferClient client(TransferClient::Trouble trouble = {}, std::uint64_t peer = 11);

    void world(std::string_view phrase);
    double number(std::string_view path);
    std::string text(std::string_view path);
    /// Runs on until a field has at least this value; false when it has not within `seconds`.
    bool reaches(std::string_view path, double value, double seconds = 3600);
    double now() const { return machine::to_seconds(now_); }

    MemoryDisk disk;
    board::Board board;

  private:
    void carry();

    fault::Faults faults_;
    machine::SimTime now_{0};
    machine::SimTime due_{0};
    std::string heard_;
    std::deque<std::pair<std::uint64_t, std::string>> answers_;
    machine::SimTime pause_;  ///< behind each datagram: some boards hang when they come too fast
};

}  // namespace fauxboard::testing
