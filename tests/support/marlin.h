#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/machine/memory_volume.h"

namespace fauxboard::testing {

/// One row of tests/vectors/marlin.json.
struct MarlinVector {
    std::string name;
    std::string world;  ///< done before; empty: nothing
    std::vector<std::string> send;
    std::string reply;  ///< bytes
};
std::vector<MarlinVector> marlin_vectors();
/// The profile that the vectors are for.
std::string marlin_profile();

inline bool has(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// A board that speaks as a host on both of its lines, in virtual time, with the bytes it said on each.
class MarlinBench {
  public:
    /// One second after power-on, with a card that holds TEST.GCO of 1234 bytes.
    explicit MarlinBench(const std::string& profile = "marlin");
    explicit MarlinBench(std::shared_ptr<const behaviour::Profile> profile);

    machine::MemoryVolume card{{{"Long folder", true, {}, {}}}};

    void world(std::string_view phrase);
    /// Bytes from the other end of a line.
    void feed(std::string_view bytes, board::Channel channel = board::Channel::main);
    /// A line, and a moment for its answer.
    void say(std::string_view line, board::Channel channel = board::Channel::main, double seconds = 0.05);
    void run_for(double seconds);
    /// All axes; what was said of it is forgotten.
    void home();
    /// What the board said on the line since forget().
    const std::string& said(board::Channel channel = board::Channel::main) const {
        return said_[static_cast<std::size_t>(channel)];
    }
    void forget() { said_ = {}; }
    /// forget(), say() and said().
    std::string told(std::string_view line, double seconds = 0.05,
                     board::Channel channel = board::Channel::main);
    void put(const std::string& name, const std::string& text);
    double now() const { return now_; }
    double number(std::string_view path) const;
    board::Board& board() { return board_; }

  private:
    void take();

    board::Board board_;
    std::array<std::string, behaviour::channel_count> said_{};
    double now_ = 0;
};

}  // namespace fauxboard::testing
