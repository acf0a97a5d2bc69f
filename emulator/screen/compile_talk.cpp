// How a screen speaks that sends one command at a time.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Json;
using behaviour::ObjectReader;

TalkRules::Poll Compiler::poll(const Json& node, const std::string& pointer) {
    TalkRules::Poll out;
    ObjectReader reader(node, pointer, findings);
    reader.required("send");
    reader.required("every_ms");
    time(reader, "every_ms", out.every, 10, 3'600'000);
    out.when = conditions(reader, "when", {});
    out.assume = assigns(reader, "assume", {});
    out.send = sends(reader, "send", {});
    reader.finish();
    return out;
}

void Compiler::talk(const Json& node) {
    ObjectReader reader(node, "/talk", findings);
    TalkRules& out = profile.talk;
    reader.boolean("queued", out.queued);
    unsigned most = static_cast<unsigned>(out.most_waiting);
    reader.unsigned_integer("most_waiting", most, 1, 1024);
    out.most_waiting = most;
    time(reader, "timeout_ms", out.timeout, 10, 3'600'000);
    reader.text("timed_out", out.timed_out);
    out.at_once = texts(reader, "at_once");
    if (const Json* polls = reader.get("polls")) {
        for_each_item(*polls, reader.pointer("polls"), [&](const Json& item, const std::string& pointer) {
            out.polls.push_back(poll(item, pointer));
        });
    }
    if (const Json* waits = reader.get("waits")) {
        ObjectReader commands(*waits, reader.pointer("waits"), findings);
        if (waits->is_object()) {
            for (const auto& [command, why] : waits->items()) {
                TalkRules::Wait wait{command, ""};
                commands.text(command, wait.why);
                out.waits.push_back(std::move(wait));
            }
        }
    }
    reader.finish();
    for (const FrameRule& rule : profile.words) {
        for (const FrameCase& one : rule.cases) {
            for (const std::string& command : one.answers) {
                if (std::none_of(out.waits.begin(), out.waits.end(),
                                 [&](const TalkRules::Wait& wait) { return wait.command == command; })) {
                    findings.add(
                        "/frames/" + rule.name + "/answers",
                        fmt::format("the screen does not wait for an answer to \"{}\"; see /talk/waits",
                                    command));
                }
            }
        }
    }
}

}  // namespace fauxboard::screen
