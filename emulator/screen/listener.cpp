#include "emulator/screen/listener.h"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/framing.h"

namespace fauxboard::screen {
namespace {

constexpr std::size_t most_lines = 16;  ///< kept for the report

bool by_itself(const ScreenProfile& profile, const Judgement& judgement, std::string_view body) {
    return std::any_of(profile.unasked.begin(), profile.unasked.end(), [&](const std::string& name) {
        return judgement.frame.empty() ? body.starts_with(name) : judgement.frame == name;
    });
}

/// A heat-up is among the longest that a board may take before it acknowledges, and busy meanwhile.
constexpr SimTime longest_command{std::chrono::minutes(30)};

std::string seconds(SimTime time) {
    return short_text(machine::to_seconds(time)) + " s";
}

}  // namespace

std::string Listener::describe(const Screen& screen, const Expectation& what) {
    const Scope scope{screen.values(), 0, {}, 0};
    std::vector<std::string> parts;
    for (const Condition& condition : what.where) {
        parts.push_back(condition.words(scope));
    }
    if (what.where.empty()) {
        for (const std::size_t value : what.with) {
            parts.push_back(screen.profile().values.at(value).name);
        }
    }
    std::string out =
        what.frame.empty() ? fmt::format("the line \"{}...\"", printable(what.line)) : what.frame;
    if (!parts.empty()) {
        out += fmt::format(" {} {}", what.where.empty() ? "with" : "where", fmt::join(parts, " and "));
    }
    return out + " within " + seconds(what.within);
}

void Listener::expect(const Screen& screen, const Button& button, std::size_t row,
                      std::optional<double> input) {
    wanted_.clear();
    came_.clear();
    disturbed_ = timed_out_ = false;
    timeouts_ = screen.counters().timeouts;
    silence_ = screen.profile().silence;
    const Standpoint at = screen.standpoint();
    const std::size_t there = at.visible(button, row).value_or(1);
    const Scope scope = at.scope(button, there, input.value_or(button.input ? button.input->normally : 0));
    const auto add = [&](const std::vector<Expectation>& list) {
        for (Expectation one : list) {
            for (Condition& condition : one.where) {
                condition = condition.frozen(scope);
            }
            std::string words = describe(screen, one);
            wanted_.push_back({std::move(one), std::move(words), false, 0});
        }
    };
    add(button.expect);
    if (const auto to = at.destination(button.leads_to, scope)) {
        add(screen.profile().pages[*to].expect);
    }
}

void Listener::expect_acknowledged(const Screen& screen) {
    if (screen.profile().talk.queued && screen.talk().over() < screen.talk().taken()) {
        Expectation what;
        what.within = longest_command;
        wanted_.push_back({std::move(what), "its acknowledgement", false, screen.talk().taken()});
    }
}

bool Listener::matches(const Screen& screen, const Expectation& what, const Judgement& judgement,
                       std::string_view body) {
    if (what.frame.empty()) {
        return body.starts_with(what.line);
    }
    if (judgement.frame != what.frame) {
        return false;  // a frame the screen knows and ignores may well be what tells that a move is over
    }
    const bool carries = std::all_of(what.with.begin(), what.with.end(), [&](std::size_t value) {
        return std::any_of(judgement.carried.begin(), judgement.carried.end(),
                           [&](const Carried& one) { return one.value == value; });
    });
    if (!carries) {
        return false;
    }
    std::vector<Shown> then = screen.values();  // later lines may have changed them since
    for (const Carried& one : judgement.carried) {
        then[one.value].number = one.number;
        then[one.value].text = one.text;
    }
    return all_hold(what.where, Scope{then, 0, {}, 0});
}

void Listener::look(const Screen& screen) {
    timed_out_ = timed_out_ || screen.counters().timeouts != timeouts_;
    for (Wanted& one : wanted_) {
        one.came = one.came || (one.over != 0 && screen.talk().over() >= one.over);
    }
}

void Listener::take(const Screen& screen, const Judgement& judgement) {
    const std::string body(protocol::unframe(judgement.line, protocol::ChecksumPolicy::ignored).body);
    const auto keep = [&] {
        if (came_.size() < most_lines) came_.push_back(body);
    };
    look(screen);
    for (Wanted& one : wanted_) {
        if (!one.came && one.over == 0 && matches(screen, one.what, judgement, body)) {
            one.came = true;
            keep();
            return;
        }
    }
    const bool close = std::any_of(wanted_.begin(), wanted_.end(), [&](const Wanted& one) {
        return !one.what.frame.empty() && one.what.frame == judgement.frame;
    });
    const bool usual = by_itself(screen.profile(), judgement, body);
    if (close || !usual) {
        keep();
    }
    disturbed_ = disturbed_ || !usual;
}

Listener::State Listener::state(SimTime now) const {
    if (wanted_.empty()) {
        return disturbed_ ? State::failed : now >= start_ + silence_ ? State::met : State::waiting;
    }
    if (timed_out_) {
        return State::failed;
    }
    bool all = true;
    for (const Wanted& one : wanted_) {
        if (one.came) continue;
        if (now >= start_ + one.what.within + slack_) return State::failed;
        all = false;
    }
    return all ? State::met : State::waiting;
}

SimTime Listener::deadline() const {
    if (wanted_.empty()) {
        return start_ + silence_;
    }
    SimTime first = machine::never;
    for (const Wanted& one : wanted_) {
        if (!one.came) first = std::min(first, start_ + one.what.within + slack_);
    }
    return first;
}

std::vector<std::string> Listener::expected_words() const {
    std::vector<std::string> out;
    for (const Wanted& one : wanted_) {
        out.push_back(one.words);
    }
    if (out.empty()) {
        out.emplace_back("silence");
    }
    return out;
}

std::string Listener::missing_words() const {
    std::vector<std::string> out;
    for (const Wanted& one : wanted_) {
        if (!one.came) out.push_back(one.words);
    }
    return out.empty() ? "silence" : fmt::format("{}", fmt::join(out, ", and "));
}

}  // namespace fauxboard::screen
