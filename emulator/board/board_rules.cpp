// What a request or an event makes the board do: the profile's rules, and what comes of them.

#include <algorithm>
#include <utility>

#include "emulator/board/board_front.h"
#include "emulator/machine/event_rows.h"
#include "protocol/command.h"

namespace fauxboard::board {
namespace {

using behaviour::ActionContext;
using behaviour::Rule;
using behaviour::Scope;
using behaviour::Send;

constexpr std::size_t told_limit = 256;
/// Events that one step may work off: a profile whose events raise each other must come to an end.
constexpr int event_limit = 256;

}  // namespace

bool Board::execute(Channel channel, std::string_view body, bool begun) {
    if (channel == Channel::main && !profile_->line.codes.empty()) {
        const std::size_t code = body.find_first_of(profile_->line.codes);
        if (code == std::string_view::npos) {
            return false;  // nothing in it that this board looks for
        }
        body.remove_prefix(code);
    }
    protocol::Command command;
    const bool whole =
        begun ? protocol::parse_host_command(body, command) : protocol::parse_command(body, command);
    if (!whole) {
        return false;  // a frame around nothing
    }
    const std::vector<Rule>* rules = profile_->rules_for(channel, command);
    asker_ = asker_on(channel);
    answered_ = false;
    if ((rules != nullptr && run_rules(*rules, &command)) ||
        (begun && command.letter != 0 && machine_->host_side().run_code(false))) {
        return answered_;
    }
    ++(rules == nullptr ? counters_.unknown_codes : counters_.unmatched);
    report_unknown(
        rules == nullptr ? command.word : body,
        rules == nullptr ? "is not in the profile" : "has parameters that no rule of the profile is for");
    if (begun) {
        machine_->events.raise(machine::event("host.unknown"));
    }
    return answered_;
}

/// A command of a job's file: by the rules of the lines that speak as hosts. Replies go nowhere, as on a
/// board with several lines, but on one that has a single one they are seen.
bool Board::carry_out(std::string_view text, char letter, int code) {
    const auto key = behaviour::Profile::code_key(letter, static_cast<std::uint32_t>(std::max(code, 0)));
    const std::vector<Rule>* rules = code < 0 ? nullptr : profile_->host_requests.codes.find(key);
    protocol::Command command;
    const std::string_view bare = text.substr(0, text.find_first_of(";*"));
    const std::size_t start = bare.find(letter);
    if (rules == nullptr || start == std::string_view::npos ||
        !protocol::parse_host_command(bare.substr(start), command)) {
        return false;
    }
    const bool main = port(Channel::main).connected;
    const auto asker = std::exchange(asker_, main ? Channel::main : Channel::host);
    const bool both = main && port(Channel::host).connected;
    if (both) {
        asker_.reset();
    }
    muted_ = both;
    const Rule* const after = after_;
    const bool done = run_rules(*rules, &command);
    after_ = after;  // which is of the command of a line, if one is under way
    muted_ = false;
    asker_ = asker;
    return done;
}

/// Whom a frame goes to that does not say it itself, when it was asked for on `channel`: on a board with a
/// screen, the screen.
std::optional<Channel> Board::asker_on(Channel channel) const {
    const bool host_like = profile_->line.framing == behaviour::Framing::commands;
    return channel == Channel::network || host_like ? channel : Channel::main;
}

void Board::report_unknown(std::string_view word, std::string_view why) {
    if (options_.observer == nullptr || told_.size() >= told_limit || told_.contains(word)) {
        return;
    }
    told_.emplace(word);
    notice(Level::warning, std::string(word.substr(0, 60)) + " " + std::string(why) + "; ignored");
}

bool Board::run_rules(const std::vector<Rule>& rules, const protocol::Command* command) {
    const Scope here = scope(command);
    for (const Rule& rule : rules) {
        if (behaviour::all_hold(rule.when, here)) {
            run_rule(rule, here);
            return true;
        }
    }
    return false;
}

void Board::run_rule(const Rule& rule, const Scope& here) {
    ActionContext context{*machine_, variables_, *this};
    const bool waited = machine_->waiting();
    for (const behaviour::ActionCall& call : rule.actions) {
        behaviour::run_action(call, here, profile_->variables, context);
    }
    if (context.reset && machine_->commands.begun != nullptr) {
        machine_->request_reset(machine_->restart);  // from inside a command: when it is over
    } else if (context.reset) {
        power_on(time_);
        return;
    }
    // What waits is the main line; a datagram is answered as it comes, and no request is forgotten over it.
    const bool holds = rule.until_done && asker_ != Channel::network;
    const bool waits = !waited && machine_->waiting();  // of its own; another's wait is none of its business
    if (holds && here.command != nullptr && (waits || machine_->moving())) {
        const std::string_view code = here.command->word;
        hold({&rule, std::string(code) + std::string(here.command->text), waits});
        return;
    }
    for (const Send& entry : rule.send) {
        send(entry, here);
    }
    if (!rule.after.empty()) {
        after_ = &rule;
    }
}

/// Firmware that carries out a command to its end reads nothing from a file meanwhile: else a print, which
/// always moves, would hold the line up until it is over.
void Board::hold(Held held) {
    held_ = std::move(held);
    machine_->job.stands_by = held_.rule != nullptr;
}

/// The request that held up all others may be over: what its rule sends goes now.
void Board::end_held() {
    if (held_.rule == nullptr || machine_->moving() || (held_.waits && machine_->waiting())) {
        return;
    }
    const Held over = held_;
    hold({});
    protocol::Command command;
    if (protocol::parse_command(over.body, command)) {
        const Scope here = scope(&command);
        for (const Send& entry : over.rule->send) {
            send(entry, here);
        }
    }
}

/// After anything that may have changed the machine: events, and what the main loop lost by it.
/// What is said goes to whoever asked, or whose command is being carried out.
void Board::settle(std::optional<Channel> asker) {
    if (!machine_->events.empty()) {
        const bool runs = !asker && machine_->host_side().running();
        asker = runs ? static_cast<Channel>(machine_->host_side().speaker) : asker;
        asker_ = asker ? asker_on(*asker) : std::nullopt;
        run_events();
    }
    asker_.reset();
    machine_->die_if_told();
    if (machine_->take_reset()) {
        power_on(time_);
        return;
    }
    end_held();
    if (const int rounds = machine_->loop.take_lost_rounds(); rounds > 0) {
        schedule_.lose_rounds(rounds);
    }
    if (const SimTime stall = machine_->loop.take_stall(); stall > SimTime{0}) {
        schedule_.stall(stall);
    }
    if (schedule_.frozen() && !profile_->schedule.frozen(scope())) {
        schedule_.thaw(time_);
    }
}

void Board::run_events() {
    for (int i = 0; i < event_limit; ++i) {
        const auto event = machine_->events.take();
        if (!event) {
            return;
        }
        if (options_.observer != nullptr) {
            options_.observer->on_event(time_, *event);
        }
        const std::vector<Rule>& rules = profile_->rules_for(*event);
        if (!rules.empty()) {
            run_rules(rules, nullptr);
        }
        call_front([&](Front& front, ActionContext& context) { front.on_event(time_, *event, context); });
    }
    machine_->events.clear();
    notice(Level::error, "the profile's events raise each other without end; the rest was dropped");
}

}  // namespace fauxboard::board
