// Steps that are done at once.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/fault/printer_fault.h"
#include "emulator/script/compiler.h"
#include "protocol/framing.h"

namespace fauxboard::script::rows {
namespace {

using behaviour::found;
using behaviour::ObjectReader;

constexpr std::size_t most_raw_bytes = 2048;
constexpr std::size_t most_host_bytes = protocol::max_line_bytes - 24;  ///< room for number and checksum

/// A line as the main line of the board has them.
std::string framed(Compiler& c, const std::string& line) {
    const bool frames = c.shared().cast.profile->line.framing == behaviour::Framing::frames;
    return frames ? protocol::frame(line) : line + "\r\n";
}

// do, set
// -----------------------------------------------------------------------------------------------

std::string run_calls(Acting& acting, const Step& step) {
    std::string refusal;
    acting.stage.visit([&](board::Board& board, SimTime now) {
        for (const behaviour::ActionCall& call : step.calls) {
            refusal = board.act(now, call);
            if (!refusal.empty()) {
                refusal = fmt::format("{} was not done: {}", call.info->name, refusal);
                return;
            }
        }
    });
    return refusal;
}

void compile_do(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    out.calls = c.actions(value, reader.pointer("do"));
    out.words = "do " + (value.is_string() ? value.get<std::string>() : value.dump());
}

void compile_set(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    out.calls = c.assignments(value, reader.pointer("set"));
    out.words = "set " + value.dump();
}

// send, request
// -----------------------------------------------------------------------------------------------

void compile_send(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("send");
    out.words = "send " + value.dump();
    behaviour::RuleCompiler compiler(c.findings(), c.shared().names, c.shared().frames,
                                     *c.shared().cast.profile->machine);
    const auto frame = [&](const Json& name, const std::string& where) {
        if (const auto index = compiler.frame(name, where)) {
            out.frame = behaviour::Send{};
            out.frame->frame = *index;
        }
    };
    if (!value.is_object()) {
        frame(value, at);
        return;
    }
    ObjectReader inner(value, at, c.findings());
    const Json* by_name = inner.get("frame");
    const Json* line = inner.get("line");
    const Json* raw = inner.get("raw");
    inner.finish();
    if ((by_name != nullptr ? 1 : 0) + (line != nullptr ? 1 : 0) + (raw != nullptr ? 1 : 0) != 1) {
        c.findings().add(at,
                         "expected one of \"frame\" (a frame of the profile), \"line\" (a line to put "
                         "into a frame) and \"raw\" (bytes as they are)");
    } else if (by_name != nullptr) {
        frame(*by_name, inner.pointer("frame"));
    } else if (raw != nullptr) {
        out.bytes = c.line(*raw, inner.pointer("raw"), most_raw_bytes, false);
    } else {
        out.bytes = framed(c, c.line(*line, inner.pointer("line"), protocol::max_line_bytes, true));
    }
}

std::string run_send(Acting& acting, const Step& step) {
    acting.stage.visit([&](board::Board& board, SimTime now) {
        if (step.frame) {
            board.send_frame(now, *step.frame);
        } else {
            board.send_raw(now, step.bytes);
        }
    });
    return {};
}

void compile_request(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    out.bytes = framed(c, c.line(value, reader.pointer("request"), protocol::max_line_bytes, true));
    out.words = "request " + value.dump();
}

std::string run_request(Acting& acting, const Step& step) {
    acting.stage.visit([&](board::Board& board, SimTime now) { board.receive(now, step.bytes); });
    return {};
}

void compile_host(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    out.bytes = c.line(value, reader.pointer("host"), most_host_bytes, true);
    reader.boolean("numbered", out.numbered);
    out.words = "host " + value.dump();
}

std::string run_host(Acting& acting, const Step& step) {
    acting.stage.visit([&](board::Board& board, SimTime now) {
        std::string line = step.bytes;
        if (step.numbered) {
            board.refresh(now);
            const auto& usb = board.machine().host_side().lines[machine::HostSide::usb_port];
            line = fmt::format("N{} {}", usb.last + 1, line);
            line += fmt::format("*{}", protocol::xor_checksum(line));
        }
        board.connect(board::Channel::host, true);
        board.receive(now, line + '\n', board::Channel::host);
    });
    return {};
}

// press
// -----------------------------------------------------------------------------------------------

void compile_press(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("press");
    if (!value.is_string()) {
        c.findings().add(at,
                         found(value) + "; expected the path of a button, such as \"Control/Home/Home all\"");
        return;
    }
    out.text = value.get<std::string>();
    out.words = fmt::format("press \"{}\"", out.text);
    c.button(out.text, at);
}

/// On a screen that is part of the board: the control of the page that is open.
std::string press_own(Acting& acting, std::string_view path) {
    constexpr SimTime usual_touch{120'000};
    control::Display* display = acting.stage.display();
    if (display == nullptr) {
        return "this run has no screen";
    }
    std::string why;
    acting.stage.visit([&](board::Board& board, SimTime now) {
        board.refresh(now);
        why = display->touch(now, path.substr(path.rfind('/') + 1), usual_touch).why;
    });
    return why;
}

std::string run_press(Acting& acting, const Step& step) {
    if (acting.stage.screen() == nullptr) {
        return press_own(acting, step.text);
    }
    if (!acting.stage.screen()->ready()) {
        return fmt::format("\"{}\" cannot be pressed: the screen is still starting", step.text);
    }
    const screen::PressResult result = acting.stage.press(step.text);
    return result.pressed ? std::string{}
                          : fmt::format("\"{}\" cannot be pressed: {}", step.text, result.sentence);
}

// fault, clear
// -----------------------------------------------------------------------------------------------

constexpr std::string_view all_faults = "all";

void compile_fault(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("fault");
    out.words = "fault " + (value.is_string() ? value.get<std::string>() : value.dump());
    try {
        out.fault = fault::fault_from_json(value);
    } catch (const fault::FaultSpecError& error) {
        for (std::string problem : error.problems()) {
            if (problem.ends_with('.')) problem.pop_back();
            c.findings().add(at, std::move(problem));
        }
    }
    out.text = out.fault ? std::string(out.fault->kind->name) : std::string{};
    reader.text("as", out.text, 64);
    if (out.text == all_faults) {
        c.findings().add(reader.pointer("as"),
                         "\"all\" means every fault to \"clear\"; expected another name");
    } else if (!out.text.empty()) {
        c.shared().faults.insert(out.text);
    }
}

/// False when there is none of it any more.
bool take_away(Acting& acting, const MadeFault& made) {
    if (made.printer == 0) {
        return acting.stage.faults()->remove(made.line);
    }
    bool done = false;
    acting.stage.visit([&](board::Board& board, SimTime now) {
        board.tinker(
            now, [&](machine::Machine& m) { done = m.faults.remove(made.printer); },
            fault::world_words_of_mending(board.machine().faults, made.printer));
    });
    return done;
}

std::string run_fault(Acting& acting, const Step& step) {
    if (acting.stage.faults() == nullptr) {
        return "the line of this run takes no faults";
    }
    if (const auto known = acting.faults.find(step.text); known != acting.faults.end()) {
        take_away(acting, known->second);
        acting.faults.erase(known);
    }
    MadeFault made;
    if (fault::is_for_printer(*step.fault)) {
        std::string refusal;
        acting.stage.visit([&](board::Board& board, SimTime now) {
            const machine::FaultRequest request = fault::to_request(*step.fault);
            board.tinker(
                now,
                [&](machine::Machine& m) {
                    made.printer = m.faults.add(now, request);
                    refusal = made.printer == 0 ? m.faults.refusal(*request.info) : "";
                },
                fault::world_words(request, now));
        });
        if (made.printer == 0) {
            return refusal;
        }
    } else {
        try {
            made.line = acting.stage.faults()->add(*step.fault);
        } catch (const fault::FaultSpecError& error) {
            return error.what();
        }
    }
    acting.faults[step.text] = made;
    return {};
}

void compile_clear(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    const std::string at = reader.pointer("clear");
    if (!value.is_string()) {
        c.findings().add(at, found(value) + "; expected the name of a fault, or \"all\"");
        return;
    }
    out.text = value.get<std::string>();
    out.words = "clear " + out.text;
    if (out.text != all_faults && !c.sampling() && !c.shared().faults.contains(out.text)) {
        const std::vector<std::string_view> names(c.shared().faults.begin(), c.shared().faults.end());
        c.findings().add(
            at,
            fmt::format("no step before this one makes a fault of the name \"{}\"; expected \"all\", or "
                        "the name that a \"fault\" was given with \"as\"",
                        out.text),
            std::string(behaviour::nearest(out.text, names)));
    }
}

std::string run_clear(Acting& acting, const Step& step) {
    if (acting.stage.faults() == nullptr) {
        return "the line of this run takes no faults";
    }
    if (step.text == all_faults) {
        acting.stage.faults()->clear();
        acting.stage.visit([](board::Board& board, SimTime now) {
            board.tinker(
                now, [](machine::Machine& m) { m.faults.clear(); },
                fault::world_words_of_mending(board.machine().faults));
        });
        acting.faults.clear();
    } else if (const auto hit = acting.faults.find(step.text); hit != acting.faults.end()) {
        take_away(acting, hit->second);
        acting.faults.erase(hit);
    }
    return {};
}

// note
// -----------------------------------------------------------------------------------------------

void compile_note(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    if (!value.is_string()) {
        c.findings().add(reader.pointer("note"), found(value) + "; expected a text");
        return;
    }
    out.text = value.get<std::string>();
    out.words = "note";
}

std::string run_note(Acting& acting, const Step& step) {
    acting.stage.note(step.text);
    return {};
}

constexpr std::array host_keys{
    KeyInfo{"numbered", "true or false",
            "puts the number that the board expects in front and a checksum behind; left out: false"}};
constexpr std::array fault_keys{
    KeyInfo{"as", "name", "what to call it; left out: its kind. A fault of the same name is replaced"}};

constexpr std::array act_table{
    StepKind{"do",
             "actions",
             "does something to the machine: an action, a phrase, or a list of them; a machine that "
             "refuses fails the scenario",
             R"j({"do": {"heater.target": {"heater": "nozzle", "c": "200C"}}})j",
             {},
             Role::act,
             compile_do,
             run_calls},
    StepKind{"set",
             "fields",
             "puts values into fields, within their bounds",
             R"j({"set": {"wifi.signal": 3}})j",
             {},
             Role::act,
             compile_set,
             run_calls},
    StepKind{"send",
             "frame, or {\"line\": text}, or {\"raw\": text}",
             "the board says a frame of its profile, a line, or bytes as they are, to the screen",
             R"j({"send": {"line": "L18 P26 S1"}})j",
             {},
             Role::act,
             compile_send,
             run_send},
    StepKind{"request",
             "text",
             "the board hears this line as if the screen had asked it, past the line and its "
             "faults",
             R"j({"request": "M105"})j",
             {},
             Role::act,
             compile_request,
             run_request},
    StepKind{"host", "text",
             "the board hears this line over its USB port, as if a host program had sent it; from the first "
             "one on somebody is there to be answered",
             R"j({"host": "G28", "numbered": true})j", host_keys, Role::act, compile_host, run_host},
    StepKind{"press",
             "button",
             "the virtual screen's button is touched, and those on the way to it",
             R"j({"press": "Control/Home/Home all"})j",
             {},
             Role::act,
             compile_press,
             run_press},
    StepKind{"fault", "fault", "the line misbehaves, or the printer breaks, from now on; see faults",
             R"j({"fault": "drop:to_screen,every=3", "as": "lossy"})j", fault_keys, Role::act, compile_fault,
             run_fault},
    StepKind{"clear",
             "name",
             "that fault is over, by the name of its kind or the one given with \"as\"; \"all\" ends every "
             "one",
             R"j({"clear": "lossy"})j",
             {},
             Role::act,
             compile_clear,
             run_clear},
    StepKind{"note",
             "text",
             "tells whoever watches",
             R"j({"note": "now the card is taken out"})j",
             {},
             Role::act,
             compile_note,
             run_note},
};

}  // namespace

std::span<const StepKind> act_steps() {
    return act_table;
}

}  // namespace fauxboard::script::rows
