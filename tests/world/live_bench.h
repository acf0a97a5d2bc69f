#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/board/board.h"
#include "emulator/control/hub.h"
#include "emulator/control/session.h"
#include "emulator/control/target.h"
#include "emulator/touch/touch_screen.h"
#include "emulator/world/disk.h"
#include "emulator/world/stores.h"
#include "tests/support/dlp_bench.h"

namespace fauxboard::world {

using board::Channel;
using machine::SimTime;

/// A board with a card, somebody on each line, and somebody on the control channel.
class LiveBench final : private control::Target {
  public:
    /// What its machine prints, and how one asks it to.
    enum class Kind : std::uint8_t { filament, resin, dlp };

    explicit LiveBench(const std::shared_ptr<const behaviour::Profile>& profile);

    Kind kind() const { return kind_; }
    void pass(SimTime time);
    void say(Channel channel, const std::string& body);
    /// A request of the control channel, and what was heard there since the last one.
    std::string_view ask(const std::string& request);
    void machine(const std::function<void(machine::Machine&)>& use);
    /// An action as in profiles.
    void act(const std::string& action);

    /// The file of its kind, or another one; then `time` passes.
    void print(std::string_view file = {}, SimTime time = std::chrono::minutes(5));
    void pause();
    void stop();
    bool printing();
    bool has_screen() const { return screen_.has_value(); }
    void remove_cards();

    /// What came since the last question.
    std::string_view heard(Channel channel) const { return heard_[static_cast<std::size_t>(channel)]; }
    void forget(Channel channel) { heard_[static_cast<std::size_t>(channel)].clear(); }
    Disk& disk() { return disk_; }
    machine::Machine& printer() { return board_->machine(); }
    SimTime now() const { return now_; }

  private:
    void put_files();
    void take();

    const board::Board& board() const override { return *board_; }
    void visit(const std::function<void(board::Board&, SimTime)>& use) override;
    SimTime skip(SimTime by) override { return now_ + by; }
    void quit() override {}
    fault::FaultControl* faults() override { return nullptr; }
    control::Json status() const override { return control::Json::object(); }
    control::Display* display() override { return display_.get(); }

    std::shared_ptr<const behaviour::Profile> profile_;
    Kind kind_;
    Disk disk_;
    Eeprom eeprom_;
    testing::MemoryCells cells_;
    JobPlace place_;
    control::Hub hub_{*this};
    std::optional<touch::TouchScreen> screen_;  ///< part of the board
    std::optional<board::Board> board_;
    std::unique_ptr<control::Display> display_;
    std::optional<control::Session> session_;
    SimTime now_{0};
    std::array<std::string, behaviour::channel_count> heard_;
    std::string answered_;
};

}  // namespace fauxboard::world
