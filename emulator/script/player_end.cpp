// How a scenario ends, and what a person is told of it.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "emulator/behaviour/document.h"
#include "emulator/control/names.h"
#include "emulator/script/player.h"
#include "emulator/script/steps.h"

namespace fauxboard::script {
namespace {

using Verdict = Outcome::Verdict;

/// Whose words a trigger is about, and the start of a sentence about them.
std::pair<Talk::From, const char*> speaker(Trigger::Kind kind) {
    switch (kind) {
        case Trigger::Kind::line:
            return {Talk::From::board, "the board said"};
        case Trigger::Kind::request:
            return {Talk::From::screen, "the screen asked"};
        case Trigger::Kind::host_line:
            return {Talk::From::usb, "the board said to the host"};
        case Trigger::Kind::host_request:
            return {Talk::From::host, "the host asked"};
        default:
            return {Talk::From::event, "that happened was"};
    }
}

std::string value_words(const board::Board& board, const std::string& name) {
    const control::Place place = control::find_place(board, name);
    const Json value = control::value_of(board, place);
    const std::string_view unit = place.field == nullptr ? std::string_view{} : place.field->unit;
    const std::string number = value.is_number_float() ? fmt::format("{:.6g}", value.get<double>())
                               : value.is_string()     ? '"' + value.get<std::string>() + '"'
                                                       : value.dump();
    return fmt::format("{} is {}{}{}", name, number, unit.empty() ? "" : " ", unit);
}

}  // namespace

std::vector<Player::Waiting> Player::waiting() const {
    std::vector<Waiting> out;
    for (const auto& branch : branches_) {
        if (!branch->over && branch->watching != nullptr) {
            const Step& step = *branch->watching;
            out.push_back({branch->name, step.why.empty() ? step.words : step.why, branch->began});
        }
    }
    return out;
}

/// The outermost step `index` begins, so those before it are done.
void Player::main_step(std::size_t index) {
    if (main_ < results_.size()) {
        results_[main_].verdict = StepResult::Verdict::passed;
        results_[main_].took = now_ - results_[main_].at;
    }
    main_ = index;
    if (index < results_.size()) {
        results_[index].at = now_;
    }
}

/// What there was instead.
std::string Player::explain(const Trigger& trigger) const {
    if (trigger.kind == Trigger::Kind::field) {
        std::vector<std::string> words;
        stage_->visit([&](board::Board& board, SimTime now) {
            board.refresh(now);
            for (const std::string& field : trigger.fields) {
                words.push_back(value_words(board, field));
            }
        });
        return fmt::format("{}", fmt::join(words, ", "));
    }
    if (trigger.is_state()) {
        return fmt::format("it shows the page \"{}\"", page_shown());
    }
    const std::pair<Talk::From, const char*> speaking = speaker(trigger.kind);
    const Talk::From from = speaking.first;
    const auto last =
        std::find_if(talk_.rbegin(), talk_.rend(), [&](const Talk& talk) { return talk.from == from; });
    if (from == Talk::From::event) {
        return last == talk_.rend() ? "nothing happened lately"
                                    : fmt::format("the last that happened was {}", last->text);
    }
    const std::string who = from == Talk::From::screen
                                ? fmt::format("the {} asked", scenario_->cast.profile->line.peer)
                                : std::string(speaking.second);
    return last == talk_.rend() ? fmt::format("{} nothing lately", who)
                                : fmt::format("the last that {} was \"{}\"", who, last->text);
}

void Player::fail(const Branch* branch, const Step& step, Verdict verdict, const std::string& what) {
    if (done()) {
        return;
    }
    std::string place = fmt::format("{}:{}", step.where.file, step.where.line);
    if (branch != nullptr && !branch->name.empty()) {
        place += fmt::format(", in \"{}\"", branch->name);
    }
    for (const Level& level : branch != nullptr ? branch->levels : std::vector<Level>{}) {
        if (level.owner != nullptr && level.owner->rounds != std::optional<std::uint64_t>(1)) {
            place += fmt::format(", round {}", level.rounds_done + 1);
        }
    }
    const std::string why = step.why.empty() ? std::string{} : fmt::format("\"{}\" is not so: ", step.why);
    std::string sentence = fmt::format("{} {} after {}: {}{} ({}).", scenario_->name,
                                       verdict == Verdict::timed_out ? "timed out" : "failed",
                                       time_words(now_), why, what, place);
    where_ = step.where;
    if (main_ < results_.size()) {
        results_[main_].verdict = StepResult::Verdict::failed;
        results_[main_].took = now_ - results_[main_].at;
        results_[main_].sentence = sentence;
    }
    finish(verdict, std::move(sentence));
}

void Player::finish(Verdict verdict, std::string sentence) {
    Outcome out;
    out.verdict = verdict;
    out.sentence = std::move(sentence);
    out.at = now_;
    out.where = where_;
    out.steps = steps_done_;
    out.results = results_;
    out.captures = captures_;
    out.talk.assign(talk_.begin(), talk_.end());
    outcome_ = std::move(out);
}

void Player::interrupt(SimTime now, std::string_view why) {
    if (done()) {
        return;
    }
    now_ = std::max(now_, now);
    std::string doing = "before its first step";
    if (main_ < results_.size()) {
        where_ = results_[main_].where;
        doing = fmt::format("in the step \"{}\" ({}:{})", results_[main_].words, where_->file, where_->line);
    }
    finish(Verdict::interrupted, fmt::format("{} was ended {} after {}, {}; nothing had failed until then.",
                                             scenario_->name, why, time_words(now_), doing));
}

}  // namespace fauxboard::script
