#include <utility>

#include "emulator/board/board.h"
#include "emulator/machine/event_rows.h"
#include "protocol/command.h"

namespace fauxboard::board {
namespace {

using behaviour::ActionContext;
using behaviour::Rule;
using behaviour::Scope;
using behaviour::Send;

constexpr std::size_t told_limit = 256;

}  // namespace

void Board::execute(Channel channel, std::string_view body) {
    if (channel == Channel::main && !profile_->line.codes.empty()) {
        const std::size_t code = body.find_first_of(profile_->line.codes);
        if (code == std::string_view::npos) {
            return;  // nothing in it that this board looks for
        }
        body.remove_prefix(code);
    }
    protocol::Command command;
    if (!protocol::parse_command(body, command)) {
        return;  // a frame around nothing
    }
    const std::vector<Rule>* rules = profile_->rules_for(channel, command);
    asker_ = channel == Channel::network ? channel : Channel::main;
    if (rules == nullptr) {
        if (channel == Channel::host && machine_->host_side().run_code()) {
            return;
        }
        ++counters_.unknown_codes;
        report_unknown(command.word, "is not in the profile");
        if (channel == Channel::host) {
            machine_->events.raise(machine::event("host.unknown"));
        }
    } else if (!run_rules(*rules, &command)) {
        ++counters_.unmatched;
        report_unknown(body, "has parameters that no rule of the profile is for");
    }
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
    for (const behaviour::ActionCall& call : rule.actions) {
        behaviour::run_action(call, here, profile_->variables, context);
    }
    if (context.reset) {
        power_on(time_);
        return;
    }
    if (rule.until_done && here.command != nullptr && machine_->at_work()) {
        const std::string_view code = here.command->word;
        held_ = {&rule, std::string(code) + std::string(here.command->text)};
        return;
    }
    for (const Send& entry : rule.send) {
        send(entry, here);
    }
}

/// The request that held up all others may be over: what its rule sends goes now.
void Board::end_held() {
    if (held_.rule == nullptr || machine_->at_work()) {
        return;
    }
    const Held over = std::exchange(held_, {});
    protocol::Command command;
    if (protocol::parse_command(over.body, command)) {
        const Scope here = scope(&command);
        for (const Send& entry : over.rule->send) {
            send(entry, here);
        }
    }
}

}  // namespace fauxboard::board
