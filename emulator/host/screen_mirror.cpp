#include "emulator/host/screen_mirror.h"

#include <algorithm>
#include <utility>

namespace fauxboard::host {
namespace {

/// So long a screen needs for one line: two looks into its buffer.
SimTime time_of_line(const screen::ScreenProfile& profile) {
    return 2 * profile.line.tick;
}

}  // namespace

ScreenMirror::ScreenMirror(Parts parts, const std::vector<std::string>& said)
    : parts_(std::move(parts)),
      // It was switched on long enough ago to have heard all that, line by line.
      head_start_(parts_.profile->line.deaf +
                  time_of_line(*parts_.profile) * static_cast<SimTime::rep>(said.size() + 2)),
      screen_(parts_.profile),
      alarm_(parts_.clock.make_alarm([this] { turn(); })) {
    screen_.power_on(SimTime{0});
    SimTime at = parts_.profile->line.deaf + time_of_line(*parts_.profile);
    for (const std::string& line : said) {
        while (screen_.advance(at) <= at) {
            screen_.clear_output();
        }
        screen_.receive(at, line + "\r\n");
        at += time_of_line(*parts_.profile);
    }
    const SimTime now = head_start_ + parts_.clock.now();
    while (screen_.advance(now) <= now) {
        screen_.clear_output();
    }
    screen_.clear_output();
    judged_ = screen_.counters().lines_received;
    settle(parts_.clock.now());
}

/// The screen's. The board lags behind the clock while it catches up; a screen's time never goes back.
SimTime ScreenMirror::time(SimTime now) const {
    return std::max(head_start_ + now, screen_.time());
}

void ScreenMirror::hear(SimTime now, std::string_view line) {
    screen_.receive(time(now), line);
    screen_.receive(time(now), "\r\n");
    alarm_->at(now + parts_.profile->line.tick);
}

screen::PressResult ScreenMirror::press(const std::string& button, std::size_t row,
                                        std::optional<double> input, SimTime now) {
    settle(now);
    screen::PressResult result = screen_.press(button, row, input, time(now));
    collect(true);
    settle(now);
    return result;
}

std::vector<std::string> ScreenMirror::take_requests() {
    return std::exchange(requests_, {});
}

void ScreenMirror::turn() {
    settle(parts_.clock.now());
    for (const std::string& line : take_requests()) {
        parts_.ask(line);
    }
}

/// Does what is due; what it says untouched is a request only when nobody else would say it.
void ScreenMirror::settle(SimTime now) {
    const SimTime at = time(now);
    SimTime next = screen_.advance(at);
    collect(false);
    for (int i = 0; next <= at && i < 1000; ++i) {
        next = screen_.advance(at);
        collect(false);
    }
    for (const screen::Judgement& judgement : screen_.judgements()) {
        if (judgement.number > judged_ && judgement.verdict != screen::Verdict::ok) {
            parts_.on_judged(std::max(judgement.at - head_start_, SimTime{0}), judgement);
        }
    }
    judged_ = std::max(judged_, screen_.judgements().empty() ? judged_ : screen_.judgements().back().number);
    alarm_->at(!requests_.empty() ? now : next == machine::never ? next : std::max(next - head_start_, now));
}

void ScreenMirror::collect(bool touched) {
    half_.append(screen_.output());
    screen_.clear_output();
    std::size_t at = 0;
    for (std::size_t end = half_.find('\n'); end != std::string::npos; end = half_.find('\n', at)) {
        std::string line = half_.substr(at, end - at);
        at = end + 1;
        if (line.ends_with('\r')) {
            line.pop_back();
        }
        if (touched || parts_.alone()) {
            requests_.push_back(std::move(line));
        }
    }
    half_.erase(0, at);
}

}  // namespace fauxboard::host
