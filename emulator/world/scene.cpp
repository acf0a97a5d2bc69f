#include "emulator/world/scene.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace fauxboard::world {
namespace {

/// From its end, good or bad, to its next beginning.
constexpr board::SimTime rest = std::chrono::minutes(1);

}  // namespace

Scene::Scene(std::shared_ptr<const script::Scenario> scenario)
    : scenario_(std::move(scenario)), player_(std::make_unique<script::Player>(scenario_, 0)) {}

Scene::~Scene() = default;

board::SimTime Scene::advance(board::SimTime now, board::Board& board, screen::Screen* screen) {
    now_ = now;
    board_ = &board;
    screen_ = screen;
    acted_ = false;
    if (again_ && *again_ <= now) {
        again_.reset();
        player_ = std::make_unique<script::Player>(scenario_, 0);
    }
    board::SimTime due = machine::never;
    if (!player_->done()) {
        due = player_->advance(now, board::SimTime{0}, *this);
    }
    if (player_->done() && !again_) {
        again_ = now + rest;
    }
    return again_ ? *again_ : std::max(due, now);
}

void Scene::visit(const std::function<void(board::Board&, board::SimTime)>& use) {
    acted_ = true;
    use(*board_, now_);
}

screen::PressResult Scene::press(std::string_view path) {
    acted_ = true;
    return screen_->press(path, now_);
}

}  // namespace fauxboard::world
