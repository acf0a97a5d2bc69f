// Steps that take their time: until something has come, has not come, or should have come by now.

#include <fmt/format.h>

#include "emulator/script/compiler.h"

namespace fauxboard::script::rows {
namespace {

using behaviour::found;
using behaviour::ObjectReader;
using Kind = Trigger::Kind;

void compile_wait(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    out.trigger = c.trigger(value, reader.pointer("wait"), Kind::time);
    out.words = "wait for " + out.trigger.words;
    if (out.trigger.kind != Kind::time) {
        c.limits(reader, c.shared().limits.wait, out);
        return;
    }
    c.limits(reader, out.trigger.time, out);
    if (reader.has("within")) {
        c.findings().add(reader.pointer("within"), "a wait for a time has no other limit; leave it out");
    }
    out.within = out.trigger.time;
}

void compile_expect(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("expect");
    const std::size_t before = c.findings().problems.size();
    out.trigger = c.trigger(value, at, Kind::line);
    out.words = "expect " + out.trigger.words;
    c.limits(reader, c.shared().limits.expect, out);
    if (out.trigger.kind == Kind::time && c.findings().problems.size() == before) {
        c.findings().add(at, "nothing can be expected of the time; \"wait\" lets it pass");
    }
}

void compile_expect_next(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string place = reader.pointer("expect_next");
    out.next = true;
    out.trigger = c.trigger(value, place, Kind::line);
    const Kind kind = out.trigger.kind;
    if (kind != Kind::line && kind != Kind::host_line) {
        c.findings().add(place,
                         "only lines of the board have a next one; expected a pattern, or "
                         "{\"host_line\": pattern}");
        return;
    }
    const Json& pattern = value.is_object() ? value.begin().value() : value;
    out.trigger.words = fmt::format("the next line of the board{} to match {}",
                                    kind == Kind::line ? "" : " to the host", pattern.dump());
    out.words = "expect " + out.trigger.words;
    c.limits(reader, c.shared().limits.expect, out);
    if (const Json* list = reader.get("ignoring")) {
        const std::string at = reader.pointer("ignoring");
        if (!list->is_array()) {
            c.findings().add(at, found(*list) + "; expected a list of patterns");
            return;
        }
        for (std::size_t i = 0; i < list->size(); ++i) {
            out.ignoring.push_back(c.pattern((*list)[i], fmt::format("{}/{}", at, i)));
        }
    }
}

void compile_check(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("check");
    if (value.is_object() && (value.contains("page") || value.contains("shows"))) {
        out.trigger = c.trigger(value, at, Kind::field);
    } else {
        out.trigger.kind = Kind::field;
        c.conditions(value, at, out.trigger);
    }
    out.words = "check " + out.trigger.words;
    out.now = true;
}

constexpr std::string_view real_help =
    "the same in real time; left out: the virtual limit at the speed of the run, and five minutes more";
constexpr std::array wait_keys{
    KeyInfo{"within", "time", "how long at most, of virtual time; left out: the scenario's limits.wait"},
    KeyInfo{"real", "time", real_help}};
constexpr std::array expect_keys{
    KeyInfo{"within", "time", "how long at most, of virtual time; left out: the scenario's limits.expect"},
    KeyInfo{"real", "time", real_help}};
constexpr std::array next_keys{
    expect_keys[0], expect_keys[1],
    KeyInfo{"ignoring", "list of patterns", "lines that may come before: what the board says by itself"}};

constexpr std::array watch_table{
    StepKind{"wait", "time or trigger",
             "goes on when the time has passed or the thing has come; a wait that is in vain fails "
             "the scenario (as timed out)",
             R"j({"wait": {"request": "^M104 S(?P<target>[0-9]+)"}, "within": "5min"})j", wait_keys,
             Role::watch, compile_wait},
    StepKind{"expect", "pattern or trigger",
             "the same for what has to come of the steps before: a line of the board that "
             "matches, or another trigger",
             R"j({"expect": "^L2 .*/200\\.0", "within": "500ms"})j", expect_keys, Role::watch,
             compile_expect},
    StepKind{"expect_next", "pattern, or {\"host_line\": pattern}",
             "the very next line of the board has to match: to the screen, or to the host",
             R"j({"expect_next": "^L23 ", "ignoring": ["^L[123] "]})j", next_keys, Role::watch,
             compile_expect_next},
    StepKind{"check",
             "conditions, or {\"page\": name}, or {\"shows\": pattern}",
             "is so now",
             R"j({"check": {"job.status": 0}})j",
             {},
             Role::watch,
             compile_check},
};

}  // namespace

std::span<const StepKind> watch_steps() {
    return watch_table;
}

}  // namespace fauxboard::script::rows
