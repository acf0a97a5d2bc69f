#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fauxboard::behaviour {

/// A number, a text, or nothing: what fields hold, parameters carry and actions take. Booleans are 0 and 1. A
/// text is borrowed and lives as long as the printer or the line it came from.
struct Value {
    enum class Kind : std::uint8_t { none, number, text };
    Kind kind = Kind::none;
    double number = 0;
    std::string_view text;

    static constexpr Value of(double n) { return {Kind::number, n, {}}; }
    static constexpr Value of(std::string_view t) { return {Kind::text, 0, t}; }
    constexpr bool none() const { return kind == Kind::none; }
    constexpr bool is_number() const { return kind == Kind::number; }
    constexpr bool is_text() const { return kind == Kind::text; }

    friend constexpr bool operator==(const Value& a, const Value& b) {
        return a.kind == b.kind &&
               (a.kind == Kind::none || (a.is_number() ? a.number == b.number : a.text == b.text));
    }
};

}  // namespace fauxboard::behaviour
