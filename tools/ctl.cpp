// `fauxboard ctl`: reaches into a running board by its control channel.

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <memory>
#include <optional>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/parse_json.h"
#include "emulator/control/base64.h"
#include "emulator/host/time_text.h"
#include "emulator/link/host_error.h"
#include "emulator/link/link.h"
#include "emulator/link/output_file.h"
#include "tools/control_client.h"
#include "tools/ctl_text.h"
#include "tools/file_roles.h"
#include "tools/option_values.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

/// What was asked, in the form of the channel; filled by the subcommand's callback.
struct Ctl {
    std::string path;
    bool json = false;
    int timeout_ms = 10'000;

    Json request = Json::object();
    std::vector<Json> subscriptions;  ///< watch: these instead of one request
    std::uint64_t most_events = 0;    ///< watch: 0 is no bound
    bool raw = false;

    std::string picture;  ///< screenshot: where to
    std::vector<std::string> words;
    std::string action;
    std::string arguments;
    std::string id;
    std::string spec;
    std::string every;
    bool traffic = false;
    bool notices = false;
    bool link = false;
};

// The talk.
// -----------------------------------------------------------------------------------------------

ExitCode complain_of(const Json& error) {
    const std::string nearest = error.value("nearest", "");
    return complain("ctl", ExitCode::failed,
                    error.value("message", "no reason given") +
                        (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?"));
}

ExitCode silence(const Ctl& ctl) {
    return complain("ctl", ExitCode::timed_out,
                    fmt::format("No answer from {} within {} ms; is it a board's control channel? --timeout "
                                "waits longer.",
                                ctl.path, ctl.timeout_ms));
}

ExitCode gone(const Ctl& ctl) {
    return complain("ctl", ExitCode::gone, "The board at " + ctl.path + " has ended, without an answer.");
}

/// The next line that is an answer (`events` false) or an event.
ExitCode next(const Ctl& ctl, ControlClient& client, bool events, Json& out, std::string& line) {
    for (;;) {
        switch (client.receive(line)) {
            case ControlClient::Got::silence:
                return silence(ctl);
            case ControlClient::Got::end:
                return ExitCode::gone;
            case ControlClient::Got::line:
                break;
        }
        out = behaviour::parse_json(line);
        if (!out.is_object() || out.contains("event") == out.contains("ok")) {
            return complain("ctl", ExitCode::failed, ctl.path + " is no control channel of a board.");
        }
        if (out.contains("event") == events) {
            return ExitCode::ok;
        }
    }
}

ExitCode ask(const Ctl& ctl, ControlClient& client, const Json& request, Json& answer, std::string& line) {
    client.ask(request);  // one that fails shows as an end
    const ExitCode code = next(ctl, client, false, answer, line);
    if (code != ExitCode::ok) {
        return code == ExitCode::gone ? gone(ctl) : code;
    }
    return answer.value("ok", false) ? ExitCode::ok : ExitCode::failed;
}

ExitCode keep_picture(const Ctl& ctl, const Json& answer) {
    const auto bytes = control::from_base64(answer.value("png", ""));
    try {
        link::write_output(ctl.picture, "The picture " + ctl.picture, bytes.value_or(""));
    } catch (const link::HostError& error) {
        return complain("ctl", ExitCode::failed, error.what());
    }
    return bytes ? ExitCode::ok : complain("ctl", ExitCode::failed, "The board sent no picture.");
}

ExitCode one_request(const Ctl& ctl, ControlClient& client) {
    Json answer;
    std::string line;
    const ExitCode code = ask(ctl, client, ctl.request, answer, line);
    if (code == ExitCode::ok && !ctl.picture.empty()) {
        return keep_picture(ctl, answer);
    }
    if (code == ExitCode::ok && ctl.json && ctl.request.value("op", "") == "page") {
        for (const char* around : {"id", "ok", "t", "notices"}) {
            answer.erase(around);
        }
        print(answer.dump() + "\n");
    } else if (answer.is_object() && ctl.json) {
        print(line + "\n");
    } else if (code == ExitCode::ok) {
        print(answer_text(answer));
        for (const Json& notice : answer.value("notices", Json::array())) {
            complain("ctl", ExitCode::ok, notice.value("text", ""));
        }
    }
    return code == ExitCode::failed && answer.contains("error") ? complain_of(answer["error"]) : code;
}

ExitCode watch(const Ctl& ctl, ControlClient& client) {
    Json json;
    std::string line;
    for (const Json& subscription : ctl.subscriptions) {
        client.ask(subscription);
    }
    std::size_t answers = 0;
    for (std::uint64_t events = 0; ctl.most_events == 0 || events < ctl.most_events;) {
        const auto got = client.receive(line);
        if (got != ControlClient::Got::line) {
            return answers < ctl.subscriptions.size() ? gone(ctl) : ExitCode::ok;
        }
        json = behaviour::parse_json(line);
        if (json.is_object() && json.contains("event")) {
            ++events;
            print(ctl.json ? line + "\n" : event_text(json));
        } else if (json.is_object() && json.value("ok", false)) {
            ++answers;
        } else {
            return complain_of(json.is_object() ? json.value("error", Json::object()) : Json::object());
        }
    }
    return ExitCode::ok;
}

ExitCode ctl_main(const Ctl& ctl) {
    try {
        FileRoles roles;
        roles.talks("the control channel", ctl.path);
        roles.writes("the picture", ctl.picture);
        // What is watched may be silent for hours, and time that jumps takes as long as it takes.
        const bool patient = ctl.raw || !ctl.subscriptions.empty() ||
                             ctl.request.value("op", "") == "advance" ||
                             ctl.request.value("op", "") == "touch";
        ControlClient client(ctl.path, patient ? -1 : ctl.timeout_ms);
        if (ctl.raw) {
            client.copy(STDIN_FILENO, STDOUT_FILENO);
            return ExitCode::ok;
        }
        return ctl.subscriptions.empty() ? one_request(ctl, client) : watch(ctl, client);
    } catch (const link::LinkError& error) {
        return complain("ctl", ExitCode::no_port, error.what());
    } catch (const link::HostError& error) {
        return complain("ctl", ExitCode::bad_input, error.what());
    }
}

// The command line.
// -----------------------------------------------------------------------------------------------

/// "60", "true", "\"text\"" are what they are in JSON; all else, and whatever is for a text, is a text.
Json value_of(const std::string& path, const std::string& text) {
    const behaviour::Field* field = behaviour::find_field(path);
    const Json parsed = behaviour::parse_json(text);
    const bool wants_text = field != nullptr && field->type == behaviour::FieldType::text;
    return !wants_text && (parsed.is_number() || parsed.is_boolean()) ? parsed : Json(text);
}

/// "10" is a number of seconds, "10min" a text.
Json time_of(const std::string& text) {
    const Json parsed = Json::parse(text, nullptr, false);
    return parsed.is_number() ? parsed : Json(text);
}

Json assignments(const std::vector<std::string>& words) {
    Json out = Json::object();
    for (const std::string& word : words) {
        const std::size_t sign = word.find('=');
        if (sign == std::string::npos || sign == 0) {
            throw CLI::ValidationError("set", "'" + word + "' is no assignment; expected FIELD=VALUE");
        }
        out[word.substr(0, sign)] = value_of(word.substr(0, sign), word.substr(sign + 1));
    }
    return out;
}

Json action_of(const Ctl& ctl) {
    if (ctl.arguments.empty()) {
        return ctl.action;
    }
    Json arguments = behaviour::parse_json(ctl.arguments);
    if (!arguments.is_object()) {
        throw CLI::ValidationError("do", "'" + ctl.arguments +
                                             "' is no JSON object; expected arguments such as "
                                             "'{\"heater\": \"nozzle\", \"c\": 200}'");
    }
    return Json{{ctl.action, std::move(arguments)}};
}

std::optional<int> whole_number(const std::string& text) {
    int out = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), out);
    return read.ec == std::errc{} && read.ptr == text.data() + text.size() ? std::optional(out)
                                                                           : std::nullopt;
}

/// X Y [MS], or NAME [MS]; a name may hold blanks, in one word or in several.
Json touch_of(std::vector<std::string> words) {
    Json out{{"op", "touch"}};
    const auto duration = [&] {
        if (const auto ms = words.size() > 1 ? whole_number(words.back()) : std::nullopt) {
            out["for"] = *ms / 1000.0;
            words.pop_back();
        }
    };
    const bool pixel =
        words.size() > 1 && words.size() < 4 && whole_number(words[0]) && whole_number(words[1]);
    if (pixel) {
        out["x"] = *whole_number(words[0]);
        out["y"] = *whole_number(words[1]);
        if (words.size() == 3) duration();
    } else {
        duration();
        out["control"] = fmt::format("{}", fmt::join(words, " "));
    }
    return out;
}

/// A fault in JSON or as compact text.
Json spec_of(const std::string& text) {
    const Json parsed = behaviour::parse_json(text);
    return parsed.is_object() ? parsed : Json(text);
}

/// A number of a line's fault, or a word of the printer's.
Json id_of(const std::string& text) {
    const Json parsed = behaviour::parse_json(text);
    if (!parsed.is_number_unsigned() && !parsed.is_discarded()) {
        throw CLI::ValidationError("fault", "'" + text +
                                                "' is no fault's id; expected a number or a word of `fault "
                                                "list`, such as 1 or p1, or a fault's name");
    }
    return parsed.is_discarded() ? Json(text) : parsed;
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

CLI::App* add(CLI::App& to, const char* name, const char* help, std::function<void()> fill) {
    CLI::App* command = to.add_subcommand(name, help);
    command->fallthrough();
    command->callback(std::move(fill));
    return command;
}

void add_values(CLI::App& to, Ctl& ctl) {
    add(to, "get", "Values of fields; all when none is named", [&ctl] {
        ctl.request["op"] = "get";
        if (!ctl.words.empty()) {
            ctl.request["fields"] = ctl.words;
        }
    })->add_option("FIELD", ctl.words, "Fields, or groups of them: heaters.nozzle");
    add(to, "set", "Puts values into fields, all of them or none",
        [&ctl] {
            ctl.request = Json{{"op", "set"}, {"fields", assignments(ctl.words)}};
        })
        ->add_option("FIELD=VALUE", ctl.words, "heaters.bed.target=60")
        ->required();
}

void add_doing(CLI::App& to, Ctl& ctl) {
    CLI::App* action = add(to, "do", "Carries out an action", [&ctl] {
        ctl.request = Json{{"op", "do"}, {"do", action_of(ctl)}};
    });
    action->add_option("ACTION", ctl.action, "heater.target; `fauxboard describe actions` lists them")
        ->required();
    action->add_option("JSON", ctl.arguments, R"(Its arguments: '{"heater": "nozzle", "c": 200}')");
    add(to, "world", "Does something to the machine by its phrase",
        [&ctl] {
            ctl.request = Json{{"op", "world"}, {"do", joined(ctl.words)}};
        })
        ->add_option("PHRASE", ctl.words, "filament in, card out, board reset, ...")
        ->required();
    CLI::App* send = add(to, "send", "Sends a frame of the profile to the screen", [&ctl] {
        ctl.request["op"] = "send";
        if (!ctl.words.empty()) {
            ctl.request["frame"] = joined(ctl.words);
        }
    });
    send->add_option("FRAME", ctl.words, "By its name in the profile");
    for (const char* kind : {"line", "raw"}) {
        send->add_option_function<std::string>(
            fmt::format("--{}", kind), [&ctl, kind](const std::string& text) { ctl.request[kind] = text; },
            kind == std::string_view("line") ? "This line instead, put into a frame" : "These bytes instead");
    }
    add(to, "advance", "Virtual time jumps forward; returns when it has got there",
        [&ctl] {
            ctl.request = Json{{"op", "advance"}, {"by", time_of(joined(ctl.words))}};
        })
        ->add_option("TIME", ctl.words, "500ms, 10s, 5min, 24h, 30d, or seconds")
        ->required()
        ->expected(1);
}

void add_faults(CLI::App& to, Ctl& ctl) {
    CLI::App* fault = to.add_subcommand("fault", "Faults of the tested line and of the printer");
    fault->require_subcommand(1)->fallthrough();
    CLI::App* list = add(*fault, "list", "What is in force, and what it has done",
                         [&ctl] { ctl.request["op"] = "faults.list"; });
    CLI::App* clear = add(*fault, "clear", "Takes all away", [&ctl] { ctl.request["op"] = "faults.clear"; });
    CLI::App* added = add(*fault, "add", "Adds one; prints its id", [&ctl] {
        ctl.request = Json{{"op", "faults.add"}, {"spec", spec_of(ctl.spec)}};
    });
    CLI::App* changed = add(*fault, "change", "It begins anew as another", [&ctl] {
        ctl.request = Json{{"op", "faults.change"}, {"fault", id_of(ctl.id)}, {"spec", spec_of(ctl.spec)}};
    });
    CLI::App* removed = add(*fault, "remove", "Takes one away", [&ctl] {
        ctl.request = Json{{"op", "faults.remove"}, {"fault", id_of(ctl.id)}};
    });
    for (CLI::App* command : {changed, removed}) {
        command->add_option("ID", ctl.id, "Of `fault list`")->required();
    }
    for (CLI::App* command : {added, changed}) {
        command
            ->add_option("SPEC", ctl.spec,
                         "garble:to_screen,every=5 or jam:at=60s, or JSON; see `describe faults`")
            ->required();
    }
    static_cast<void>(list);
    static_cast<void>(clear);
}

/// What a finger does, and what the eye sees.
void add_display(CLI::App& to, Ctl& ctl) {
    CLI::App* touch = add(to, "touch", "Puts a finger on the board's screen; returns when it is off again",
                          [&ctl] { ctl.request = touch_of(ctl.words); });
    touch
        ->add_option("X Y [MS]|NAME [MS]", ctl.words,
                     "A pixel, or a control's name as `page` tells it; for how long (120 ms)")
        ->required();
    CLI::App* page = add(to, "page", "What the board's screen shows", [&ctl] { ctl.request["op"] = "page"; });
    page->add_flag("--json", ctl.json, "As one JSON object");
    add(to, "screenshot", "Writes what the board's screen shows to a picture",
        [&ctl] { ctl.request["op"] = "screenshot"; })
        ->add_option("FILE", ctl.picture, "FILE.png")
        ->type_name("FILE.png")
        ->required();
}

void add_watching(CLI::App& to, Ctl& ctl) {
    CLI::App* watch = add(to, "watch", "Shows what happens, until it ends or you do", [&ctl] {
        if (!ctl.words.empty() || !(ctl.traffic || ctl.notices || ctl.link)) {
            Json state{{"op", "subscribe"}, {"topic", "state"}};
            if (!ctl.words.empty()) {
                state["fields"] = ctl.words;
            }
            if (!ctl.every.empty()) {
                state["every"] = time_of(ctl.every);
            }
            ctl.subscriptions.push_back(std::move(state));
        }
        for (const auto& [wanted, topic] : {std::pair{ctl.traffic, "traffic"},
                                            std::pair{ctl.notices, "notices"}, std::pair{ctl.link, "link"}}) {
            if (wanted) {
                ctl.subscriptions.push_back({{"op", "subscribe"}, {"topic", topic}});
            }
        }
    });
    watch->add_option("FIELD", ctl.words, "Fields or groups; all when nothing else is asked for");
    watch->add_option("--every", ctl.every, "How often to look, in virtual time: 500ms")->type_name("TIME");
    watch->add_flag("--traffic", ctl.traffic, "Lines of the wire");
    watch->add_flag("--notices", ctl.notices, "What `run` logs for people");
    watch->add_flag("--link", ctl.link, "Who comes and goes at the tested line");
    watch->add_option("--count", ctl.most_events, "End after so many events")->type_name("N");
}

void add_rest(CLI::App& to, Ctl& ctl) {
    for (const auto& [name, help] : {std::pair{"status", "Profile, virtual time, link, counters"},
                                     std::pair{"quit", "Ends the board's run"}}) {
        add(to, name, help, [&ctl, op = name] { ctl.request["op"] = op; });
    }
    add(to, "raw", "Passes JSON lines of stdin on as they are, and prints what comes back",
        [&ctl] { ctl.raw = true; });
}

}  // namespace

void add_ctl(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("ctl", "Reach into a board that runs with --control");
    const auto ctl = std::make_shared<Ctl>();
    command->require_subcommand(1);
    command->add_option("PATH", ctl->path, "The socket, as given to `run --control`")
        ->type_name("PATH")
        ->required();
    command->add_flag("--json", ctl->json, "Print answers and events as they are: JSON lines");
    command->add_option("--timeout", ctl->timeout_ms, "How long to wait for an answer, ms")
        ->type_name("MS")
        ->check(whole_between(1, 86'400'000))
        ->capture_default_str();
    add_values(*command, *ctl);
    add_doing(*command, *ctl);
    add_faults(*command, *ctl);
    add_display(*command, *ctl);
    add_watching(*command, *ctl);
    add_rest(*command, *ctl);
    command->footer(
        "Exit codes: 0 done; 1 the board says no, and why; 2 the command line is wrong; 4 nobody listens\n"
        "there; 5 no answer in time; 6 the board ended before it answered.");
    command->final_callback([ctl, &exit] { exit = ctl_main(*ctl); });
}

}  // namespace fauxboard::tools
