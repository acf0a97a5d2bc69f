// Template and Condition: the parts of the little language that stand around an expression.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/operand.h"
#include "emulator/screen/expression.h"

namespace fauxboard::screen {

using behaviour::ExpressionError;
using behaviour::Json;

namespace {

constexpr double tolerance = 0.0005;

/// The id of a text value, or -1 for `row.text`; nothing when `name` is neither.
std::optional<std::ptrdiff_t> text_value(std::string_view name, const ValueTable& table, Allowed allowed) {
    if (name == "row.text" && allowed.row) {
        return -1;
    }
    const auto id = table.find(name);
    if (id && table.at(*id).kind == ValueKind::text) {
        return static_cast<std::ptrdiff_t>(*id);
    }
    return std::nullopt;
}

constexpr std::array<std::pair<std::string_view, Condition::Test>, 6> tests{
    {{"not", Condition::Test::not_equal},
     {"in", Condition::Test::one_of},
     {"ends_with", Condition::Test::ends_with},
     {"starts_with", Condition::Test::starts_with},
     {"ends_not_with", Condition::Test::ends_not_with},
     {"starts_not_with", Condition::Test::starts_not_with}}};

std::int64_t whole(double value) {
    return std::isfinite(value) ? static_cast<std::int64_t>(std::clamp(value, -1e15, 1e15)) : 0;
}

}  // namespace

Template::Template(std::string_view source, const ValueTable& table, Allowed allowed) : source_(source) {
    std::string literal;
    const auto flush = [&] {
        if (!literal.empty()) {
            Part part;
            part.literal = std::move(literal);
            parts_.push_back(std::move(part));
            literal.clear();
        }
    };
    while (!source.empty()) {
        const char c = source.front();
        if (source.starts_with("{{") || source.starts_with("}}")) {
            literal += c;
            source.remove_prefix(2);
        } else if (c == '{' || c == '}') {
            const std::size_t end = source.find('}');
            if (c == '}' || end == std::string_view::npos) {
                throw ExpressionError("a brace without its partner in \"" + source_ + "\"", {});
            }
            flush();
            add_place(source.substr(1, end - 1), table, allowed);
            source.remove_prefix(end + 1);
        } else {
            literal += c;
            source.remove_prefix(1);
        }
    }
    flush();
}

void Template::add_place(std::string_view inside, const ValueTable& table, Allowed allowed) {
    const std::size_t colon = inside.rfind(':');
    const std::string_view name = inside.substr(0, colon);
    const std::string_view format = colon == std::string_view::npos ? "" : inside.substr(colon + 1);
    Part part;
    if (const auto text = text_value(name, table, allowed)) {
        if (!format.empty()) {
            throw ExpressionError(fmt::format("{{{}}} is a text; expected no format", inside), {});
        }
        part.style = *text < 0 ? Style::row_text : Style::text;
        part.value = *text < 0 ? 0 : static_cast<std::size_t>(*text);
    } else {
        part.expression = Expression(name, table, allowed);
        if (format.empty()) {
            part.style = Style::shortest;
        } else if (format == "d") {
            part.style = Style::whole;
        } else if (format.size() == 3 && format[0] == '.' && format[1] >= '0' && format[1] <= '6' &&
                   format[2] == 'f') {
            part.style = Style::fixed;
            part.decimals = format[1] - '0';
        } else if (format == "name" && table.find(name)) {
            part.style = Style::named;
            part.names = table.at(*table.find(name)).names;
        } else {
            throw ExpressionError(
                fmt::format("unknown format \"{}\" in {{{}}}; expected .0f to .6f, d, or name", format,
                            inside),
                {});
        }
    }
    if (const auto id = table.find(name);
        id && std::find(values_.begin(), values_.end(), *id) == values_.end()) {
        values_.push_back(*id);
    }
    parts_.push_back(std::move(part));
}

std::string Template::render(const Scope& scope, bool for_people) const {
    const auto shown = [&](std::string_view text) {
        return for_people ? printable(text) : std::string(text);
    };
    std::string out;
    for (const Part& part : parts_) {
        const bool number = part.style != Style::literal && part.style < Style::text;
        const double value = number ? part.expression.evaluate(scope) : 0;
        switch (part.style) {
            case Style::literal:
                out += part.literal;
                break;
            case Style::fixed:
                out += fixed_text(value, part.decimals);
                break;
            case Style::whole:
                out += fmt::format("{}", whole(value));
                break;
            case Style::shortest:
                out += short_text(value);
                break;
            case Style::named: {
                const auto hit = part.names.find(whole(value));
                out += hit == part.names.end() ? short_text(value) : hit->second;
                break;
            }
            case Style::text:
                out += shown(scope.values[part.value].text);
                break;
            case Style::row_text:
                out += shown(scope.row_text);
                break;
        }
    }
    return out;
}

Condition::Condition(std::string_view left, const Json& right, const ValueTable& table, Allowed allowed)
    : source_(left) {
    if (const auto text = text_value(left, table, allowed)) {
        is_text_ = true;
        row_text_ = *text < 0;
        value_ = *text < 0 ? 0 : static_cast<std::size_t>(*text);
    } else {
        left_ = Expression(left, table, allowed);
    }
    set_right(right, table, allowed);
}

void Condition::set_right(const Json& right, const ValueTable& table, Allowed allowed) {
    if (!right.is_object()) {
        add_operand(right, table, allowed);
        return;
    }
    if (right.contains("min") || right.contains("max")) {
        set_range(right, table, allowed);
        return;
    }
    if (right.size() != 1) {
        throw ExpressionError("expected one test, or min and max together", {});
    }
    const std::string& key = right.begin().key();
    const auto* hit =
        std::find_if(tests.begin(), tests.end(), [&](const auto& test) { return test.first == key; });
    if (hit == tests.end()) {
        std::vector<std::string_view> names{"min", "max"};
        for (const auto& [name, test] : tests) {
            names.push_back(name);
        }
        throw ExpressionError(
            fmt::format("unknown test \"{}\"; expected one of {}", key, fmt::join(names, ", ")),
            std::string(behaviour::nearest(key, names)));
    }
    test_ = hit->second;
    if (test_ >= Test::ends_with && !is_text_) {
        throw ExpressionError("\"" + key + "\" does not fit a number", {});
    }
    const Json& value = right.begin().value();
    if (!value.is_array()) {
        add_operand(value, table, allowed);
        return;
    }
    for (const Json& item : value) {
        add_operand(item, table, allowed);
    }
}

void Condition::set_range(const Json& right, const ValueTable& table, Allowed allowed) {
    has_min_ = right.contains("min");
    has_max_ = right.contains("max");
    test_ = Test::range;
    if (is_text_) {
        throw ExpressionError("min and max do not fit a text", {});
    }
    if (right.size() != (has_min_ && has_max_ ? 2U : 1U)) {
        throw ExpressionError("expected one test, or min and max together", {});
    }
    for (const char* key : {"min", "max"}) {
        if (right.contains(key)) add_operand(right[key], table, allowed);
    }
}

void Condition::add_operand(const Json& value, const ValueTable& table, Allowed allowed) {
    if (is_text_) {
        if (!value.is_string()) {
            throw ExpressionError("\"" + source_ + "\" is a text; expected a text to compare it with", {});
        }
        texts_.push_back(value.get<std::string>());
    } else if (value.is_number()) {
        numbers_.push_back(Expression::constant(value.get<double>()));
    } else if (value.is_boolean()) {
        numbers_.push_back(Expression::constant(value.get<bool>() ? 1 : 0));
    } else if (value.is_string()) {
        numbers_.emplace_back(value.get_ref<const std::string&>(), table, allowed);
    } else {
        throw ExpressionError("\"" + source_ + "\" is a number; expected a number or an expression", {});
    }
}

bool Condition::holds_text(std::string_view text) const {
    const auto any = [&](auto&& test) { return std::any_of(texts_.begin(), texts_.end(), test); };
    switch (test_) {
        case Test::ends_with:
        case Test::ends_not_with:
            return any([&](const std::string& t) { return text.ends_with(t); }) == (test_ == Test::ends_with);
        case Test::starts_with:
        case Test::starts_not_with:
            return any([&](const std::string& t) { return text.starts_with(t); }) ==
                   (test_ == Test::starts_with);
        case Test::not_equal:
            return !any([&](const std::string& t) { return text == t; });
        default:
            return any([&](const std::string& t) { return text == t; });
    }
}

bool Condition::holds_number(const Scope& scope) const {
    const double left = left_.evaluate(scope);
    if (test_ == Test::range) {
        const double first = numbers_.front().evaluate(scope);
        const double last = numbers_.back().evaluate(scope);
        return (!has_min_ || left >= first - tolerance) && (!has_max_ || left <= last + tolerance) &&
               !std::isnan(left);
    }
    const bool hit = std::any_of(numbers_.begin(), numbers_.end(), [&](const Expression& right) {
        return std::fabs(left - right.evaluate(scope)) <= tolerance;
    });
    return test_ == Test::not_equal ? !hit : hit;
}

bool Condition::holds(const Scope& scope) const {
    if (!is_text_) {
        return holds_number(scope);
    }
    return holds_text(row_text_ ? scope.row_text : std::string_view(scope.values[value_].text));
}

Condition Condition::frozen(const Scope& scope) const {
    Condition out = *this;
    for (Expression& number : out.numbers_) {
        number = Expression::constant(number.evaluate(scope));
    }
    return out;
}

std::string Condition::now(const Scope& scope) const {
    if (!is_text_) {
        return short_text(left_.evaluate(scope));
    }
    return '"' + printable(row_text_ ? scope.row_text : std::string_view(scope.values[value_].text)) + '"';
}

std::string Condition::words(const Scope& scope) const {
    std::vector<std::string> right;
    for (const Expression& number : numbers_) {
        right.push_back(short_text(number.evaluate(scope)));
    }
    for (const std::string& text : texts_) {
        right.push_back('"' + text + '"');
    }
    const std::string list = fmt::format("{}", fmt::join(right, ", "));
    switch (test_) {
        case Test::range:
            if (has_min_ && has_max_) return fmt::format("{} is {} to {}", source_, right[0], right[1]);
            return fmt::format("{} is at {} {}", source_, has_min_ ? "least" : "most", list);
        case Test::not_equal:
            return fmt::format("{} is not {}", source_, list);
        case Test::ends_with:
            return fmt::format("{} ends with {}", source_, list);
        case Test::starts_with:
            return fmt::format("{} starts with {}", source_, list);
        case Test::ends_not_with:
            return fmt::format("{} does not end with {}", source_, list);
        case Test::starts_not_with:
            return fmt::format("{} does not start with {}", source_, list);
        default:
            return fmt::format("{} is {}{}", source_, right.size() > 1 ? "one of " : "", list);
    }
}

void assign(const std::vector<Assign>& assigns, const ValueTable& table, const Scope& scope,
            std::span<Shown> values) {
    std::vector<Shown> fresh;
    for (const Assign& one : assigns) {
        const bool text = table.at(one.value).kind == ValueKind::text;
        fresh.push_back({text ? 0 : one.expression.evaluate(scope), text ? one.text.render(scope) : "", {}});
    }
    for (std::size_t i = 0; i < assigns.size(); ++i) {
        values[assigns[i].value].number = fresh[i].number;
        values[assigns[i].value].text = std::move(fresh[i].text);
    }
}

bool all_hold(const std::vector<Condition>& conditions, const Scope& scope) {
    return std::all_of(conditions.begin(), conditions.end(),
                       [&](const Condition& condition) { return condition.holds(scope); });
}

}  // namespace fauxboard::screen
