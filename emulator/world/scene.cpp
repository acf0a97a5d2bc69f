#include "emulator/world/scene.h"

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

void Scene::advance(board::SimTime now, board::Board& board, screen::Screen* screen) {
    now_ = now;
    board_ = &board;
    screen_ = screen;
    if (player_->done()) {
        player_ = std::make_unique<script::Player>(scenario_, 0);
    }
    due_ = player_->advance(now, board::SimTime{0}, *this);
    if (player_->done()) {
        due_ = now + rest;
    }
}

void Scene::visit(const std::function<void(board::Board&, board::SimTime)>& use) {
    use(*board_, now_);
}

screen::PressResult Scene::press(std::string_view path) {
    return screen_->press(path, now_);
}

}  // namespace fauxboard::world
