#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "emulator/script/player.h"

namespace fauxboard::world {

/// A user's scenario that is played in a world, over and over, beside all else that happens. That its waits
/// end in vain is no harm, for the world is in its way: what counts are the world's promises.
class Scene final : private script::Stage {
  public:
    explicit Scene(std::shared_ptr<const script::Scenario> scenario);
    ~Scene() override;

    /// Does what is due. Returns when it wants to be called next, if nothing passes before. To be called with
    /// each time, and again when something was done().
    board::SimTime advance(board::SimTime now, board::Board& board, screen::Screen* screen);
    /// Whether the last advance() did something to the board or the screen.
    bool acted() const { return acted_; }
    /// To be told what passes on the board.
    board::Observer& observer() { return *player_; }

  private:
    void visit(const std::function<void(board::Board&, board::SimTime)>& use) override;
    /// The world has faults of its own.
    fault::FaultControl* faults() override { return nullptr; }
    const screen::Screen* screen() override { return screen_; }
    screen::PressResult press(std::string_view path) override;
    void note(std::string_view /*words*/) override {}

    std::shared_ptr<const script::Scenario> scenario_;
    std::unique_ptr<script::Player> player_;
    std::optional<board::SimTime> again_;  ///< when it begins anew
    board::SimTime now_{0};
    board::Board* board_ = nullptr;     ///< while advance() lasts
    screen::Screen* screen_ = nullptr;  ///< the same
    bool acted_ = false;
};

}  // namespace fauxboard::world
