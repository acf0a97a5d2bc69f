#include "emulator/fault/kind.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "emulator/fault/kind_rows.h"
#include "emulator/fault/quantity.h"

namespace fauxboard::fault {
namespace {

constexpr std::array<const Kind*, 12> table{
    &rows::drop,    &rows::garble,     &rows::duplicate, &rows::delay,    &rows::slow,
    &rows::cut,     &rows::merge,      &rows::nul_burst, &rows::stray_ok, &rows::wrong_checksum,
    &rows::silence, &rows::disconnect,
};

constexpr double most_lines = 1e9;
constexpr double longest_us = 100.0 * 365 * 24 * 3600e6;

/// The rows' get and set for a member of Trigger, by its type.
template <auto Member>
constexpr auto get_of = [](const FaultSpec& spec) -> std::optional<double> {
    const auto& value = spec.trigger.*Member;
    if (!value) {
        return std::nullopt;
    }
    if constexpr (requires { value->count(); }) {
        return static_cast<double>(value->count());
    } else {
        return static_cast<double>(*value);
    }
};
template <auto Member>
constexpr auto set_of = [](FaultSpec& spec, double value) {
    auto& slot = spec.trigger.*Member;
    using T = typename std::remove_reference_t<decltype(slot)>::value_type;
    if constexpr (std::is_same_v<T, SimTime>) {
        slot = SimTime{static_cast<SimTime::rep>(value)};
    } else {
        slot = static_cast<T>(value);
    }
};

constexpr std::array<std::string_view, 3> directions{"to_screen", "to_board", "both"};
constexpr std::array<std::string_view, 2> lines{"main", "usb"};
constexpr std::array<CommonAttribute, 11> common{{
    {{"direction", AttributeType::choice, 2, 0, 2, "which way the spoiled bytes go", directions},
     [](const FaultSpec& s) -> std::optional<double> { return static_cast<double>(s.direction); },
     [](FaultSpec& s, double v) { s.direction = static_cast<Direction>(v); }},
    {{"line",
      AttributeType::choice,
      {},
      0,
      1,
      "which line of the board (unsaid: main, or the only one); to_screen is away from it on both",
      lines},
     [](const FaultSpec& s) -> std::optional<double> {
         return s.line ? std::optional(static_cast<double>(*s.line)) : std::nullopt;
     },
     [](FaultSpec& s, double v) { s.line = static_cast<Line>(v); }},
    {{"probability", AttributeType::number, 1, 0, 1, "the chance of each line"},
     get_of<&Trigger::probability>,
     set_of<&Trigger::probability>},
    {{"every", AttributeType::integer, 1, 1, most_lines, "only every n-th line"},
     get_of<&Trigger::every>,
     set_of<&Trigger::every>},
    {{"after", AttributeType::integer, 0, 0, most_lines, "so many lines are let be first"},
     get_of<&Trigger::after>,
     set_of<&Trigger::after>},
    {{"count", AttributeType::integer, {}, 1, most_lines, "acts at most so often, per direction"},
     get_of<&Trigger::count>,
     set_of<&Trigger::count>},
    {{"from",
      AttributeType::time,
      {},
      0,
      longest_us,
      "virtual time at which it begins; else when it is added"},
     get_of<&Trigger::from>,
     set_of<&Trigger::from>},
    {{"until", AttributeType::time, {}, 0, longest_us, "virtual time at which it ends"},
     get_of<&Trigger::until>,
     set_of<&Trigger::until>},
    {{"for", AttributeType::time, {}, 1, longest_us, "ends so long after it began"},
     get_of<&Trigger::length>,
     set_of<&Trigger::length>},
    {{"at",
      AttributeType::time,
      {},
      0,
      longest_us,
      "virtual time; acts once, on the first line from then on (silence, disconnect: at that moment)"},
     get_of<&Trigger::at>,
     set_of<&Trigger::at>},
    {{"seed", AttributeType::integer, 1, 0, 4294967295.0, "the same seed spoils the same bytes"},
     [](const FaultSpec& s) -> std::optional<double> { return static_cast<double>(s.seed); },
     [](FaultSpec& s, double v) { s.seed = static_cast<std::uint64_t>(v); }},
}};

constexpr std::array<Attribute, 4> printer_common{{
    {"at", AttributeType::time, {}, 0, longest_us, "virtual time at which it begins; else at once"},
    {"from", AttributeType::time, {}, 0, longest_us, "the same"},
    {"until", AttributeType::time, {}, 0, longest_us, "virtual time at which it ends; else when taken away"},
    {"for", AttributeType::time, {}, 1, longest_us, "ends so long after it began"},
}};

Json describe(const Attribute& attribute) {
    Json out{{"name", attribute.name}, {"type", type_name(attribute.type)}};
    if (attribute.fallback) {
        out["default"] = attribute_json(attribute, *attribute.fallback);
    }
    if (attribute.type == AttributeType::choice) {
        out["choices"] = attribute.choices;
    } else {
        out["min"] = attribute_json(attribute, attribute.min);
        out["max"] = attribute_json(attribute, attribute.max);
    }
    out["help"] = attribute.help;
    return out;
}

Json describe_printer_kinds() {
    Json out{{"common", Json::array()}, {"kinds", Json::array()}};
    for (const Attribute& attribute : printer_common) {
        out["common"].push_back(describe(attribute));
    }
    for (const Kind* kind : printer_kinds()) {
        Json events = Json::array();
        for (const machine::EventId id : kind->printer->events) {
            events.push_back(id->name);
        }
        Json row{{"name", kind->name},
                 {"help", kind->help},
                 {"events", std::move(events)},
                 {"back", kind->printer->back},
                 {"attributes", Json::array()}};
        for (const Attribute& attribute : kind->attributes) {
            row["attributes"].push_back(describe(attribute));
        }
        out["kinds"].push_back(std::move(row));
    }
    return out;
}

}  // namespace

std::size_t LineEdit::text_size() const {
    std::size_t size = bytes.size();
    if (size != 0 && bytes[size - 1] == '\n') {
        --size;
    }
    if (size != 0 && bytes[size - 1] == '\r') {
        --size;
    }
    return size;
}

std::span<const Kind* const> kinds() {
    return table;
}

const Kind* find_kind(std::string_view name) {
    for (const auto all : {kinds(), printer_kinds()}) {
        const auto hit =
            std::find_if(all.begin(), all.end(), [&](const Kind* kind) { return kind->name == name; });
        if (hit != all.end()) {
            return *hit;
        }
    }
    return nullptr;
}

std::span<const CommonAttribute> common_attributes() {
    return common;
}

bool takes_common(const Kind& kind, std::string_view name) {
    constexpr std::array of_printer{"at", "from", "until", "for"};  // it breaks by time, not by line
    if (kind.printer != nullptr &&
        std::find(of_printer.begin(), of_printer.end(), name) == of_printer.end()) {
        return false;
    }
    return std::none_of(kind.attributes.begin(), kind.attributes.end(),
                        [&](const Attribute& own) { return own.name == name; });
}

Json describe_kinds() {
    Json out{{"common", Json::array()}, {"kinds", Json::array()}};
    for (const CommonAttribute& attribute : common) {
        out["common"].push_back(describe(attribute));
    }
    for (const Kind* kind : table) {
        Json row{{"name", kind->name}, {"help", kind->help}, {"attributes", Json::array()}};
        for (const Attribute& attribute : kind->attributes) {
            row["attributes"].push_back(describe(attribute));
        }
        out["kinds"].push_back(std::move(row));
    }
    out["printer"] = describe_printer_kinds();
    return out;
}

}  // namespace fauxboard::fault
