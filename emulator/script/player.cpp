#include "emulator/script/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/script/compiler.h"
#include "protocol/framing.h"
#include "protocol/host_line.h"

namespace fauxboard::script {
namespace {

using machine::never;
using Verdict = Outcome::Verdict;

constexpr SimTime look_every = std::chrono::milliseconds(100);
/// How often limits in real time are looked at, in virtual time.
constexpr SimTime real_every = std::chrono::seconds(1);
constexpr std::size_t most_passed = 65'536;
constexpr std::size_t kept_talk = 40;
/// Steps that may be done while no time passes: more is a loop.
constexpr std::size_t most_turn_steps = 10'000;

std::string_view body_of(std::string_view line) {
    return protocol::unframe(line, protocol::ChecksumPolicy::ignored).body;
}

}  // namespace

Player::Player(std::shared_ptr<const Scenario> scenario, double real_per_virtual)
    : scenario_(std::move(scenario)), real_per_virtual_(real_per_virtual) {
    for (const Step& step : scenario_->main.steps) {
        StepResult result;
        result.where = step.where;
        result.words = step.why.empty() ? step.words : step.why;
        results_.push_back(std::move(result));
    }
}

Player::~Player() = default;

// What passes.
// -----------------------------------------------------------------------------------------------

void Player::keep_talk(SimTime now, Talk::From from, std::string_view text) {
    if (talk_.size() == kept_talk) {
        talk_.pop_front();
    }
    talk_.push_back({now, from, behaviour::from_wire(text)});
}

void Player::push(Passed passed) {
    if (done()) {
        return;
    }
    if (passed_.size() == most_passed) {
        overflow_ = true;
    } else {
        passed_.push_back(std::move(passed));
    }
}

void Player::on_received(SimTime now, board::Channel channel, std::string_view line, board::Verdict verdict) {
    if (channel == board::Channel::network || verdict != board::Verdict::accepted) {
        return;
    }
    const bool host = channel == board::Channel::host;
    const std::string_view body = host ? protocol::unframe_host_line(line).body : body_of(line);
    keep_talk(now, host ? Talk::From::host : Talk::From::screen, body);
    push({host ? Trigger::Kind::host_request : Trigger::Kind::request, now, std::string(body), {}});
}

void Player::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    if (channel == board::Channel::network) {
        return;
    }
    const bool host = channel == board::Channel::host;
    const std::string_view body = host ? line : body_of(line);
    keep_talk(now, host ? Talk::From::usb : Talk::From::board, body);
    push({host ? Trigger::Kind::host_line : Trigger::Kind::line, now, std::string(body), {}});
}

void Player::on_event(SimTime now, machine::EventId event) {
    keep_talk(now, Talk::From::event, event->name);
    push({Trigger::Kind::event, now, {}, event});
}

// Time.
// -----------------------------------------------------------------------------------------------

SimTime Player::advance(SimTime now, SimTime real, Stage& stage) {
    now_ = std::max(now_, now);
    real_ = std::max(real_, real);
    if (done()) {
        return never;
    }
    stage_ = &stage;
    if (!std::exchange(started_, true)) {
        branches_.push_back(std::make_unique<Branch>());
        branches_[0]->levels.push_back({&scenario_->main, nullptr, 0, 0});
        run(*branches_[0]);
    }
    do {
        see_all();
        for (std::size_t i = 0; i < branches_.size() && !done(); ++i) {
            check(*branches_[i]);
        }
        guard_states();
    } while (!passed_.empty() && !done());
    std::erase_if(branches_, [](const std::unique_ptr<Branch>& branch) { return branch->over; });
    stage_ = nullptr;
    return done() ? never : next_due();
}

/// Hands what has passed to those who wait for it, in its order.
void Player::see_all() {
    if (overflow_) {
        fail(nullptr, scenario_->main.steps[0], Verdict::failed,
             "more passed at one moment than a scenario can look at");
    }
    while (!passed_.empty() && !done()) {
        const Passed passed = std::move(passed_.front());
        passed_.pop_front();
        guard(passed);
        const std::size_t waiting = branches_.size();  // who begins to wait now has not heard it
        for (std::size_t i = 0; i < waiting && !done(); ++i) {
            Branch& branch = *branches_[i];
            if (!branch.over && branch.watching != nullptr && see(branch, passed)) {
                go_on(branch);
            }
        }
    }
}

SimTime Player::next_due() const {
    SimTime next = never;
    const SimTime look = (now_ / look_every + 1) * look_every;
    for (const auto& branch : branches_) {
        for (const Level& level : branch->levels) {
            if (level.owner != nullptr && level.owner->guards && level.owner->trigger.is_state()) {
                next = std::min(next, look);
            }
        }
        const Step* step = branch->watching;
        if (step == nullptr) {
            continue;
        }
        const SimTime end = branch->began + step->within;
        if (step->trigger.kind == Trigger::Kind::time) {
            next = std::min(next, end);
        } else {
            next = std::min(
                {next, end + SimTime{1}, now_ + real_every, step->trigger.is_state() ? look : never});
        }
    }
    return next;
}

// Steps.
// -----------------------------------------------------------------------------------------------

void Player::run(Branch& branch) {
    while (!done() && !branch.over && branch.watching == nullptr && branch.children == 0) {
        if (branch.levels.empty()) {
            end_branch(branch);
            return;
        }
        Level& level = branch.levels.back();
        if (level.next == level.block->steps.size()) {
            leave_level(branch);
            continue;
        }
        const Step& step = level.block->steps[level.next++];
        if (turn_ != now_) {
            turn_ = now_;
            turn_steps_ = 0;
        }
        if (++turn_steps_ > most_turn_steps) {
            fail(
                &branch, step, Verdict::failed,
                fmt::format("{} steps were done and no time passed; put a \"wait\" among those that go round",
                            most_turn_steps));
            return;
        }
        begin(branch, step);
    }
}

/// With the values that were captured; null when they do not fit, which fails the scenario.
const Step* Player::fill_in(Branch& branch, const Step& step) {
    behaviour::Findings findings{*step.document, {}};
    Shared shared(scenario_->cast, scenario_->limits);
    for (const auto& [name, id] : faults_) {
        shared.faults.insert(name);
    }
    Compiler compiler(shared, findings, step.document);
    auto made = std::make_unique<Step>(compiler.step_now(step, captures_));
    if (!findings.problems.empty()) {
        const behaviour::Problem& problem = findings.problems.front();
        fail(&branch, step, Verdict::failed,
             fmt::format("what was captured does not fit: {}: {}", problem.pointer, problem.message));
        return nullptr;
    }
    branch.made = std::move(made);
    return branch.made.get();
}

void Player::begin(Branch& branch, const Step& written) {
    if (branch.levels.size() == 1 && branch.parent == nullptr) {
        main_step(branch.levels[0].next - 1);
    }
    const Step* step = written.dynamic ? fill_in(branch, written) : &written;
    if (step == nullptr) {
        return;
    }
    if (step->kind->role == Role::block) {
        enter(branch, *step);
    } else if (step->kind->role == Role::act) {
        ++steps_done_;
        Acting acting{*stage_, faults_};
        const std::string trouble = step->kind->act(acting, *step);
        if (!trouble.empty()) {
            fail(&branch, *step, Verdict::failed, trouble);
        }
    } else if (step->now) {
        ++steps_done_;
        if (!holds(step->trigger)) {
            fail(&branch, *step, Verdict::failed,
                 fmt::format("expected {} now; {}", step->trigger.words, explain(step->trigger)));
        }
    } else {
        branch.watching = step;
        branch.began = now_;
        branch.real_began = real_;
        if (step->trigger.kind == Trigger::Kind::time ? step->within == SimTime{0}
                                                      : step->trigger.is_state() && holds(step->trigger)) {
            ++steps_done_;
            branch.watching = nullptr;  // run() goes on
        }
    }
}

void Player::enter(Branch& branch, const Step& step) {
    if (step.blocks.size() == 1) {
        branch.levels.push_back({&step.blocks[0], &step, 0, 0});
        return;
    }
    ++steps_done_;
    branch.together = &step;
    branch.children = step.blocks.size();
    std::vector<Branch*> children;
    for (const Block& block : step.blocks) {
        auto child = std::make_unique<Branch>();
        child->name = block.name;
        child->parent = &branch;
        child->levels.push_back({&block, nullptr, 0, 0});
        children.push_back(child.get());
        branches_.push_back(std::move(child));
    }
    for (Branch* child : children) {
        if (!child->over && !done()) {
            run(*child);
        }
    }
}

void Player::leave_level(Branch& branch) {
    Level& level = branch.levels.back();
    const Step* owner = level.owner;
    if (owner == nullptr) {
        branch.levels.pop_back();
        return;
    }
    ++level.rounds_done;
    const bool last = owner->rounds && level.rounds_done >= *owner->rounds;
    if (owner->until && holds(owner->trigger)) {
        branch.levels.pop_back();
    } else if (last && owner->until) {
        fail(&branch, *owner, Verdict::failed,
             fmt::format("expected {} after {} rounds at the latest; {}", owner->trigger.words,
                         *owner->rounds, explain(owner->trigger)));
    } else if (last) {
        branch.levels.pop_back();
    } else {
        level.next = 0;
    }
}

void Player::end_branch(Branch& branch) {
    branch.over = true;
    Branch* parent = branch.parent;
    if (parent == nullptr) {
        main_step(results_.size());
        finish(Verdict::passed,
               fmt::format("{} passed: {} step{} in {} of the board's time.", scenario_->name, steps_done_,
                           steps_done_ == 1 ? "" : "s", time_words(now_)));
        return;
    }
    if (parent->together->until_first) {
        cancel(*parent);
    } else {
        --parent->children;
    }
    if (parent->children == 0) {
        parent->together = nullptr;
        run(*parent);
    }
}

/// Gives up all children of a branch, and theirs.
void Player::cancel(Branch& parent) {
    for (const auto& branch : branches_) {
        if (branch->parent == &parent && !branch->over) {
            branch->over = true;
            branch->watching = nullptr;
            cancel(*branch);
        } else if (branch->parent == &parent) {
            cancel(*branch);
        }
    }
    parent.children = 0;
}

void Player::go_on(Branch& branch) {
    ++steps_done_;
    branch.watching = nullptr;
    branch.made.reset();
    run(branch);
}

}  // namespace fauxboard::script
