// Steps that hold other steps.

#include <fmt/format.h>

#include "emulator/script/compiler.h"

namespace fauxboard::script::rows {
namespace {

using behaviour::found;
using behaviour::ObjectReader;

constexpr double most_rounds = 1e9;

void compile_inner(Compiler& c, ObjectReader& reader, Step& out, std::string name) {
    reader.required("steps");
    if (const Json* steps = reader.get("steps")) {
        out.blocks.push_back({std::move(name), c.steps(*steps, reader.pointer("steps"))});
    }
}

// repeat
// -----------------------------------------------------------------------------------------------

void compile_repeat(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("repeat");
    out.rounds.reset();
    if (value.is_number() && value.get<double>() >= 1 && value.get<double>() <= most_rounds &&
        value.get<double>() == static_cast<double>(value.get<std::uint64_t>())) {
        out.rounds = value.get<std::uint64_t>();
    } else if (value != Json("forever")) {
        c.findings().add(at,
                         fmt::format("{}; expected how often, a whole number from 1 to {}, or \"forever\"",
                                     found(value), static_cast<std::uint64_t>(most_rounds)));
    }
    out.words = out.rounds ? fmt::format("repeat {} times", *out.rounds) : "repeat without end";
    const std::size_t before = c.findings().problems.size();
    compile_inner(c, reader, out, {});
    if (const Json* until = reader.get("until")) {
        out.until = true;
        out.trigger.kind = Trigger::Kind::field;
        c.conditions(*until, reader.pointer("until"), out.trigger);
        if (!out.rounds) {
            c.findings().add(at, "\"until\" may never be; expected how many rounds at most");
        }
    }
    if (!out.rounds && c.findings().problems.size() == before && !takes_time(out.blocks[0].steps)) {
        c.findings().add(reader.pointer("steps"),
                         "these steps go round without end and take no time; put a \"wait\" among them");
    }
}

// together
// -----------------------------------------------------------------------------------------------

void compile_together(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("together");
    out.words = "together";
    if (!value.is_array() || value.size() < 2) {
        c.findings().add(at,
                         (value.is_array() ? "fewer than two branches" : found(value)) +
                             "; expected a list of branches, such as {\"name\": \"heat\", \"steps\": [...]}");
        return;
    }
    c.shared().branches += value.size();
    if (c.shared().branches > Compiler::most_branches) {
        c.findings().add(at, fmt::format("more than {} branches in all", Compiler::most_branches));
        return;
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < value.size(); ++i) {
        ObjectReader inner(value[i], fmt::format("{}/{}", at, i), c.findings());
        std::string name = fmt::format("branch {}", i + 1);
        inner.text("name", name, 64);
        names.push_back(name);
        compile_inner(c, inner, out, name);
        inner.finish();
    }
    out.words = fmt::format("together: {}", fmt::join(names, ", "));
    static constexpr std::array<std::string_view, 2> ends{"all", "first"};
    std::size_t until = 0;
    reader.choice("until", ends, until);
    out.until_first = until == 1;
}

// never
// -----------------------------------------------------------------------------------------------

void compile_never(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("never");
    const std::size_t before = c.findings().problems.size();
    out.trigger = c.trigger(value, at, Trigger::Kind::line);
    out.words = "never " + out.trigger.words;
    out.guards = true;
    if (out.trigger.kind == Trigger::Kind::time && c.findings().problems.size() == before) {
        c.findings().add(at, "time passes always; expected something that must not happen");
    }
    const Json* time = reader.get("for");
    if ((time != nullptr) == reader.has("steps")) {
        c.findings().add(reader.pointer("never"),
                         "expected either \"for\", a time, or \"steps\", during which it "
                         "must not happen");
        return;
    }
    if (time != nullptr) {
        // The same as a wait under the guard.
        Step wait;
        wait.kind = find_step_kind("wait");
        wait.where = out.where;
        wait.words = out.words;
        wait.trigger.time = wait.within =
            c.time(*time, reader.pointer("for"), SimTime{1}, Compiler::longest_limit);
        wait.trigger.words = time_words(wait.within) + " to pass";
        out.blocks.push_back({{}, {}});
        out.blocks[0].steps.push_back(std::move(wait));
    } else {
        compile_inner(c, reader, out, {});
    }
}

// include
// -----------------------------------------------------------------------------------------------

void compile_include(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("include");
    static const Json none = Json::object();
    const Json* with = reader.get("with");
    if (!value.is_string()) {
        c.findings().add(at, found(value) + "; expected the name of a scenario, or a path");
    } else if (with != nullptr && !with->is_object()) {
        c.findings().add(reader.pointer("with"), found(*with) + "; expected an object of parameters");
    } else {
        out.words = "include " + value.get<std::string>();
        out.blocks.push_back(c.shared().include(value.get<std::string>(), out.where.file,
                                                with != nullptr ? *with : none, c.findings(), at));
    }
}

constexpr std::array repeat_keys{
    KeyInfo{"steps", "list of steps", "what is repeated"},
    KeyInfo{"until", "conditions",
            "looked at after each round; when they still do not hold after the last, the scenario "
            "fails"}};
constexpr std::array together_keys{
    KeyInfo{"until", "\"all\" or \"first\"",
            "goes on when all branches are through (default), or with the first of "
            "them; the others are given up then"}};
constexpr std::array never_keys{KeyInfo{"for", "time", "how long"},
                                KeyInfo{"steps", "list of steps", "or while these are carried out"}};
constexpr std::array include_keys{KeyInfo{"with", "object", "values of its parameters"}};

constexpr std::array block_table{
    StepKind{"never", "pattern or trigger", "must not come, for a time or while steps are carried out",
             R"j({"never": "^L18 P26", "for": "10s"})j", never_keys, Role::block, compile_never},
    StepKind{"repeat", "number or \"forever\"", "steps several times over",
             R"j({"repeat": 3, "steps": [{"press": "Control/Move/X+ (30mm)"}, {"wait": "2s"}]})j",
             repeat_keys, Role::block, compile_repeat},
    StepKind{"together", "list of {\"name\", \"steps\"}",
             "branches side by side; the first failure is that of all",
             R"j({"together": [{"name": "heat", "steps": [...]}, {"name": "move", "steps": [...]}]})j",
             together_keys, Role::block, compile_together},
    StepKind{"include", "name or path", "the steps of another scenario; beside this file, or a shipped one",
             R"j({"include": "heat-up", "with": {"target": "200C"}})j", include_keys, Role::block,
             compile_include},
};

}  // namespace

std::span<const StepKind> block_steps() {
    return block_table;
}

}  // namespace fauxboard::script::rows
