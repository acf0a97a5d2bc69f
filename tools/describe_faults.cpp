#include "tools/describe_faults.h"

#include <fmt/format.h>

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string plain(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// "number 0 to 1, default 0.5", "kept|lost, default kept".
std::string range(const Json& attribute) {
    std::string out;
    if (const auto choices = attribute.find("choices"); choices != attribute.end()) {
        for (const Json& choice : *choices) {
            out += (out.empty() ? "" : " or ") + plain(choice);
        }
    } else {
        out = fmt::format("{} {} to {}", plain(attribute["type"]), plain(attribute["min"]),
                          plain(attribute["max"]));
    }
    if (const auto fallback = attribute.find("default"); fallback != attribute.end()) {
        out += ", default " + plain(*fallback);
    }
    return out;
}

std::string rows_text(const Json& attributes) {
    std::string out;
    for (const Json& attribute : attributes) {
        out += fmt::format("      {:<12} {} ({})\n", plain(attribute["name"]), plain(attribute["help"]),
                           range(attribute));
    }
    return out;
}

std::string rows_markdown(const Json& attributes) {
    std::string out;
    for (const Json& attribute : attributes) {
        out += fmt::format("| `{}` | {} | {} |\n", plain(attribute["name"]), range(attribute),
                           plain(attribute["help"]));
    }
    return out;
}

/// "filament.out, job.paused", or that there are none.
std::string events_of(const Json& kind) {
    std::string out;
    for (const Json& event : kind["events"]) {
        out += (out.empty() ? "" : ", ") + plain(event);
    }
    return out;
}

std::string printer_text(const Json& faults) {
    std::string out =
        "  faults of the printer: kinds of `run`, not of `tap` (\"jam:at=60s,for=30s\", "
        "\"heater_dead:heater=bed\")\n";
    for (const Json& kind : faults["kinds"]) {
        out += fmt::format("  {:<16} {}\n", plain(kind["name"]), plain(kind["help"]));
        const std::string events = events_of(kind);
        out += events.empty() ? "" : fmt::format("      raises {}\n", events);
        out +=
            plain(kind["back"]).empty() ? "" : fmt::format("      also ended by {}\n", plain(kind["back"]));
        out += rows_text(kind["attributes"]);
    }
    return out + "  each of them takes\n" + rows_text(faults["common"]);
}

constexpr std::string_view table_head = "\n| Attribute | Values | Meaning |\n| --- | --- | --- |\n";

std::string printer_markdown(const Json& faults) {
    std::string out =
        "\n### Faults of the printer\n\nThe same spelling, for the machine instead of the line: "
        "`jam:at=60s,for=30s`, `heater_dead:heater=bed`. A field `faults.` and the name says whether one is "
        "in "
        "force; what it makes the board say stands in the profile, at the event that it raises.\n";
    for (const Json& kind : faults["kinds"]) {
        const std::string events = events_of(kind);
        const std::string back = plain(kind["back"]);
        out += fmt::format("\n**`{}`** {}.{}{}\n", plain(kind["name"]), plain(kind["help"]),
                           events.empty() ? "" : " Raises " + events + ".",
                           back.empty() ? "" : " Also ended by " + back + ".");
        if (!kind["attributes"].empty()) {
            out += std::string(table_head) + rows_markdown(kind["attributes"]);
        }
    }
    return out + "\nEach of them takes these:\n" + std::string(table_head) + rows_markdown(faults["common"]);
}

}  // namespace

std::string faults_text(const Json& faults) {
    std::string out =
        "FAULTS: what --fault takes: a kind, then attributes in any order (\"garble:to_screen,every=5\")\n";
    for (const Json& kind : faults["kinds"]) {
        out += fmt::format("  {:<16} {}\n", plain(kind["name"]), plain(kind["help"]));
        out += rows_text(kind["attributes"]);
    }
    return out + "  each of them takes, unless it has an attribute of that name itself\n" +
           rows_text(faults["common"]) + printer_text(faults["printer"]);
}

std::string faults_markdown(const Json& faults) {
    std::string out =
        "\n## Faults\n\nWhat `--fault` takes: a kind, then attributes in any order, such as "
        "`garble:to_screen,every=5` or `delay:time=200ms,jitter=50ms`. Times and rates carry their unit. "
        "What is not given does not restrict.\n";
    for (const Json& kind : faults["kinds"]) {
        out += fmt::format("\n**`{}`** {}.\n", plain(kind["name"]), plain(kind["help"]));
        if (!kind["attributes"].empty()) {
            out += std::string(table_head) + rows_markdown(kind["attributes"]);
        }
    }
    return out + "\nEvery kind takes these, unless it has an attribute of that name itself:\n" +
           std::string(table_head) + rows_markdown(faults["common"]) + printer_markdown(faults["printer"]);
}

}  // namespace fauxboard::tools
