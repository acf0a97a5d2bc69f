#include "tests/screen/partner.h"

#include <fmt/format.h>

#include <utility>

namespace fauxboard::testing {

namespace {

/// At 115200 bit/s.
constexpr SimTime piece_time{5000};
constexpr std::size_t piece_bytes = 57;

}  // namespace

Partner::Partner(std::shared_ptr<const screen::ScreenProfile> profile, Answer with)
    : answer(std::move(with)), screen_(std::move(profile)) {
    screen_.power_on(now_);
}

void Partner::pass(double seconds) {
    const SimTime end = now_ + machine::from_seconds(seconds);
    for (;;) {
        const SimTime next = screen_.advance(now_);
        rest_ += screen_.output();
        screen_.clear_output();
        for (std::size_t at = rest_.find('\n'); at != std::string::npos; at = rest_.find('\n')) {
            commands_.push_back(rest_.substr(0, at));
            rest_.erase(0, at + 1);
            inbox_ += answer(commands_.back());
        }
        if (!inbox_.empty() && wire_ <= now_) {
            screen_.receive(now_, std::string_view(inbox_).substr(0, piece_bytes));
            inbox_.erase(0, piece_bytes);
            wire_ = now_ + piece_time;
            continue;
        }
        const SimTime due = std::min(next, inbox_.empty() ? end + SimTime{1} : wire_);
        if (due > end) {
            break;
        }
        now_ = std::max(now_, due);
    }
    now_ = end;
}

void Partner::say(std::string_view bytes) {
    inbox_ += bytes;
    do {
        pass(0.02);
    } while (!inbox_.empty());
}

std::string Partner::press(std::string_view path) {
    const screen::PressResult result = screen_.press(path, now_);
    pass(0.1);
    return result.sentence;
}

std::string Partner::commands() {
    return fmt::format("{}", fmt::join(std::exchange(commands_, {}), " | "));
}

std::string Partner::found(screen::Verdict verdict) const {
    std::string out;
    for (const screen::Finding& finding : screen_.findings()) {
        if (finding.first.verdict == verdict) {
            out += finding.first.sentence() + "\n";
        }
    }
    return out;
}

}  // namespace fauxboard::testing
