// Values of attributes to and from text and JSON.

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/fault/kind.h"
#include "emulator/fault/quantity.h"

namespace fauxboard::fault {
namespace {

std::optional<double> number_of(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (result.ec != std::errc{} || result.ptr != end) {
        return std::nullopt;
    }
    return number;
}

std::optional<double> choice_of(const Attribute& attribute, std::string_view text) {
    for (std::size_t i = 0; i < attribute.choices.size(); ++i) {
        if (attribute.choices[i] == text) {
            return static_cast<double>(i);
        }
    }
    return std::nullopt;
}

/// Texts that are not plain numbers.
bool has_words(const Attribute& attribute) {
    return attribute.type != AttributeType::number && attribute.type != AttributeType::integer;
}

std::optional<double> in_bounds(const Attribute& attribute, std::optional<double> value) {
    if (!value) {
        return value;
    }
    if (attribute.type == AttributeType::time) {
        value = std::round(*value);
    }
    const bool whole = attribute.type != AttributeType::integer || *value == std::floor(*value);
    // Not a number is in no bounds.
    return whole && *value >= attribute.min && *value <= attribute.max ? value : std::nullopt;
}

}  // namespace

std::string_view type_name(AttributeType type) {
    switch (type) {
        case AttributeType::number:
            return "number";
        case AttributeType::integer:
            return "integer";
        case AttributeType::time:
            return "time";
        case AttributeType::rate:
            return "rate";
        case AttributeType::temperature:
            return "temperature";
        case AttributeType::choice:
            break;
    }
    return "choice";
}

std::string attribute_text(const Attribute& attribute, double value) {
    switch (attribute.type) {
        case AttributeType::number:
            return fmt::format("{}", value);
        case AttributeType::integer:
            return fmt::format("{:.0f}", value);
        case AttributeType::time:
            return time_text(SimTime{static_cast<SimTime::rep>(value)});
        case AttributeType::rate:
            return fmt::format("{}B/s", value);
        case AttributeType::temperature:
            return fmt::format("{}C", value);
        case AttributeType::choice:
            break;
    }
    return std::string(attribute.choices[static_cast<std::size_t>(value)]);
}

Json attribute_json(const Attribute& attribute, double value) {
    if (attribute.type == AttributeType::number) {
        return value;
    }
    if (attribute.type == AttributeType::integer) {
        return static_cast<std::int64_t>(value);
    }
    return attribute_text(attribute, value);
}

std::string expected_text(const Attribute& attribute) {
    const auto bound = [&](double value) { return attribute_text(attribute, value); };
    switch (attribute.type) {
        case AttributeType::number:
            return fmt::format("a number from {} to {}", bound(attribute.min), bound(attribute.max));
        case AttributeType::integer:
            return fmt::format("a whole number from {} to {}", bound(attribute.min), bound(attribute.max));
        case AttributeType::time:
            return fmt::format("a time from {} to {} with its unit, such as \"200ms\"", bound(attribute.min),
                               bound(attribute.max));
        case AttributeType::rate:
            return fmt::format("a rate from {} to {} with its unit, such as \"960B/s\"", bound(attribute.min),
                               bound(attribute.max));
        case AttributeType::temperature:
            return fmt::format("a temperature from {} to {}, such as \"200C\"", bound(attribute.min),
                               bound(attribute.max));
        case AttributeType::choice:
            break;
    }
    return fmt::format("one of {}", fmt::join(attribute.choices, ", "));
}

std::optional<double> attribute_from_text(const Attribute& attribute, std::string_view text) {
    switch (attribute.type) {
        case AttributeType::number:
        case AttributeType::integer:
            return in_bounds(attribute, number_of(text));
        case AttributeType::time:
            return in_bounds(attribute, parse_quantity(text, time_units()));
        case AttributeType::rate:
            return in_bounds(attribute, parse_quantity(text, rate_units()));
        case AttributeType::temperature:
            return in_bounds(attribute, parse_quantity(text, temperature_units()));
        case AttributeType::choice:
            break;
    }
    return choice_of(attribute, text);
}

std::optional<double> attribute_from_json(const Attribute& attribute, const Json& json) {
    if (has_words(attribute)) {
        return json.is_string() ? attribute_from_text(attribute, json.get_ref<const std::string&>())
                                : std::nullopt;
    }
    return json.is_number() ? in_bounds(attribute, json.get<double>()) : std::nullopt;
}

}  // namespace fauxboard::fault
