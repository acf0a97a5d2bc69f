#include "emulator/behaviour/operand.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour {
namespace {

bool capital(char c) {
    return c >= 'A' && c <= 'Z';
}

std::string quoted(std::string_view text) {
    return '"' + std::string(text) + '"';
}

Operand parse_variable(std::string_view name, const Names& names) {
    const auto hit = names.variables.find(name);
    if (hit != names.variables.end()) {
        Operand operand;
        operand.kind = Operand::Kind::variable;
        operand.variable = hit->second;
        return operand;
    }
    std::vector<std::string_view> known;
    for (const auto& [key, index] : names.variables) {
        known.emplace_back(key);
    }
    throw ExpressionError("unknown variable " + quoted(name) + "; expected one of the profile's `variables`",
                          std::string(nearest(name, known)));
}

/// S, S?, S|255
std::optional<Operand> parse_parameter(std::string_view reference) {
    if (reference.empty() || !capital(reference[0])) {
        return std::nullopt;
    }
    Operand operand;
    operand.letter = reference[0];
    operand.kind = Operand::Kind::parameter;
    if (reference.size() == 1) {
        return operand;
    }
    if (reference.size() == 2 && reference[1] == '?') {
        operand.kind = Operand::Kind::presence;
        return operand;
    }
    if (reference[1] == '|') {
        double value = 0;
        const char* end = reference.data() + reference.size();
        const auto [at, error] = std::from_chars(reference.data() + 2, end, value);
        if (error == std::errc{} && at == end) {
            operand.fallback = value;
            return operand;
        }
        throw ExpressionError("the default in " + quoted(reference) + " is not a number", {});
    }
    if (reference.back() == ':' && std::all_of(reference.begin(), reference.end() - 1, capital)) {
        operand.kind = Operand::Kind::keyed;
        operand.text = std::string(reference);
        return operand;
    }
    constexpr std::string_view dots = "...";
    if (reference.ends_with(dots)) {
        reference.remove_suffix(dots.size());
        if (std::all_of(reference.begin(), reference.end(), capital)) {
            operand.kind = Operand::Kind::behind;
            operand.text = std::string(reference);
            return operand;
        }
    }
    return std::nullopt;
}

/// "a.gco 1234" names a.gco, as does "P S100 !/a.gco#".
std::string_view file_name(std::string_view text) {
    if (const std::size_t mark = text.find('!'); mark != std::string_view::npos) {
        text.remove_prefix(mark + 1);
        return text.substr(0, text.find('#'));
    }
    return text.substr(0, text.find(' '));
}

std::optional<Operand> parse_request_word(std::string_view reference) {
    Operand operand;
    if (reference == "arg") {
        operand.kind = Operand::Kind::argument;
    } else if (reference == "name") {
        operand.kind = Operand::Kind::name;
    } else if (reference == "file") {
        operand.kind = Operand::Kind::file;
    } else if (reference == "text") {
        operand.kind = Operand::Kind::raw_text;
    } else {
        return parse_parameter(reference);
    }
    return operand;
}

}  // namespace

Operand Operand::literal(double n) {
    Operand operand;
    operand.kind = Kind::number;
    operand.number = n;
    return operand;
}

Operand Operand::literal(std::string t) {
    Operand operand;
    operand.kind = Kind::text;
    operand.text = std::move(t);
    return operand;
}

Value Operand::evaluate_other(const Scope& scope) const {
    switch (kind) {
        case Kind::none:
            return {};
        case Kind::number:
            return Value::of(number);
        case Kind::text:
            return Value::of(std::string_view{text});
        case Kind::field:
            return field->get(scope.machine);
        case Kind::variable:
            return Value::of(scope.variables[variable]);
        case Kind::entry_name:
            return scope.entry != nullptr ? Value::of(std::string_view{scope.entry->name}) : Value{};
        case Kind::entry_index:
            return Value::of(static_cast<double>(scope.index));
        case Kind::entry_bytes:
            return scope.entry != nullptr ? Value::of(static_cast<double>(scope.entry->bytes)) : Value{};
        case Kind::entry_folder:
            return scope.entry != nullptr ? Value::of(scope.entry->folder ? 1.0 : 0.0) : Value{};
        case Kind::entry_long_name:
            return scope.entry != nullptr ? Value::of(std::string_view{scope.entry->long_name}) : Value{};
        case Kind::entry_stamp:
            return scope.entry != nullptr ? Value::of(static_cast<double>(scope.entry->stamp)) : Value{};
        default:
            break;
    }
    if (scope.command == nullptr) {
        return {};
    }
    switch (kind) {
        case Kind::parameter: {
            const std::optional<double> found = scope.command->number_of(letter);
            return found ? Value::of(*found) : fallback ? Value::of(*fallback) : Value{};
        }
        case Kind::presence:
            return Value::of(scope.command->has(letter) ? 1.0 : 0.0);
        case Kind::argument:
            return Value::of(scope.command->argument);
        case Kind::name:
            return Value::of(machine::bare_name(scope.command->argument));
        case Kind::file:
            return Value::of(file_name(scope.command->argument));
        case Kind::raw_text:
            return Value::of(scope.command->text);
        case Kind::keyed: {
            const std::string_view found = scope.command->value_of(text);
            return found.empty() ? Value{} : Value::of(found);
        }
        case Kind::behind: {
            const std::size_t found = scope.command->text.find(text);
            if (found == std::string_view::npos) {
                return {};
            }
            const std::string_view rest = scope.command->text.substr(found + text.size());
            return Value::of(rest.substr(0, rest.find('*')));
        }
        default:
            return {};
    }
}

bool Operand::is_text() const {
    switch (kind) {
        case Kind::text:
        case Kind::argument:
        case Kind::name:
        case Kind::file:
        case Kind::raw_text:
        case Kind::keyed:
        case Kind::behind:
        case Kind::entry_name:
        case Kind::entry_long_name:
            return true;
        case Kind::field:
            return field->type == FieldType::text;
        default:
            return false;
    }
}

Operand parse_reference(std::string_view reference, const Names& names) {
    Operand operand;
    if (reference.starts_with("var.")) {
        return parse_variable(reference.substr(4), names);
    }
    constexpr std::array entries{std::pair{"entry.name", Operand::Kind::entry_name},
                                 std::pair{"entry.index", Operand::Kind::entry_index},
                                 std::pair{"entry.bytes", Operand::Kind::entry_bytes},
                                 std::pair{"entry.folder", Operand::Kind::entry_folder},
                                 std::pair{"entry.long_name", Operand::Kind::entry_long_name},
                                 std::pair{"entry.stamp", Operand::Kind::entry_stamp}};
    for (const auto& [name, kind] : entries) {
        if (reference == name) {
            if (!names.loop) {
                throw ExpressionError(quoted(reference) + " is known only inside `for_each`", {});
            }
            operand.kind = kind;
            return operand;
        }
    }
    if (const auto word = parse_request_word(reference)) {
        if (!names.request) {
            throw ExpressionError(
                "the parameter " + quoted(reference) + " is known only where a request is answered", {});
        }
        return *word;
    }
    operand.field = find_field(reference);
    if (operand.field == nullptr) {
        throw ExpressionError("unknown field " + quoted(reference), std::string(nearest_field(reference)));
    }
    operand.kind = Operand::Kind::field;
    return operand;
}

}  // namespace fauxboard::behaviour
