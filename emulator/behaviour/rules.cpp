#include "emulator/behaviour/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fauxboard::behaviour {

bool Condition::holds(const Scope& scope) const {
    const Value value = left.evaluate(scope);
    const auto equals = [&](const Operand& operand) { return operand.evaluate(scope) == value; };
    switch (test) {
        case Test::present:
            return !value.none();
        case Test::absent:
            return value.none();
        case Test::equal:
            return equals(right[0]);
        case Test::not_equal:
            return !equals(right[0]);
        case Test::one_of:
            return std::any_of(right.begin(), right.end(), equals);
        case Test::range:
            return value.is_number() &&
                   (right[0].kind == Operand::Kind::none || value.number >= right[0].number) &&
                   (right[1].kind == Operand::Kind::none || value.number <= right[1].number);
        case Test::starts_with:
            return value.is_text() && value.text.starts_with(right[0].text);
    }
    return false;
}

namespace {

std::string shown(const Value& value) {
    return value.is_text() ? fmt::format("\"{}\"", value.text) : fmt::format("{}", value.number);
}

void assign(const ActionCall& call, const Scope& scope, const std::vector<VariableInfo>& variables,
            ActionContext& context) {
    Value value = call.args[0].evaluate(scope);
    if (value.none()) {
        return;
    }
    if (call.variable) {
        const VariableInfo& info = variables[*call.variable];
        double& slot = context.variables[*call.variable];
        const double wanted = (call.add ? slot : 0.0) + value.number;
        slot = std::isfinite(wanted) ? std::clamp(wanted, info.min, info.max) : slot;
        return;
    }
    if (call.add) {
        value.number += call.field->get(scope.machine).number;
    }
    switch (set_field(context.machine, *call.field, value)) {
        case SetResult::done:
            break;
        case SetResult::clamped:
            context.notices.notice(
                Level::info,
                fmt::format("{}: {} is beyond what the machine allows; taken as {}", call.field->path,
                            shown(value), shown(call.field->get(context.machine))));
            break;
        case SetResult::refused:
            context.notices.notice(Level::warning, std::string(call.field->path) + ": value refused");
            break;
    }
}

}  // namespace

namespace {

/// Evaluates the arguments into `values` and runs the action with them.
void run_with(std::span<Value> values, const ActionCall& call, const Scope& scope, ActionContext& context) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = call.args[i].evaluate(scope);
        if (values[i].none() && call.info->args[i].required) {
            context.notices.notice(Level::debug, std::string(call.info->name) + ": the line does not say " +
                                                     std::string(call.info->args[i].name) + "; nothing done");
            return;
        }
    }
    call.info->run(context, values);
}

}  // namespace

void run_action(const ActionCall& call, const Scope& scope, const std::vector<VariableInfo>& variables,
                ActionContext& context) {
    if (call.info->run == nullptr) {
        assign(call, scope, variables, context);
        return;
    }
    context.command = scope.command;
    context.infos = &variables;
    const std::size_t count = call.args.size();
    std::array<Value, 2> few;  // clearing room for the most there can be would cost more than the action
    if (count <= few.size()) {
        run_with({few.data(), count}, call, scope, context);
    } else {
        std::array<Value, max_action_args> many;
        run_with({many.data(), count}, call, scope, context);
    }
}

}  // namespace fauxboard::behaviour
