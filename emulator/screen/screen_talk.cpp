// The part of a screen that sends one command at a time: its queue, what it asks again and again, and what it
// no longer waits for.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/screen/screen.h"

namespace fauxboard::screen {

/// Values that say which page is open.
void Screen::tell_page() {
    for (std::size_t id = 0; id < values_.size(); ++id) {
        if (profile_->values.at(id).is == ValueSource::page) {
            values_[id].text = page().path;
        }
    }
}

SimTime Screen::talk_due() const {
    if (!profile_->talk.queued) {
        return machine::never;
    }
    const auto poll = std::min_element(polls_due_.begin(), polls_due_.end());
    return std::min(talk_.timeout_due(), poll == polls_due_.end() ? machine::never : *poll);
}

/// Does what is due, and puts on the line what may go now.
void Screen::talk_on() {
    if (talk_.timeout_due() <= time_) {
        give_up();
    }
    poll();
    while (const auto body = talk_.next(time_, intake_.came())) {
        write(*body);
    }
}

void Screen::poll() {
    for (std::size_t i = 0; i < polls_due_.size(); ++i) {
        const TalkRules::Poll& rule = profile_->talk.polls[i];
        if (polls_due_[i] > time_) {
            continue;
        }
        polls_due_[i] = time_ + rule.every;
        const Scope scope{values_, 0, {}, 0};
        if (!all_hold(rule.when, scope)) {
            continue;
        }
        assume(rule.assume, scope);
        for (const Send& one : rule.send) {
            std::string body = one.line.render(scope);
            if (all_hold(one.when, scope) && !talk_.has(body)) {
                talk_.queue(std::move(body));
            }
        }
    }
}

void Screen::give_up() {
    ++counters_.timeouts;
    Judgement judgement;
    judgement.at = time_;
    judgement.line = talk_.give_up(time_);
    judgement.verdict = Verdict::timed_out;
    judgement.why = fmt::format("no line in {:g} s after it{}{}", machine::to_seconds(profile_->talk.timeout),
                                profile_->talk.timed_out.empty() ? "" : ": ", profile_->talk.timed_out);
    record(std::move(judgement));
}

void Screen::acknowledge(Judgement& judgement, std::uint64_t came) {
    const Talk::Ack ack = talk_.acknowledge(came);
    if (ack.verdict != Verdict::ok) {
        judgement.verdict = std::max(judgement.verdict, ack.verdict);
        judgement.why += (judgement.why.empty() ? "" : "; ") + ack.why;
    }
    talk_on();
}

}  // namespace fauxboard::screen
