// The reference for people: both forms are written from the same JSON.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/describe_control.h"
#include "tools/describe_faults.h"
#include "tools/describe_reference.h"
#include "tools/describe_scenarios.h"

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;
using Out = std::back_insert_iterator<std::string>;

std::string text_of(const Json& row, const char* key) {
    const auto hit = row.find(key);
    return hit == row.end() ? std::string{} : hit->get<std::string>();
}

std::string bounds(const Json& field) {
    if (field.contains("max_bytes")) {
        return fmt::format("to {} bytes", field["max_bytes"].get<int>());
    }
    return field.contains("min")
               ? fmt::format("{} to {}", field["min"].get<double>(), field["max"].get<double>())
               : std::string{};
}

std::string access(const Json& field) {
    return !field["settable"].get<bool>() ? "read" : field["stored"].get<bool>() ? "set, stored" : "set";
}

/// "heater (text), c (number)"; what may be left out stands in square brackets.
std::string signature(const Json& action) {
    std::string out;
    for (const Json& arg : action["arguments"]) {
        const std::string name = text_of(arg, "name");
        out += (out.empty() ? "" : ", ") + (arg["required"].get<bool>() ? name : "[" + name + "]");
    }
    return out;
}

/// "0 = idle, 1 = printing"
std::string values(const Json& field) {
    std::string out;
    if (const auto list = field.find("values"); list != field.end()) {
        for (const Json& value : *list) {
            out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", value["value"].get<int>(),
                               text_of(value, "words"));
        }
    }
    return out;
}

/// What a field of a line means, in one piece.
std::string wire_meaning(const Json& field) {
    std::string out = text_of(field, "name");
    const auto add = [&](const std::string& more) {
        if (!more.empty()) {
            out += (out.empty() ? "" : "; ") + more;
        }
    };
    add(values(field));
    add(text_of(field, "meaning"));
    if (field.contains("when_first_field_is")) {
        add(fmt::format("only when the first field is {}", field["when_first_field_is"].get<int>()));
    }
    return out;
}

std::string wire_type(const Json& field) {
    std::string out = text_of(field, "kind");
    if (field.contains("decimals")) {
        out += fmt::format(".{}", field["decimals"].get<int>());
    }
    const std::string unit = text_of(field, "unit");
    return unit.empty() ? out : out + " " + unit;
}

// For a terminal.
// -----------------------------------------------------------------------------------------------

void fields_text(const Json& rows, Out out) {
    std::size_t width = 0;
    for (const Json& row : rows) {
        width = std::max(width, text_of(row, "path").size());
    }
    fmt::format_to(out, "FIELDS: values of the machine, for frames, conditions and `set`\n");
    for (const Json& row : rows) {
        fmt::format_to(out, "  {:<{}}  {:<7} {:<6} {:<11} {:<14} {}\n", text_of(row, "path"), width,
                       text_of(row, "type"), text_of(row, "unit"), access(row), bounds(row),
                       text_of(row, "help"));
    }
}

void actions_text(const Json& rows, Out out) {
    fmt::format_to(out,
                   "ACTIONS: what rules, scenarios and people can do; arguments in [] may be left out\n");
    for (const Json& row : rows) {
        fmt::format_to(out, "  {}({}): {}", text_of(row, "name"), signature(row), text_of(row, "help"));
        const std::string phrase = text_of(row, "phrase");
        fmt::format_to(out, "{}\n", phrase.empty() ? "" : fmt::format(" [in recordings: \"{}\"]", phrase));
        for (const Json& arg : row["arguments"]) {
            fmt::format_to(out, "      {:<13} {:<8} {}\n", text_of(arg, "name"), text_of(arg, "type"),
                           text_of(arg, "help"));
        }
    }
}

void events_text(const Json& rows, Out out) {
    fmt::format_to(out,
                   "EVENTS: what the machine tells of itself; a profile says what the board does then\n");
    for (const Json& row : rows) {
        fmt::format_to(out, "  {:<22} {}\n", text_of(row, "name"), text_of(row, "help"));
    }
}

void codes_text(const Json& rows, Out out) {
    fmt::format_to(out, "CODES: the lines of the protocol; < from the screen, > to the screen\n");
    for (const Json& row : rows) {
        const std::string answer = text_of(row, "answer");
        fmt::format_to(out, "  {} {:<9} {}: {}{}\n", row["direction"] == "to_board" ? '<' : '>',
                       text_of(row, "code"), text_of(row, "title"), text_of(row, "meaning"),
                       answer.empty() ? "" : " Answer: " + answer + ".");
        for (const Json& field : row["fields"]) {
            fmt::format_to(out, "      {:<5} {:<16} {}\n", text_of(field, "key"), wire_type(field),
                           wire_meaning(field));
        }
    }
}

// Markdown.
// -----------------------------------------------------------------------------------------------

/// Text inside a table's cell.
std::string cell(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
        text.insert(at, 1, '\\');
    }
    return text;
}

std::string code_cell(const std::string& text) {
    return text.empty() ? std::string{} : "`" + cell(text) + "`";
}

void fields_markdown(const Json& rows, Out out) {
    fmt::format_to(
        out,
        "\n## Fields\n\nValues of the machine. Frames show them, conditions test them, `set` and "
        "`add` change those marked \"set\"; \"stored\" ones are kept by the EEPROM (M500).\n\n"
        "| Field | Type | Unit | Access | Bounds | Meaning |\n| --- | --- | --- | --- | --- | --- |\n");
    for (const Json& row : rows) {
        fmt::format_to(out, "| {} | {} | {} | {} | {} | {} |\n", code_cell(text_of(row, "path")),
                       text_of(row, "type"), text_of(row, "unit"), access(row), bounds(row),
                       cell(text_of(row, "help")));
    }
}

void actions_markdown(const Json& rows, Out out) {
    fmt::format_to(
        out,
        "\n## Actions\n\nWhat a rule's `do` can call. Arguments in square brackets may be left out. "
        "Those with a phrase can also be done to a running board, and stand under that name in "
        "recordings (`\"do\": \"filament in\"`).\n\n"
        "| Action | Arguments | Phrase | Does |\n| --- | --- | --- | --- |\n");
    for (const Json& row : rows) {
        std::string arguments;
        for (const Json& arg : row["arguments"]) {
            const bool required = arg["required"].get<bool>();
            arguments += fmt::format("{}{}`{}`{}: {}", arguments.empty() ? "" : "; ", required ? "" : "[",
                                     text_of(arg, "name"), required ? "" : "]", text_of(arg, "help"));
        }
        fmt::format_to(out, "| {} | {} | {} | {} |\n", code_cell(text_of(row, "name")), cell(arguments),
                       text_of(row, "phrase"), cell(text_of(row, "help")));
    }
}

void events_markdown(const Json& rows, Out out) {
    fmt::format_to(
        out, "\n## Events\n\nThe keys of a profile's `events`.\n\n| Event | Raised when |\n| --- | --- |\n");
    for (const Json& row : rows) {
        fmt::format_to(out, "| {} | {} |\n", code_cell(text_of(row, "name")), cell(text_of(row, "help")));
    }
}

void codes_of(const Json& rows, const char* direction, const char* title, Out out) {
    fmt::format_to(out, "\n### {}\n", title);
    for (const Json& row : rows) {
        if (row["direction"] != direction) {
            continue;
        }
        const std::string answer = text_of(row, "answer");
        fmt::format_to(out, "\n**{}** {}. {}{}\n", code_cell(text_of(row, "code")), text_of(row, "title"),
                       text_of(row, "meaning"), answer.empty() ? "" : " Answer: " + answer + ".");
        if (row["fields"].empty()) {
            continue;
        }
        fmt::format_to(out, "\n| Key | Type | Meaning |\n| --- | --- | --- |\n");
        for (const Json& field : row["fields"]) {
            fmt::format_to(out, "| {} | {} | {} |\n", code_cell(text_of(field, "key")), wire_type(field),
                           cell(wire_meaning(field)));
        }
    }
}

}  // namespace

std::string reference_text(const Json& reference) {
    std::string text;
    const Out out = std::back_inserter(text);
    for (const auto& [part, rows] : reference.items()) {
        if (!text.empty()) {
            text += '\n';
        }
        if (part == "fields") {
            fields_text(rows, out);
        } else if (part == "actions") {
            actions_text(rows, out);
        } else if (part == "events") {
            events_text(rows, out);
        } else if (part == "codes") {
            codes_text(rows, out);
        } else if (part == "faults") {
            text += faults_text(rows);
        } else if (part == "control") {
            text += control_text(rows);
        } else if (part == "scenarios") {
            text += scenarios_text(rows);
        }
    }
    return text;
}

std::string reference_markdown() {
    const Json reference = reference_json(reference_parts);
    std::string text =
        "# Reference\n\nMade from the tables in the code by `fauxboard describe --markdown`; a test "
        "compares. "
        "How to write a profile stands in [README.md](README.md).\n";
    const Out out = std::back_inserter(text);
    fields_markdown(reference["fields"], out);
    actions_markdown(reference["actions"], out);
    events_markdown(reference["events"], out);
    text +=
        "\n## Codes\n\nThe lines of the protocol. A number behind the type is its decimals on the wire.\n";
    codes_of(reference["codes"], "to_board", "From the screen", out);
    codes_of(reference["codes"], "to_screen", "To the screen", out);
    text += faults_markdown(reference["faults"]);
    text += control_markdown(reference["control"]);
    text += scenarios_markdown(reference["scenarios"]);
    return text;
}

}  // namespace fauxboard::tools
