#include "emulator/touch/machine_link.h"

#include <algorithm>
#include <array>

#include "emulator/behaviour/lists.h"

namespace fauxboard::touch {

using behaviour::Value;

namespace {

/// More entries than that no screen shows.
constexpr std::size_t most_rows = 10'000;

std::string text_of(const Value& value) {
    return value.is_text() ? std::string(value.text) : value.none() ? "" : screen::short_text(value.number);
}

void read_list(const behaviour::List& list, const machine::Machine& machine, screen::Shown& out) {
    const std::size_t rows = std::min(list.count(machine), most_rows);
    out.list.resize(rows);
    out.cells.resize(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        out.cells[row].resize(list.columns.size());
        for (std::size_t column = 0; column < list.columns.size(); ++column) {
            out.cells[row][column] = text_of(list.get(machine, row, column));
        }
        out.list[row] = out.cells[row].empty() ? std::string{} : out.cells[row].front();
    }
}

}  // namespace

void read_machine(const screen::ValueInfo& info, const machine::Machine& machine, screen::Shown& value) {
    if (info.source != nullptr) {
        read_list(*info.source, machine, value);
    }
    if (info.field == nullptr) {
        return;
    }
    const Value now = info.field->get(machine);
    value.number = now.is_number() ? now.number : 0;
    if (now.is_text()) {
        value.text = now.text;
    }
}

void read_machine(const screen::ValueTable& table, const machine::Machine& machine,
                  std::vector<screen::Shown>& values) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        read_machine(table.at(i), machine, values[i]);
    }
}

void carry_out(const screen::Deed& deed, const screen::Scope& scope, behaviour::ActionContext& context) {
    std::array<Value, behaviour::max_action_args> arguments{};
    std::array<std::string, behaviour::max_action_args> texts;
    for (std::size_t i = 0; i < deed.arguments.size(); ++i) {
        const screen::Deed::Argument& one = deed.arguments[i];
        if (!one.given) continue;
        if (one.is_text) {
            texts[i] = one.text.render(scope);
            arguments[i] = Value::of(std::string_view(texts[i]));
        } else {
            arguments[i] = Value::of(one.number.evaluate(scope));
        }
    }
    if (deed.field != nullptr) {
        static_cast<void>(behaviour::set_field(context.machine, *deed.field, arguments[0]));
    } else {
        deed.action->run(context, std::span(arguments).first(deed.arguments.size()));
    }
}

}  // namespace fauxboard::touch
