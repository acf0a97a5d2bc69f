// Template and Condition: the parts of the little language that stand around an expression.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
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

constexpr std::ptrdiff_t whole_row = -1;
constexpr std::ptrdiff_t first_column = -2;  ///< and from there on downwards

/// The id of a text value; for `row.text` and the columns of the row what stands above; nothing when `name`
/// is none of these.
std::optional<std::ptrdiff_t> text_value(std::string_view name, ValueTable& table, Allowed allowed) {
    if (name == "row.text" && allowed.row) {
        return whole_row;
    }
    if (name.starts_with("row.") && allowed.columns != nullptr) {
        const auto hit = std::find(allowed.columns->begin(), allowed.columns->end(), name.substr(4));
        if (hit != allowed.columns->end()) {
            return first_column - (hit - allowed.columns->begin());
        }
    }
    const auto id = table.want(name);
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

std::string_view cell(const Scope& scope, std::size_t column) {
    return column < scope.row_cells.size() ? std::string_view(scope.row_cells[column]) : std::string_view{};
}

/// A number written in so many digits at most, from the front of `text`, which loses them.
std::optional<std::size_t> digits(std::string_view& text) {
    std::size_t out = 0;
    const auto read = std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 3), out);
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return read.ec == std::errc{} ? std::optional(out) : std::nullopt;
}

/// A file's name without its ending, or that ending with its dot.
std::string_view stem_of(std::string_view name) {
    return name.substr(0, std::min(name.rfind('.'), name.size()));
}

std::int64_t whole(double value) {
    return std::isfinite(value) ? static_cast<std::int64_t>(std::clamp(value, -1e15, 1e15)) : 0;
}

}  // namespace

Template::Template(std::string_view source, ValueTable& table, Allowed allowed, const Dictionary* words)
    : source_(source) {
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
            add_place(source.substr(1, end - 1), table, allowed, words);
            source.remove_prefix(end + 1);
        } else {
            literal += c;
            source.remove_prefix(1);
        }
    }
    flush();
}

bool Template::text_format(std::string_view format, Part& part) {
    if (format.empty()) {
        return true;
    }
    if (format == "stem" || format == "ending") {
        part.piece = format == "stem" ? Piece::stem : Piece::ending;
        return true;
    }
    const auto from = digits(format);
    if (!from || !format.starts_with('+')) {
        return false;
    }
    format.remove_prefix(1);
    const auto size = digits(format);
    part.piece = Piece::slice;
    part.from = *from;
    part.size = size.value_or(0);
    return size && format.empty();
}

bool Template::number_format(std::string_view format, Part& part) {
    const bool digit = format.size() == 3 && format[1] >= '0' && format[1] <= '9';
    if (format.empty()) {
        part.style = Style::shortest;
    } else if (format == "d" || (digit && format[0] == '0' && format[2] == 'd')) {
        part.style = Style::whole;
        part.decimals = format == "d" ? 0 : format[1] - '0';
    } else if (digit && format[0] == '.' && format[1] <= '6' && format[2] == 'f') {
        part.style = Style::fixed;
        part.decimals = format[1] - '0';
    } else if (format == "hms" || format == "hm") {
        part.style = Style::clock;
        part.decimals = static_cast<int>(format.size());
    } else {
        return false;
    }
    return true;
}

void Template::add_place(std::string_view inside, ValueTable& table, Allowed allowed,
                         const Dictionary* words) {
    const std::size_t colon = inside.rfind(':');
    const std::string_view name = inside.substr(0, colon);
    const std::string_view format = colon == std::string_view::npos ? "" : inside.substr(colon + 1);
    Part part;
    if (const auto text = text_value(name, table, allowed)) {
        part.style = *text == whole_row ? Style::row_text : *text < 0 ? Style::cell : Style::text;
        part.value =
            static_cast<std::size_t>(*text < 0 ? std::max<std::ptrdiff_t>(first_column - *text, 0) : *text);
        if (!text_format(format, part)) {
            throw ExpressionError(fmt::format("{{{}}} is a text; expected no format, or one of stem, ending, "
                                              "A+N (N bytes from A on)",
                                              inside),
                                  {});
        }
    } else {
        part.expression = Expression(name, table, allowed);
        if (format == "name" && table.find(name)) {
            part.style = Style::named;
            part.names = table.at(*table.find(name)).names;
            for (auto& [number, word] : part.names) {
                if (const auto hit = words == nullptr ? Dictionary::const_iterator{} : words->find(word);
                    words != nullptr && hit != words->end()) {
                    word = hit->second;
                }
            }
        } else if (!number_format(format, part)) {
            throw ExpressionError(
                fmt::format(
                    "unknown format \"{}\" in {{{}}}; expected .0f to .6f, d, 01d to 09d, hms, hm, or "
                    "name",
                    format, inside),
                {});
        }
    }
    if (const auto id = table.find(name);
        id && std::find(values_.begin(), values_.end(), *id) == values_.end()) {
        values_.push_back(*id);
    }
    parts_.push_back(std::move(part));
}

std::string_view Template::text_of(const Part& part, const Scope& scope) {
    const std::string_view text = part.style == Style::row_text ? scope.row_text
                                  : part.style == Style::cell
                                      ? cell(scope, part.value)
                                      : std::string_view(scope.values[part.value].text);
    switch (part.piece) {
        case Piece::slice:
            return part.from < text.size() ? text.substr(part.from, part.size) : std::string_view{};
        case Piece::stem:
            return stem_of(text);
        case Piece::ending:
            return text.substr(stem_of(text).size());
        case Piece::all:
            break;
    }
    return text;
}

std::string Template::number_of(const Part& part, const Scope& scope) {
    const double value = part.expression.evaluate(scope);
    switch (part.style) {
        case Style::fixed:
            return fixed_text(value, part.decimals);
        case Style::whole:
            return fmt::format("{:0{}d}", whole(value), part.decimals);
        case Style::clock: {
            const std::int64_t s = std::max<std::int64_t>(whole(value), 0);
            return fmt::format("{:02d}:{:02d}", s / 3600, s / 60 % 60) +
                   (part.decimals == 3 ? fmt::format(":{:02d}", s % 60) : "");
        }
        case Style::named:
            if (const auto hit = part.names.find(whole(value)); hit != part.names.end()) {
                return hit->second;
            }
            break;
        default:
            break;
    }
    return short_text(value);
}

std::string Template::render(const Scope& scope, bool for_people) const {
    std::string out;
    for (const Part& part : parts_) {
        if (part.style == Style::literal) {
            out += part.literal;
        } else if (part.style < Style::text) {
            out += number_of(part, scope);
        } else if (for_people) {
            out += printable(text_of(part, scope));
        } else {
            out += text_of(part, scope);
        }
    }
    return out;
}

Condition::Condition(std::string_view left, const Json& right, ValueTable& table, Allowed allowed)
    : source_(left) {
    if (const auto text = text_value(left, table, allowed)) {
        is_text_ = true;
        value_ = *text;
    } else {
        left_ = Expression(left, table, allowed);
    }
    set_right(right, table, allowed);
}

void Condition::set_right(const Json& right, ValueTable& table, Allowed allowed) {
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

void Condition::set_range(const Json& right, ValueTable& table, Allowed allowed) {
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

void Condition::add_operand(const Json& value, ValueTable& table, Allowed allowed) {
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
        return (!has_min_ || left >= first - tolerance) && (!has_max_ || left <= last + tolerance);
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
    return holds_text(text(scope));
}

std::string_view Condition::text(const Scope& scope) const {
    return value_ == whole_row ? scope.row_text
           : value_ < 0        ? cell(scope, static_cast<std::size_t>(first_column - value_))
                               : std::string_view(scope.values[static_cast<std::size_t>(value_)].text);
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
    return '"' + printable(text(scope)) + '"';
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
        fresh.push_back(
            {text ? 0 : one.expression.evaluate(scope), text ? one.text.render(scope) : "", {}, {}, {}});
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
