#include "tools/describe_scenarios.h"

#include <fmt/format.h>

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string plain(const Json& value) {
    return value.get<std::string>();
}

/// A '|' would end the cell.
std::string cell(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
        text.insert(at, "\\");
    }
    return text;
}

}  // namespace

std::string scenarios_text(const Json& scenarios) {
    std::string out = "SCENARIOS: the steps of a file for run --script; every step may say \"why\"\n";
    for (const Json& step : scenarios["steps"]) {
        out += fmt::format("  {:<12} {}: {}\n               {}\n", plain(step["name"]), plain(step["type"]),
                           plain(step["help"]), plain(step["example"]));
        for (const Json& key : step["keys"]) {
            out += fmt::format("      {:<10} {} ({})\n", plain(key["name"]), plain(key["help"]),
                               plain(key["type"]));
        }
    }
    out += "  what can be waited for: {\"event\": \"motion.homed\"}\n";
    for (const Json& trigger : scenarios["triggers"]) {
        out += fmt::format("      {:<10} {} ({})\n", plain(trigger["name"]), plain(trigger["help"]),
                           plain(trigger["type"]));
    }
    return out;
}

std::string scenarios_markdown(const Json& scenarios) {
    std::string out =
        "\n## Scenarios\n\nThe steps of a file for `run --script`; "
        "[scenarios/README.md](scenarios/README.md) tells how "
        "they go together. Every step may say `why`: what it means that it is done, in words for a person, "
        "told "
        "when it fails. Numbers carry the unit of their field or argument (`\"200C\"`, `\"500ms\"`).\n";
    for (const Json& step : scenarios["steps"]) {
        out += fmt::format("\n**`{}`** ({}) {}.\n\n    {}\n", plain(step["name"]), plain(step["type"]),
                           plain(step["help"]), plain(step["example"]));
        if (!step["keys"].empty()) {
            out += "\n| Key | Values | Meaning |\n| --- | --- | --- |\n";
        }
        for (const Json& key : step["keys"]) {
            out += fmt::format("| `{}` | {} | {} |\n", plain(key["name"]), cell(plain(key["type"])),
                               cell(plain(key["help"])));
        }
    }
    out +=
        "\nWhat can be waited for, expected, or must never come: `{\"event\": \"motion.homed\"}`.\n\n| "
        "Trigger | Values "
        "| Meaning |\n| --- | --- | --- |\n";
    for (const Json& trigger : scenarios["triggers"]) {
        out += fmt::format("| `{}` | {} | {} |\n", plain(trigger["name"]), plain(trigger["type"]),
                           cell(plain(trigger["help"])));
    }
    return out;
}

}  // namespace fauxboard::tools
