#include "tools/ctl_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/fields.h"

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string value_text(const Json& value) {
    if (value.is_number_float()) {
        return fmt::format("{:g}", std::round(value.get<double>() * 1000) / 1000);
    }
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string unit_of(const std::string& path) {
    const behaviour::Field* field = behaviour::find_field(path);
    return field == nullptr || field->unit.empty() ? "" : " " + std::string(field->unit);
}

/// Without those that other kinds of machines have, unless only such were asked for.
std::string fields_text(const Json& fields) {
    const bool none = std::all_of(fields.begin(), fields.end(), [](const Json& v) { return v.is_null(); });
    std::size_t width = 0;
    for (const auto& [path, value] : fields.items()) {
        width = std::max(width, none || !value.is_null() ? path.size() : 0);
    }
    std::string out;
    for (const auto& [path, value] : fields.items()) {
        if (value.is_null()) {
            out += none ? fmt::format("{:<{}}  none: this board has no such thing\n", path, width) : "";
        } else {
            out += fmt::format("{:<{}}  {}{}\n", path, width, value_text(value), unit_of(path));
        }
    }
    return out;
}

std::string fault_text(const Json& fault) {
    std::string out;
    for (const auto& [key, value] : fault.items()) {
        const std::string blank = out.empty() ? "" : " ";
        out += value.is_object() ? blank + fault_text(value)
                                 : fmt::format("{}{}={}", blank, key, value_text(value));
    }
    return out;
}

/// Members of an answer, whatever they are, one a line.
std::string members_text(const Json& object, const std::string& prefix = "") {
    std::string out;
    for (const auto& [key, value] : object.items()) {
        if (prefix.empty() && (key == "id" || key == "ok" || key == "notices")) {
            continue;
        }
        if (prefix.empty() && key == "fields") {
            out += fields_text(value);
        } else if (value.is_object()) {
            out += members_text(value, prefix + key + ".");
        } else {
            out += fmt::format("{}{}: {}\n", prefix, key, value_text(value));
        }
    }
    return out;
}

/// A page of a screen: title, what can be read, the box over it, what can be touched and where.
std::string page_text(const Json& page) {
    std::string out = fmt::format("{}  [{}]\n", page.value("title", ""), page.value("page", ""));
    for (const Json& text : page.at("texts")) {
        out += "  " + value_text(text) + "\n";
    }
    if (const Json& box = page.at("box"); box.is_object()) {
        out += fmt::format("box  {}\n", box.value("caption", ""));
        for (std::string text = box.value("text", ""); !text.empty();) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            out += "  " + text.substr(0, end) + "\n";
            text.erase(0, end + 1);
        }
    }
    for (const Json& control : page.at("controls")) {
        out +=
            fmt::format("{:>4},{:<3} {:>3}x{:<3} {}{}{}\n", control.value("x", 0), control.value("y", 0),
                        control.value("w", 0), control.value("h", 0), control.value("name", ""),
                        control.value("label", "").empty() ? "" : "  \"" + control.value("label", "") + "\"",
                        control.value("enabled", true) ? "" : "  (dead)");
    }
    return out;
}

}  // namespace

std::string answer_text(const Json& answer) {
    if (answer.contains("controls") && answer.contains("box")) {
        return page_text(answer);
    }
    if (const auto faults = answer.find("faults"); faults != answer.end() && faults->is_array()) {
        std::string out = faults->empty() ? "no faults\n" : "";
        for (const Json& fault : *faults) {
            out += fault_text(fault) + "\n";
        }
        return out;
    }
    if (const auto fields = answer.find("fields"); fields != answer.end()) {
        return fields_text(*fields);
    }
    return members_text(answer);
}

std::string event_text(const Json& event) {
    const std::string kind = event.value("event", "");
    const std::string t = fmt::format("{:>10.3f}", event.value("t", 0.0));
    if (kind == "traffic") {
        const std::string from = event.value("from", "");
        const std::string refused = event.contains("refused") ? " (" + event.value("refused", "") + ")" : "";
        return fmt::format("{} {} {}{}\n", t,
                           from == "board"  ? "<-"
                           : from == "host" ? "=>"
                                            : "->",
                           event.value("line", ""), refused);
    }
    if (kind == "state") {
        std::string out;
        for (const auto& [path, value] : event.at("fields").items()) {
            out += fmt::format("{} {} = {}{}\n", t, path, value_text(value), unit_of(path));
        }
        return out;
    }
    if (kind == "lost") {
        return fmt::format("           ({} events were lost: this end read too slowly)\n",
                           event.value("count", 0));
    }
    return fmt::format("{} {}\n", t,
                       kind == "notice" ? event.value("level", "") + ": " + event.value("text", "")
                                        : "link " + event.value("state", "") + ": " + event.value("why", ""));
}

}  // namespace fauxboard::tools
