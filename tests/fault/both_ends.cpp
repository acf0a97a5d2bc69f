#include "tests/fault/both_ends.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"

namespace fauxboard::fault {
namespace {

constexpr SimTime between_touches{400'000};
constexpr std::array touched{"Control/Filament/Hotend on", "Steps/mm/Rset", "Control/Speed/Fan on",
                             "Control/Motion Param/Jerk", "Control/Speed/Fan off"};

const std::shared_ptr<const behaviour::Profile>& board_profile() {
    static const auto profile = host::load_profile_by_name("geeetech-a30t");
    return profile;
}

const std::shared_ptr<const screen::ScreenProfile>& screen_profile() {
    static const auto profile = host::load_screen_by_name("geeetech-a30t");
    return profile;
}

}  // namespace

BothEnds::BothEnds() : board_(board_profile(), {}, {true, 1, nullptr}), screen_(screen_profile()) {
    board_.power_on(now_);
    screen_.power_on(now_);
}

void BothEnds::run(SimTime time) {
    to_screen = to_board = {};
    pass(now_ + time, true, nullptr);
}

bool BothEnds::met(std::vector<std::string> buttons) {
    screen::Tour tour(screen_, std::move(buttons), SimTime{0});
    for (const SimTime end = now_ + std::chrono::minutes(2); !tour.done() && now_ < end;) {
        pass(now_ + between_touches, false, &tour);
    }
    for (const screen::TourResult& result : tour.results()) {
        CHECK_MESSAGE(result.verdict == screen::TourVerdict::met, result.sentence);
    }
    return tour.done() && tour.passed() && tour.results().size() == tour.total();
}

/// Not every touch meets a button: a screen that has crashed is deaf for a while.
void BothEnds::touch() {
    screen_.press(touched[touches_++ % touched.size()], now_);
    touch_due_ = now_ + between_touches;
}

bool BothEnds::exchange(screen::Tour* tour) {
    bool moved = false;
    board_due_ = board_.advance(now_);
    if (!board_.output().empty()) {
        to_screen.said.add(now_, board_.output());
        faults.to_screen().push(now_, board_.output());
        board_.clear_output();
        moved = true;
    }
    screen_due_ = tour != nullptr ? tour->advance(now_) : screen_.advance(now_);
    if (!screen_.output().empty()) {
        to_board.said.add(now_, screen_.output());
        faults.to_board().push(now_, screen_.output());
        screen_.clear_output();
        moved = true;
    }
    faults_due_ = faults.advance(now_);
    if (std::exchange(up_, faults.connected(now_)) && !up_) {
        ++times_down;
    }
    if (const std::string bytes(faults.to_screen().output()); !bytes.empty()) {
        faults.to_screen().clear_output();
        to_screen.came.add(now_, bytes);
        screen_.receive(now_, bytes);
        moved = true;
    }
    if (const std::string bytes(faults.to_board().output()); !bytes.empty()) {
        faults.to_board().clear_output();
        to_board.came.add(now_, bytes);
        board_.receive(now_, bytes);
        moved = true;
    }
    return moved;
}

void BothEnds::pass(SimTime end, bool touches, screen::Tour* tour) {
    while (true) {
        if (touches && touch_due_ <= now_) {
            touch();
        }
        while (exchange(tour)) {
        }
        SimTime next = std::min({board_due_, screen_due_, faults_due_});
        next = touches ? std::min(next, touch_due_) : next;
        if (next >= end || (tour != nullptr && tour->done())) {
            break;
        }
        now_ = std::max(next, now_ + SimTime{1});
    }
    now_ = tour != nullptr && tour->done() ? now_ : end;
}

}  // namespace fauxboard::fault
