#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/fault/dice.h"
#include "emulator/fault/spec.h"
#include "emulator/machine/faults.h"

namespace fauxboard::fault {

enum class AttributeType : std::uint8_t { number, integer, time, rate, temperature, choice };
std::string_view type_name(AttributeType type);

/// One attribute of a fault, declared once: both forms of a spec, the errors and the reference read this row.
struct Attribute {
    std::string_view name;
    AttributeType type;
    std::optional<double> fallback;  ///< when it is not given; none: then it does not restrict
    double min;                      ///< in microseconds, bytes per second, C; choices: 0
    double max;
    std::string_view help;
    std::span<const std::string_view> choices{};
};

/// An attribute that every kind has.
struct CommonAttribute : Attribute {
    std::optional<double> (*get)(const FaultSpec&);  ///< none: not given
    void (*set)(FaultSpec&, double);
};

/// A line on its way, or a part of one. Long lines and lines that stall come in parts.
struct LineEdit {
    std::string bytes;       ///< with the line end, if it is in this part
    bool first = true;       ///< the line begins here; else this is more of the line that was last acted on
    std::size_t copies = 1;  ///< how many times it goes on
    std::size_t room = 0;    ///< how many bytes it may grow, all copies together

    /// Bytes before the line end ("\r\n", "\n" or "\r").
    std::size_t text_size() const;
    std::string_view text() const { return std::string_view(bytes).substr(0, text_size()); }
    /// How much of the room one more copy takes: short lines count as more, for the sake of the time they
    /// take.
    std::size_t copy_cost() const { return std::max<std::size_t>(bytes.size(), 256); }
    /// Nothing of the line has gone by before, and nothing will come after.
    bool whole() const { return first && text_size() != bytes.size(); }
};

/// How a line travels: later by `delay`, and, if a rate is given, byte by byte.
struct Pace {
    SimTime delay{0};
    double bytes_per_s = 0;  ///< 0: all at once
};

/// A time in which all bytes are lost.
struct Interruption {
    SimTime length{0};
    bool link_down = false;  ///< the link itself is gone, in both directions
};

/// What a kind of fault is. Exactly one of edit, pace, interrupt and printer is set.
struct Kind {
    std::string_view name;
    std::string_view help;
    std::span<const Attribute>
        attributes;  ///< its own, at most Values::most; they hide common ones of their name

    /// Changes the bytes of a line it acts on, and of every further part of that line.
    void (*edit)(LineEdit& line, const Values& values, Dice& dice) = nullptr;
    /// How a line it acts on travels.
    Pace (*pace)(const Values& values, Dice& dice) = nullptr;
    /// How long the line is dead.
    Interruption (*interrupt)(const Values& values) = nullptr;
    /// Lines it can act on; others are not even counted. Null: all.
    bool (*applies)(const LineEdit& line) = nullptr;
    /// It is the printer that breaks, not the line: no business of a FaultLine.
    const machine::FaultInfo* printer = nullptr;
};

/// Every kind of fault of a line, in the order of the reference.
std::span<const Kind* const> kinds();
/// The printer's, one for each of machine::fault_rows(), in that order.
std::span<const Kind* const> printer_kinds();
/// The kind of that name, of either, or null.
const Kind* find_kind(std::string_view name);
/// What every kind has beside its own attributes.
std::span<const CommonAttribute> common_attributes();
/// True unless an attribute of the kind's own hides it.
bool takes_common(const Kind& kind, std::string_view name);

/// A value as in a compact spec: "200ms", "0.01", "to_screen".
std::string attribute_text(const Attribute& attribute, double value);
/// The same as JSON: numbers are numbers, all else is text.
Json attribute_json(const Attribute& attribute, double value);
/// "a whole number from 1 to 10".
std::string expected_text(const Attribute& attribute);
/// The value, or nothing when it is none or out of bounds.
std::optional<double> attribute_from_text(const Attribute& attribute, std::string_view text);
std::optional<double> attribute_from_json(const Attribute& attribute, const Json& json);

/// The reference: {"common": [attributes], "kinds": [{"name", "help", "attributes"}], "printer": {"common":
/// [...], "kinds": [{"name", "help", "events", "back", "attributes"}]}}.
Json describe_kinds();

}  // namespace fauxboard::fault
