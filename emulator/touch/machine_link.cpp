#include "emulator/touch/machine_link.h"

#include <array>

namespace fauxboard::touch {

using behaviour::Value;

void read_machine(const screen::ValueInfo& info, const machine::Machine& machine, screen::Shown& value) {
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
