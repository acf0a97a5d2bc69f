#include "tools/describe_control.h"

#include <fmt/format.h>

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& row, const char* key) {
    return row.at(key).get<std::string>();
}

/// Text inside a table's cell.
std::string cell(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
        text.insert(at, 1, '\\');
    }
    return text;
}

/// `fields` (an object): values by field ...; what may be left out stands in square brackets.
std::string param_cell(const Json& param) {
    const bool required = param.at("required").get<bool>();
    return fmt::format("{}`{}`{} ({}): {}", required ? "" : "[", text_of(param, "name"), required ? "" : "]",
                       text_of(param, "type"), text_of(param, "help"));
}

}  // namespace

std::string control_text(const Json& control) {
    std::string out =
        "CONTROL: the channel of `run --control`, a JSON object a line; parameters in [] may be left out\n";
    for (const Json& op : control.at("ops")) {
        out += fmt::format("  {:<14} {}\n", text_of(op, "name"), text_of(op, "help"));
        for (const Json& param : op.at("params")) {
            const std::string name = text_of(param, "name");
            out += fmt::format("      {:<10} {}: {}\n",
                               param.at("required").get<bool>() ? name : "[" + name + "]",
                               text_of(param, "type"), text_of(param, "help"));
        }
    }
    out += "  Topics of subscribe:\n";
    for (const Json& topic : control.at("topics")) {
        out += fmt::format("      {:<10} {}\n", text_of(topic, "name"), text_of(topic, "help"));
    }
    out += "  Codes of errors:\n";
    for (const Json& error : control.at("errors")) {
        out += fmt::format("      {:<17} {}\n", text_of(error, "code"), text_of(error, "help"));
    }
    return out;
}

std::string control_markdown(const Json& control) {
    std::string out =
        "\n## Control channel\n\n`fauxboard run --control PATH` opens a Unix socket. A request is a JSON "
        "object "
        "on a line of its own, `{\"id\": 1, \"op\": \"get\", \"fields\": \"heaters\"}`; its answer carries "
        "the "
        "same `id`, and `\"ok\": true` with what stands below, or `\"ok\": false` with an `error`: its "
        "`code`, a "
        "`message`, and the `nearest` known name. Parameters in square brackets may be left out. "
        "`fauxboard ctl PATH ...` does all of it from a shell.\n\n"
        "| Op | Does | Parameters |\n| --- | --- | --- |\n";
    for (const Json& op : control.at("ops")) {
        std::string params;
        for (const Json& param : op.at("params")) {
            params += (params.empty() ? "" : "; ") + param_cell(param);
        }
        out +=
            fmt::format("| `{}` | {} | {} |\n", text_of(op, "name"), cell(text_of(op, "help")), cell(params));
    }
    out +=
        "\nWhat a client has subscribed to comes in lines with `event` instead of `ok`, between answers. One "
        "that reads too slowly loses events, and is told by `{\"event\": \"lost\", \"count\": 12}`.\n\n"
        "| Topic | Tells | For example |\n| --- | --- | --- |\n";
    for (const Json& topic : control.at("topics")) {
        out += fmt::format("| `{}` | {} | `{}` |\n", text_of(topic, "name"), cell(text_of(topic, "help")),
                           cell(text_of(topic, "example")));
    }
    out += "\n| Error | Means |\n| --- | --- |\n";
    for (const Json& error : control.at("errors")) {
        out += fmt::format("| `{}` | {} |\n", text_of(error, "code"), cell(text_of(error, "help")));
    }
    return out;
}

}  // namespace fauxboard::tools
