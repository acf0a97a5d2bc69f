// What branches of a scenario wait for: whether it has come, must not come, or is in vain.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/wire_text.h"
#include "emulator/script/player.h"
#include "emulator/script/steps.h"

namespace fauxboard::script {
namespace {

using Verdict = Outcome::Verdict;

constexpr SimTime real_grace = std::chrono::minutes(5);

/// How the screen took lines otherwise than they were meant, a sentence a line.
std::string judged(const screen::Screen& screen) {
    std::string out;
    for (const screen::Finding& finding : screen.findings()) {
        out += finding.first.sentence() + '\n';
    }
    return out;
}

}  // namespace

SimTime Player::real_limit(const Step& step) const {
    return step.real.value_or(real_grace +
                              machine::from_seconds(machine::to_seconds(step.within) * real_per_virtual_));
}

/// A wait that is over, or should be by now.
void Player::check(Branch& branch) {
    const Step* step = branch.watching;
    if (branch.over || step == nullptr) {
        return;
    }
    const SimTime end = branch.began + step->within;
    const bool is_time = step->trigger.kind == Trigger::Kind::time;
    if (is_time ? now_ >= end : step->trigger.is_state() && holds(step->trigger)) {
        go_on(branch);
    } else if (now_ > end) {
        in_vain(branch, *step, time_words(step->within));
    } else if (real_ - branch.real_began > real_limit(*step)) {
        in_vain(branch, *step, time_words(real_limit(*step)) + " of real time");
    }
}

void Player::in_vain(Branch& branch, const Step& step, const std::string& time) {
    const bool expected = step.kind->name != "wait";
    const bool state = step.trigger.is_state();
    fail(
        &branch, step, expected ? Verdict::failed : Verdict::timed_out,
        fmt::format("{} {}{} within {}; {}", expected ? "expected" : "waited in vain for", step.trigger.words,
                    expected && !state && !step.next ? " to come" : "", time, explain(step.trigger)));
}

bool Player::see(Branch& branch, const Passed& passed) {
    const Step& step = *branch.watching;
    if (step.trigger.kind != passed.kind || passed.at > branch.began + step.within) {
        return false;
    }
    if (passed.kind == Trigger::Kind::event) {
        return step.trigger.event == passed.event;
    }
    Captures ignored;
    for (const auto& pattern : step.ignoring) {
        if (pattern->search(passed.text, ignored)) {
            return false;
        }
    }
    if (step.trigger.pattern->search(passed.text, captures_)) {
        return true;
    }
    if (step.next) {
        fail(
            &branch, step, Verdict::failed,
            fmt::format("expected {}; it was \"{}\"", step.trigger.words, behaviour::from_wire(passed.text)));
    }
    return false;
}

Json Player::look() const {
    Json out;
    stage_->visit([&](board::Board& board, SimTime now) {
        board.refresh(now);
        out = stage_->display()->page(now);
    });
    return out;
}

std::string Player::page_shown() const {
    const screen::Screen* screen = stage_->screen();
    return screen != nullptr ? screen->page().path : look().value("page", "");
}

std::string Player::text_shown() const {
    if (const screen::Screen* screen = stage_->screen()) {
        return screen->show();
    }
    const Json page = look();
    std::string out = page.value("title", "") + '\n';
    for (const Json& text : page.at("texts")) {
        out += text.get<std::string>() + '\n';
    }
    if (const Json& box = page.at("box"); box.is_object()) {
        out += box.value("caption", "") + '\n' + box.value("text", "") + '\n';
    }
    return out;
}

bool Player::holds(const Trigger& trigger) {
    bool out = false;
    if (trigger.kind == Trigger::Kind::field) {
        stage_->visit([&](board::Board& board, SimTime now) {
            board.refresh(now);
            out = behaviour::all_hold(trigger.conditions,
                                      {board.machine(), board.variables(), nullptr, nullptr, 0});
        });
        return out;
    }
    if (trigger.kind == Trigger::Kind::page) {
        return page_shown() == scenario_->cast.screen->pages[trigger.page].path;
    }
    const std::string shown =
        trigger.kind == Trigger::Kind::judged ? judged(*stage_->screen()) : text_shown();
    const std::string bytes = behaviour::to_wire(shown).value_or(shown);
    std::string_view rest = bytes;
    while (!rest.empty() && !out) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        out = trigger.pattern->search(rest.substr(0, end), captures_);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return out;
}

void Player::guard(const Passed& passed) {
    for (std::size_t i = 0; i < branches_.size() && !done(); ++i) {
        const Branch& branch = *branches_[i];
        for (const Level& level : branch.levels) {
            const Step* owner = level.owner;
            if (branch.over || owner == nullptr || !owner->guards || owner->trigger.kind != passed.kind) {
                continue;
            }
            const bool is_event = passed.kind == Trigger::Kind::event;
            if (is_event ? owner->trigger.event == passed.event
                         : owner->trigger.pattern->search(passed.text, captures_)) {
                const std::string came =
                    is_event ? std::string{} : fmt::format(": \"{}\"", behaviour::from_wire(passed.text));
                fail(&branch, *owner, Verdict::failed,
                     fmt::format("{} must not come, and came{}", owner->trigger.words, came));
                return;
            }
        }
    }
}

void Player::guard_states() {
    for (std::size_t i = 0; i < branches_.size() && !done(); ++i) {
        const Branch& branch = *branches_[i];
        for (const Level& level : branch.levels) {
            if (!branch.over && level.owner != nullptr && level.owner->guards &&
                level.owner->trigger.is_state() && holds(level.owner->trigger)) {
                fail(&branch, *level.owner, Verdict::failed,
                     fmt::format("what must not be is so: {}; {}", level.owner->trigger.words,
                                 explain(level.owner->trigger)));
                return;
            }
        }
    }
}

}  // namespace fauxboard::script
