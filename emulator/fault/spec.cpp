#include "emulator/fault/spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/reader.h"
#include "emulator/fault/kind.h"
#include "emulator/fault/quantity.h"

namespace fauxboard::fault {
namespace {

constexpr std::size_t longest_shown = 60;

std::string in_quotes(std::string_view text) {
    return fmt::format("\"{}{}\"", text.substr(0, longest_shown), text.size() > longest_shown ? "..." : "");
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
    const std::string_view name = behaviour::nearest(word, names);
    return name.empty() ? std::string() : fmt::format("; did you mean \"{}\"?", name);
}

/// Builds a spec attribute by attribute and remembers all that is wrong.
class SpecReader {
  public:
    /// `label` is what the sentences call the fault.
    explicit SpecReader(std::string_view label) : label_(label) {}

    void kind(std::string_view name);
    void missing_kind();
    /// Looks the attribute up and calls read(row), which gives the value if it is right. `found` is its text
    /// for a person.
    template <class F>
    void attribute(std::string_view name, std::string_view found, F&& read);
    void complain(std::string_view problem) {
        const std::string label = label_.empty() ? "" : " " + in_quotes(label_);
        problems_.push_back(fmt::format("fault{}: {}", label, problem));
    }
    bool knows_kind() const { return spec_.kind != nullptr; }
    bool is_for_printer() const { return spec_.kind->printer != nullptr; }
    /// Throws if anything was wrong.
    FaultSpec finish();

  private:
    void unknown(std::string_view name);
    void check_at();
    void check_window();
    void check_interruption();

    std::string label_;
    FaultSpec spec_;
    std::vector<std::string> given_;
    std::vector<std::string> problems_;
};

/// Those of both, for what is like a wrong name.
std::vector<std::string_view> kind_names() {
    std::vector<std::string_view> names;
    for (const auto all : {kinds(), printer_kinds()}) {
        for (const Kind* kind : all) {
            names.push_back(kind->name);
        }
    }
    return names;
}

/// The printer has so many more that they are not all named.
std::string expected_kind() {
    std::string out = "expected one of ";
    for (const Kind* kind : kinds()) {
        out.append(kind->name).append(", ");
    }
    return out + "or a fault of the printer (see `describe faults`)";
}

void SpecReader::kind(std::string_view name) {
    spec_.kind = find_kind(name);
    if (spec_.kind == nullptr) {
        const auto names = kind_names();
        complain(fmt::format("unknown kind {}; {}{}", in_quotes(name), expected_kind(),
                             did_you_mean(name, names)));
        return;
    }
    for (std::size_t i = 0; i < spec_.kind->attributes.size(); ++i) {
        spec_.values.set(i, spec_.kind->attributes[i].fallback.value_or(0));
    }
}

void SpecReader::missing_kind() {
    complain("found no kind; " + expected_kind());
}

void SpecReader::unknown(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Attribute& own : spec_.kind->attributes) {
        names.push_back(own.name);
    }
    for (const CommonAttribute& common : common_attributes()) {
        if (takes_common(*spec_.kind, common.name)) {
            names.push_back(common.name);
        }
    }
    complain(fmt::format("unknown attribute {}; {} takes {}{}", in_quotes(name), spec_.kind->name,
                         fmt::join(names, ", "), did_you_mean(name, names)));
}

template <class F>
void SpecReader::attribute(std::string_view name, std::string_view found, F&& read) {
    if (std::find(given_.begin(), given_.end(), name) != given_.end()) {
        complain(fmt::format("{} is given twice; expected it once", name));
        return;
    }
    given_.emplace_back(name);
    const auto take = [&](const Attribute& row, auto&& set) {
        if (const std::optional<double> value = read(row)) {
            set(*value);
            return;
        }
        complain(fmt::format("{}: found {}; expected {}{}", name, found, expected_text(row),
                             did_you_mean(found, row.choices)));
    };
    const auto& own = spec_.kind->attributes;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i].name == name) {
            return take(own[i], [&](double value) { spec_.values.set(i, value); });
        }
    }
    for (const CommonAttribute& common : common_attributes()) {
        if (common.name == name && takes_common(*spec_.kind, name)) {
            return take(common, [&](double value) { common.set(spec_, value); });
        }
    }
    unknown(name);
}

void SpecReader::check_at() {
    const bool lasts = spec_.kind->printer != nullptr;  // then it only says when it begins
    for (const std::string& name : given_) {
        if (lasts && name != "from") {
            continue;
        }
        const bool length = name == "for" && takes_common(*spec_.kind, name);
        if (length || name == "probability" || name == "every" || name == "after" || name == "count" ||
            name == "from" || name == "until") {
            complain(fmt::format(
                "found at and {} together; expected only one of them: at says when it acts, once", name));
        }
    }
}

void SpecReader::check_window() {
    const Trigger& trigger = spec_.trigger;
    if (trigger.until && trigger.length) {
        complain("found until and for together; expected only one of them: both say when it ends");
    }
    const std::optional<SimTime> from = trigger.at ? trigger.at : trigger.from;
    if (trigger.until && from && *trigger.until <= *from) {
        complain(fmt::format("until: found {}; expected a time after {}, {}", time_text(*trigger.until),
                             trigger.at ? "at" : "from", time_text(*from)));
    }
}

void SpecReader::check_interruption() {
    const Trigger& trigger = spec_.trigger;
    if (trigger.by_line()) {
        return;
    }
    const std::string_view wrong = trigger.until ? "until" : trigger.count ? "count" : "";
    if (!wrong.empty()) {
        complain(fmt::format(
            "found {} without probability, every or after; expected \"for\", how long it lasts: then "
            "{} comes once, by time alone",
            wrong, spec_.kind->name));
    }
}

FaultSpec SpecReader::finish() {
    if (problems_.empty()) {
        if (spec_.trigger.at) {
            check_at();
        }
        check_window();
        if (spec_.kind->interrupt != nullptr && !spec_.trigger.at) {
            check_interruption();
        }
    }
    if (!problems_.empty()) {
        throw FaultSpecError(std::move(problems_));
    }
    return spec_;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

void read_item(SpecReader& reader, std::string_view item) {
    const std::size_t equals = item.find('=');
    if (item.empty()) {
        reader.complain("found nothing between two commas; expected name=value or a direction");
    } else if (equals != std::string_view::npos) {
        const std::string_view value = trimmed(item.substr(equals + 1));
        reader.attribute(trimmed(item.substr(0, equals)), in_quotes(value),
                         [&](const Attribute& row) { return attribute_from_text(row, value); });
    } else if (reader.is_for_printer()) {
        reader.complain(fmt::format("found {}; expected name=value", in_quotes(item)));
    } else {
        const Attribute& direction = common_attributes().front();
        if (!attribute_from_text(direction, item)) {
            reader.complain(fmt::format("found {}; expected name=value or a direction, {}{}", in_quotes(item),
                                        expected_text(direction), did_you_mean(item, direction.choices)));
            return;
        }
        reader.attribute(direction.name, item,
                         [&](const Attribute& row) { return attribute_from_text(row, item); });
    }
}

/// Calls give(attribute, value) for what differs from the default.
template <class F>
void for_each_given(const FaultSpec& spec, F&& give) {
    const auto tell = [&](const Attribute& row, double value) {
        if (!row.fallback || *row.fallback != value) {
            give(row, value);
        }
    };
    for (const CommonAttribute& row : common_attributes()) {
        // A trigger at its default is still one: it makes lines decide.
        const std::optional<double> value = row.get(spec);
        if (value && takes_common(*spec.kind, row.name)) {
            const bool always = row.name == "probability" || row.name == "every" || row.name == "after";
            always ? give(row, *value) : tell(row, *value);
        }
    }
    for (std::size_t i = 0; i < spec.kind->attributes.size(); ++i) {
        tell(spec.kind->attributes[i], spec.values.number(i));
    }
}

}  // namespace

FaultSpecError::FaultSpecError(std::vector<std::string> problems)
    : std::runtime_error(fmt::format("{}", fmt::join(problems, "\n"))), problems_(std::move(problems)) {}

FaultSpec fault_from_text(std::string_view text) {
    SpecReader reader(text);
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string_view name = trimmed(text.substr(0, colon));
    name.empty() ? reader.missing_kind() : reader.kind(name);
    std::string_view rest = text.substr(colon);
    while (!rest.empty() && reader.knows_kind()) {
        rest.remove_prefix(1);  // the colon, then commas
        const std::size_t comma = std::min(rest.find(','), rest.size());
        read_item(reader, trimmed(rest.substr(0, comma)));
        rest.remove_prefix(comma);
    }
    return reader.finish();
}

FaultSpec fault_from_json(const Json& json) {
    if (json.is_string()) {
        return fault_from_text(json.get_ref<const std::string&>());
    }
    const Json* const kind = json.is_object() && json.contains("kind") ? &json["kind"] : nullptr;
    const bool named = kind != nullptr && kind->is_string();
    SpecReader reader(named ? kind->get_ref<const std::string&>() : "");
    if (!json.is_object()) {
        reader.complain(behaviour::found(json) +
                        "; expected an object such as {\"kind\":\"drop\"}, or a text");
    } else if (kind == nullptr) {
        reader.missing_kind();
    } else if (!named) {
        reader.complain("kind: " + behaviour::found(*kind) + "; expected a text");
    } else {
        reader.kind(kind->get_ref<const std::string&>());
    }
    if (reader.knows_kind()) {
        for (const auto& [key, value] : json.items()) {
            if (key != "kind") {
                const std::string found = value.is_string() ? in_quotes(value.get_ref<const std::string&>())
                                                            : behaviour::found(value).substr(6);
                reader.attribute(key, found,
                                 [&v = value](const Attribute& row) { return attribute_from_json(row, v); });
            }
        }
    }
    return reader.finish();
}

std::string fault_to_text(const FaultSpec& spec) {
    std::string out(spec.kind->name);
    char separator = ':';
    for_each_given(spec, [&](const Attribute& row, double value) {
        out += separator;
        separator = ',';
        if (row.name != "direction") {
            out.append(row.name).append("=");
        }
        out += attribute_text(row, value);
    });
    return out;
}

Json fault_to_json(const FaultSpec& spec) {
    Json out{{"kind", spec.kind->name}};
    for_each_given(spec, [&](const Attribute& row, double value) {
        out[std::string(row.name)] = attribute_json(row, value);
    });
    return out;
}

}  // namespace fauxboard::fault
