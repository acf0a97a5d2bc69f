// Triggers, conditions, actions and bytes of a scenario's steps.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/control/names.h"
#include "emulator/script/compiler.h"
#include "emulator/script/placeholders.h"
#include "protocol/framing.h"

namespace fauxboard::script {
namespace {

using behaviour::FieldType;
using behaviour::found;
using behaviour::ObjectReader;

constexpr std::string_view variable_prefix = "var.";

std::string plain(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

bool is_number_field(const behaviour::Field* field) {
    return field != nullptr && (field->type == FieldType::number || field->type == FieldType::integer);
}

}  // namespace

std::string condition_words(const std::string& path, const Json& test) {
    if (!test.is_object()) {
        return fmt::format("{} to be {}", path, plain(test));
    }
    std::vector<std::string> parts;
    for (const auto& [key, value] : test.items()) {
        if (key == "min") {
            parts.push_back("at least " + plain(value));
        } else if (key == "max") {
            parts.push_back("at most " + plain(value));
        } else if (key == "not") {
            parts.push_back("other than " + plain(value));
        } else if (key == "in") {
            parts.push_back("one of " + value.dump());
        } else if (key == "starts_with") {
            parts.push_back("a text that starts with \"" + plain(value) + '"');
        }
    }
    return fmt::format("{} to be {}", path, fmt::join(parts, " and "));
}

// Triggers.
// -----------------------------------------------------------------------------------------------

std::span<const TriggerInfo> trigger_kinds() {
    static constexpr std::array table{
        TriggerInfo{"time", "time", "so much virtual time: \"500ms\"", Trigger::Kind::time},
        TriggerInfo{"request", "pattern",
                    "the screen asks the board something that matches; without frame and checksum",
                    Trigger::Kind::request},
        TriggerInfo{"line", "pattern",
                    "the board says a line to the screen that matches; without frame and checksum",
                    Trigger::Kind::line},
        TriggerInfo{"host_request", "pattern",
                    "a host program asks the board something that matches over its USB port; without number "
                    "and checksum",
                    Trigger::Kind::host_request},
        TriggerInfo{"host_line", "pattern", "the board says a line to the host that matches",
                    Trigger::Kind::host_line},
        TriggerInfo{"event", "name", "something happens to the machine; see events", Trigger::Kind::event},
        TriggerInfo{"field", "conditions",
                    "fields have values: {\"heaters.nozzle.true\": {\"min\": \"198C\"}}; tests as in a "
                    "profile's `when`, numbers with their unit. Looked at whenever something happens, and "
                    "each 100 ms",
                    Trigger::Kind::field},
        TriggerInfo{"page", "name", "the virtual screen has this page open", Trigger::Kind::page},
        TriggerInfo{"shows", "pattern", "a line of what the virtual screen shows matches",
                    Trigger::Kind::shows},
        TriggerInfo{"judged", "pattern",
                    "the virtual screen took a line otherwise than it was meant, and the sentence that says "
                    "so matches: "
                    "\"L7 P0 ...: cut: a name of ...\"; of all lines so far",
                    Trigger::Kind::judged},
    };
    return table;
}

namespace {

void compile_event(Compiler& c, const Json& value, const std::string& at, Trigger& out) {
    if (!value.is_string()) {
        c.findings().add(at, found(value) + "; expected the name of an event, such as \"motion.homed\"");
        return;
    }
    const auto& name = value.get_ref<const std::string&>();
    const auto event = machine::find_event(name);
    if (!event) {
        std::vector<std::string_view> names;
        for (const machine::EventId info : machine::events()) {
            names.push_back(info->name);
        }
        c.findings().add(at, fmt::format("unknown event \"{}\"", name),
                         std::string(behaviour::nearest(name, names)));
        return;
    }
    out.event = *event;
    out.words = fmt::format("the event {} ({})", name, (*event)->help);
}

void compile_page(Compiler& c, const Json& value, const std::string& at, Trigger& out) {
    if (!value.is_string() || !c.needs_screen(at, "page")) {
        if (!value.is_string()) {
            c.findings().add(at, found(value) + "; expected the path of a page");
        }
        return;
    }
    const auto& path = value.get_ref<const std::string&>();
    const screen::ResolvedPage page = screen::resolve_page(*c.shared().cast.screen, path);
    if (!page.page) {
        c.findings().add(at, page.sentence);
        return;
    }
    out.page = *page.page;
    out.words =
        fmt::format("the screen to open the page \"{}\"", c.shared().cast.screen->pages[*page.page].path);
}

/// What such a trigger waits for, without what it matches.
std::string_view what_of(Trigger::Kind kind) {
    switch (kind) {
        case Trigger::Kind::request:
            return "a request of the screen";
        case Trigger::Kind::line:
            return "a line of the board";
        case Trigger::Kind::host_request:
            return "a request of the host";
        case Trigger::Kind::host_line:
            return "a line of the board to the host";
        case Trigger::Kind::judged:
            return "the screen to take a line otherwise than it was meant, in words";
        default:
            return "the screen to show something";
    }
}

std::vector<std::string_view> trigger_names() {
    std::vector<std::string_view> names;
    for (const TriggerInfo& each : trigger_kinds()) {
        names.push_back(each.name);
    }
    return names;
}

}  // namespace

Trigger Compiler::trigger(const Json& node, const std::string& pointer, Trigger::Kind text) {
    Trigger out;
    const TriggerInfo* info = nullptr;
    const Json* value = &node;
    std::string at = pointer;
    if (node.is_object()) {
        ObjectReader reader(node, pointer, findings_);
        std::vector<std::string_view> given;
        for (const TriggerInfo& each : trigger_kinds()) {
            if (const Json* hit = reader.get(each.name)) {
                given.push_back(each.name);
                info = &each;
                value = hit;
                at = reader.pointer(each.name);
            }
        }
        reader.finish();
        if (given.size() != 1) {
            if (!given.empty() || node.empty()) {
                findings_.add(pointer,
                              given.empty()
                                  ? fmt::format("nothing to wait for; expected one of {}",
                                                fmt::join(trigger_names(), ", "))
                                  : fmt::format("\"{}\" and \"{}\" at once; expected one of them (put "
                                                "two waits side by side with \"together\")",
                                                given[0], given[1]));
            }
            return out;
        }
    } else if (node.is_string()) {
        info = &*std::find_if(trigger_kinds().begin(), trigger_kinds().end(),
                              [text](const TriggerInfo& each) { return each.kind == text; });
    } else {
        findings_.add(pointer,
                      found(node) + (text == Trigger::Kind::time
                                         ? "; expected a time such as \"500ms\", or what to wait for, such "
                                           "as {\"event\": \"motion.homed\"}"
                                         : "; expected a pattern for a line of the board, or what else to "
                                           "wait for, such as {\"event\": \"motion.homed\"}"));
        return out;
    }
    out.kind = info->kind;
    switch (out.kind) {
        case Trigger::Kind::time:
            out.time = time(*value, at, SimTime{0}, longest_limit);
            out.words = time_words(out.time) + " to pass";
            break;
        case Trigger::Kind::request:
        case Trigger::Kind::line:
        case Trigger::Kind::host_request:
        case Trigger::Kind::host_line:
        case Trigger::Kind::shows:
        case Trigger::Kind::judged:
            out.pattern = this->pattern(*value, at);
            out.words = fmt::format("{} that matches \"{}\"", what_of(out.kind), plain(*value));
            if (out.is_state()) {
                needs_screen(at, out.kind == Trigger::Kind::shows ? "shows" : "judged");
            }
            break;
        case Trigger::Kind::event:
            compile_event(*this, *value, at, out);
            break;
        case Trigger::Kind::field:
            conditions(*value, at, out);
            break;
        case Trigger::Kind::page:
            compile_page(*this, *value, at, out);
            break;
    }
    return out;
}

std::shared_ptr<const Pattern> Compiler::pattern(const Json& node, const std::string& pointer) {
    if (!node.is_string()) {
        findings_.add(pointer, found(node) + "; expected a regular expression, as a text");
        return nullptr;
    }
    try {
        auto out = std::make_shared<const Pattern>(node.get<std::string>());
        shared_.patterns += out->size();
        if (shared_.patterns > most_patterns) {
            findings_.add(pointer, "the scenario's patterns are too large, all together; write simpler ones");
        }
        return out;
    } catch (const PatternError& error) {
        findings_.add(pointer, error.what());
        return nullptr;
    }
}

bool Compiler::needs_screen(const std::string& pointer, std::string_view what) {
    if (shared_.cast.screen == nullptr) {
        findings_.add(pointer, fmt::format("\"{}\" needs a virtual screen in this process; say \"screen\": "
                                           "\"geeetech-a30t\" in the scenario, or run it with --screen, and "
                                           "without --port, --pty and --tcp",
                                           what));
        return false;
    }
    return true;
}

void Compiler::button(const std::string& path, const std::string& pointer) {
    if (!needs_screen(pointer, "press") || sampling_) {
        return;
    }
    const screen::Resolved resolved = screen::resolve(*shared_.cast.screen, {}, screen::no_page, path);
    // Which of several is meant depends on the page that is open then.
    if (!resolved.button && resolved.sentence.find("write more of its path") == std::string::npos) {
        findings_.add(pointer, resolved.sentence);
    }
}

// Conditions and actions.
// -----------------------------------------------------------------------------------------------

Json Compiler::condition_in_unit(const std::string& path, const Json& test, const std::string& pointer) {
    const behaviour::Field* field = behaviour::find_field(path);
    if (!is_number_field(field)) {
        return filled_ && field == nullptr ? in_unit(test, "", pointer) : test;
    }
    if (!test.is_object()) {
        return in_unit(test, field->unit, pointer);
    }
    Json out = test;
    for (const auto& [key, value] : test.items()) {
        if (key == "min" || key == "max" || key == "not") {
            out[key] = in_unit(value, field->unit, below(pointer, key));
        } else if (key == "in" && value.is_array()) {
            for (std::size_t i = 0; i < value.size(); ++i) {
                out[key][i] = in_unit(value[i], field->unit, fmt::format("{}/in/{}", pointer, i));
            }
        }
    }
    return out;
}

void Compiler::conditions(const Json& node, const std::string& pointer, Trigger& out) {
    Json converted = node;
    if (node.is_object()) {
        if (node.empty()) {
            findings_.add(pointer, "no condition; expected at least one field and its value");
        }
        std::vector<std::string> words;
        for (const auto& [path, test] : node.items()) {
            converted[path] = condition_in_unit(path, test, below(pointer, path));
            words.push_back(condition_words(path, test));
            out.fields.push_back(path);
        }
        out.words = fmt::format("{}", fmt::join(words, " and "));
    }
    behaviour::RuleCompiler compiler(findings_, shared_.names, shared_.frames,
                                     *shared_.cast.profile->machine);
    out.conditions = compiler.conditions(converted, pointer);
}

Json Compiler::call_in_units(const std::string& name, const Json& arguments, const std::string& pointer) {
    const behaviour::ActionInfo* info = behaviour::find_action(name);
    if (info == nullptr || !arguments.is_object()) {
        return arguments;
    }
    if (info->run == nullptr) {
        findings_.add(pointer, fmt::format("\"{}\" is no action of a scenario; the step \"set\" puts values "
                                           "into fields",
                                           name));
        return Json::object();
    }
    Json out = arguments;
    for (const behaviour::ArgInfo& arg : info->args) {
        const auto hit = arguments.find(std::string(arg.name));
        if (hit != arguments.end() && arg.type == behaviour::ArgType::number) {
            out[std::string(arg.name)] = in_unit(*hit, arg.unit, below(pointer, arg.name));
        }
    }
    return out;
}

Json Compiler::arguments_in_units(const Json& node, const std::string& pointer) {
    Json out = node;
    if (node.is_array()) {
        for (std::size_t i = 0; i < node.size(); ++i) {
            out[i] =
                node[i].is_array() ? node[i] : arguments_in_units(node[i], fmt::format("{}/{}", pointer, i));
        }
    } else if (node.is_object()) {
        for (const auto& [name, arguments] : node.items()) {
            out[name] = call_in_units(name, arguments, below(pointer, name));
        }
    } else if (node.is_string()) {
        if (const auto* info = behaviour::find_world_action(node.get_ref<const std::string&>())) {
            return std::string(info->name);  // phrases of recordings: "filament in"
        }
    }
    return out;
}

std::vector<behaviour::ActionCall> Compiler::actions(const Json& node, const std::string& pointer) {
    const std::size_t before = findings_.problems.size();
    const Json converted = arguments_in_units(node, pointer);
    if (findings_.problems.size() != before) {
        return {};
    }
    behaviour::RuleCompiler compiler(findings_, shared_.names, shared_.frames,
                                     *shared_.cast.profile->machine);
    return compiler.actions(converted, pointer);
}

std::vector<behaviour::ActionCall> Compiler::assignments(const Json& node, const std::string& pointer) {
    std::vector<behaviour::ActionCall> out;
    if (!node.is_object() || node.empty()) {
        findings_.add(pointer, found(node) +
                                   "; expected fields and their values, such as "
                                   "{\"heaters.nozzle.target\": \"200C\"}");
        return out;
    }
    for (const auto& [path, value] : node.items()) {
        const std::string at = below(pointer, path);
        const behaviour::Field* field = behaviour::find_field(path);
        const bool variable = path.starts_with(variable_prefix) &&
                              shared_.names.variables.contains(path.substr(variable_prefix.size()));
        if (field == nullptr && !variable) {
            findings_.add(at, fmt::format("unknown field \"{}\"", path),
                          std::string(behaviour::nearest_field(path)));
            continue;
        }
        Json inside = value;
        if (is_number_field(field)) {
            const std::size_t before = findings_.problems.size();
            inside = in_unit(value, field->unit, at);
            if (findings_.problems.size() != before) continue;
        } else if (filled_ && (field == nullptr || field->type != FieldType::text)) {
            inside = in_unit(value, "", at);
        }
        try {
            out.push_back(
                control::assignment(shared_.probe, control::find_place(shared_.probe, path), inside));
        } catch (const control::ControlError& error) {
            if (!sampling_ || error.code != control::ErrorCode::out_of_range) {
                std::string sentence = error.what();
                if (sentence.ends_with('.')) sentence.pop_back();
                findings_.add(at, sentence, error.nearest);
            }
        }
    }
    return out;
}

std::string Compiler::line(const Json& node, const std::string& pointer, std::size_t most, bool whole_line) {
    if (!node.is_string()) {
        findings_.add(pointer, found(node) + "; expected a text");
        return {};
    }
    const auto bytes = behaviour::to_wire(node.get_ref<const std::string&>());
    if (!bytes) {
        findings_.add(pointer, "the line carries bytes; expected characters up to U+00FF only");
    } else if (bytes->empty() || bytes->size() > most) {
        findings_.add(pointer, fmt::format("a text of {} bytes; expected 1 to {}", bytes->size(), most));
    } else if (whole_line && protocol::plain_run(*bytes) != bytes->size()) {
        findings_.add(pointer, "a line holds no line end and no NUL; \"raw\" sends any bytes");
    } else {
        return *bytes;
    }
    return {};
}

}  // namespace fauxboard::script
