#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "emulator/script/player.h"

namespace fauxboard::world {

/// A user's scenario that is played in a world, over and over, beside all else that happens. That its waits
/// end in vain is no harm, for the world is in its way: what counts are the world's promises.
class Scene final : private script::Stage {
  public:
    explicit Scene(std::shared_ptr<const script::Scenario> scenario);
    ~Scene() override;

    /// Does what is due.
    void advance(board::SimTime now, board::Board& board, screen::Screen* screen);
    /// When advance() is to be called, unless something has passed before.
    board::SimTime due() const { return due_; }
    bool is_due(board::SimTime now) const {
        return due_ <= now || (!player_->done() && player_->wants_turn());
    }
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
    board::SimTime due_{0};
    board::SimTime now_{0};
    board::Board* board_ = nullptr;     ///< while advance() lasts
    screen::Screen* screen_ = nullptr;  ///< the same
};

}  // namespace fauxboard::world
