#include "emulator/host/live_screen.h"

#include <algorithm>
#include <utility>

namespace fauxboard::host {
namespace {

/// Steps in a row before the event loop gets its turn, for a clock set faster than this computer can follow.
constexpr int steps_per_turn = 1024;
constexpr std::size_t inbox_limit = 1024UL * 1024;

}  // namespace

LiveScreen::LiveScreen(screen::Screen& screen, link::Link& link, Clock& clock, LiveObserver* observer,
                       ScreenUser* user)
    : screen_(screen),
      link_(link),
      clock_(clock),
      alarm_(clock.make_alarm([this] { turn(); })),
      observer_(observer),
      user_(user),
      head_start_(screen.profile().line.deaf),
      told_(screen.profile().values.size(), false) {}

void LiveScreen::start() {
    running_ = true;
    clock_.start();
    screen_.power_on(SimTime{0});
    screen_.advance(head_start_);
    send_output();
    alarm_->at(SimTime{0});
}

void LiveScreen::lead(screen::Tour* tour) {
    screen_.advance(now());  // its time stands still while nothing happens; a tour's limits start there
    send_output();
    tour_ = tour;
    alarm_->at(clock_.now());
}

screen::PressResult LiveScreen::press(std::string_view path, std::size_t row, std::optional<double> input) {
    screen::PressResult result = screen_.press(path, row, input, now());
    send_output();
    alarm_->at(clock_.now());
    return result;
}

screen::PressResult LiveScreen::touch(std::size_t button, std::size_t row, std::optional<double> input) {
    screen::PressResult result = screen_.touch(button, row, input, now());
    send_output();
    alarm_->at(clock_.now());
    return result;
}

void LiveScreen::send_output() {
    if (screen_.output().empty()) {
        return;
    }
    const std::string bytes(screen_.output());
    screen_.clear_output();
    link_.write(bytes);
    if (observer_ != nullptr) {
        to_board_.feed(bytes, [&](std::string_view line) {
            observer_->on_received(clock_.now(), board::Channel::main, line, board::Verdict::accepted);
        });
    }
}

void LiveScreen::tell_judgements() {
    const std::uint64_t last = screen_.counters().lines_received;
    if (last == seen_) {
        return;
    }
    const std::uint64_t told = std::exchange(seen_, last);
    for (const screen::Judgement& judgement : screen_.judgements()) {
        if (judgement.number <= told) {
            continue;
        }
        for (const screen::Carried& carried : judgement.carried) {
            told_[carried.value] = true;
        }
        if (user_ != nullptr) {
            user_->on_judged(judgement);
        }
    }
}

void LiveScreen::feed(SimTime now) {
    if (inbox_.empty()) {
        return;
    }
    // Pauses that were on the line are gone once its bytes have waited for this process to be run.
    const std::size_t size = std::min(screen_.room(), inbox_.size());
    if (size != 0) {
        screen_.receive(now, std::string_view(inbox_).substr(0, size));
        inbox_.erase(0, size);
    }
}

SimTime LiveScreen::advance(SimTime now) {
    return tour_ != nullptr ? tour_->advance(now) : screen_.advance(now);
}

void LiveScreen::turn() {
    if (!running_) {
        return;
    }
    const SimTime at = now();
    SimTime due = at;
    for (int i = 0; i < steps_per_turn && (due <= at || (!inbox_.empty() && screen_.room() != 0)); ++i) {
        feed(at);
        due = advance(at);
        send_output();
        tell_judgements();
    }
    if (user_ != nullptr) {
        due = std::min(due, user_->on_turn(at));
    }
    alarm_->at(due == machine::never ? due : std::max(SimTime{0}, line_time(due)));
}

void LiveScreen::on_bytes(std::string_view bytes) {
    from_board_.feed(bytes, [this](std::string_view line) {
        ++lines_heard_;
        if (observer_ != nullptr) {
            observer_->on_sent(clock_.now(), board::Channel::main, line);
        }
    });
    const std::size_t fits = std::min(bytes.size(), inbox_limit - inbox_.size());
    inbox_.append(bytes.substr(0, fits));
    bytes_dropped_ += bytes.size() - fits;
    turn();
}

void LiveScreen::on_state(link::LinkState state, std::string_view why) {
    if (observer_ != nullptr) {
        observer_->on_link(clock_.now(), state, why);
    }
    if (user_ != nullptr) {
        user_->on_link(state, why);
    }
}

}  // namespace fauxboard::host
