#include "tools/run_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/fields.h"
#include "emulator/control/names.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/host/script_files.h"
#include "emulator/host/text_output.h"
#include "emulator/link/host_error.h"
#include "emulator/link/output_file.h"
#include "emulator/script/loader.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using script::Json;
using script::Outcome;

constexpr std::size_t shown_talk = 8;

ExitCode exit_code(Outcome::Verdict verdict) {
    switch (verdict) {
        case Outcome::Verdict::passed:
            return ExitCode::ok;
        case Outcome::Verdict::failed:
            return ExitCode::failed;
        case Outcome::Verdict::timed_out:
            return ExitCode::timed_out;
        case Outcome::Verdict::interrupted:
            return ExitCode::interrupted;
    }
    return ExitCode::internal;
}

/// What passed last, for a person who reads what failed.
std::string talk_text(const Outcome& outcome) {
    static constexpr std::array<std::string_view, 5> talkers{"board → screen", "screen → board", "event",
                                                             "board → host", "host → board"};
    static_assert(static_cast<std::size_t>(script::Talk::From::host) + 1 == talkers.size());
    std::string out;
    const std::size_t from = outcome.talk.size() - std::min(outcome.talk.size(), shown_talk);
    for (std::size_t i = from; i < outcome.talk.size(); ++i) {
        const script::Talk& talk = outcome.talk[i];
        out += fmt::format("{:10.3f}  {:<14}  {}\n", machine::to_seconds(talk.at),
                           talkers[static_cast<std::size_t>(talk.from)], talk.text);
    }
    return out.empty() ? out : "What passed last:\n" + out;
}

/// Reports are made to be shared.
void mask(Json& state) {
    for (auto& [path, value] : state.items()) {
        const behaviour::Field* const field = behaviour::find_field(path);
        if (field != nullptr && field->secret && value.is_string() &&
            !value.get_ref<const std::string&>().empty()) {
            value = "***";
        }
    }
}

}  // namespace

std::shared_ptr<const script::Scenario> plan_script(RunOptions& options) {
    if (options.script.empty()) {
        return nullptr;
    }
    const behaviour::SourceText source = host::find_script(options.script);
    const script::Head head = script::read_head(source);
    if (!options.profile_given && !head.profile.empty()) {
        options.profile = head.profile;
    }
    if (options.screen.empty() && !options.line_given) {
        options.screen = head.screen;
    }
    const script::Cast cast = host::make_cast(options.profile, options.screen, &source);
    script::Arguments arguments;
    for (const std::string& each : options.params) {
        const std::size_t sign = each.find('=');
        arguments[each.substr(0, sign)] = sign == std::string::npos ? "" : each.substr(sign + 1);
    }
    return script::load_scenario(source, host::script_finder(), cast, arguments);
}

ExitCode tell_outcome(const RunOptions& options, const script::Player& player, const board::Board& board,
                      const Json& faults, host::TextOutput& out, host::TextOutput& err) {
    const Outcome outcome = script::for_others(player.outcome());
    ExitCode exit = exit_code(outcome.verdict);
    Json more{{"seed", options.seed}};
    if (!options.record.empty()) {
        more["recording"] = options.record;
    }
    more["faults"] = faults;
    more["state"] = control::values_of(board, control::all_places(board));
    mask(more["state"]);
    const Json report = script::outcome_json(player.scenario(), outcome, more);
    err.write((outcome.verdict == Outcome::Verdict::passed ? std::string{} : talk_text(outcome)) +
              outcome.sentence + "\n");
    if (options.json) {
        out.write(report.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n");
    }
    const auto keep = [&](const std::string& file, const std::string& text) {
        try {
            if (!file.empty()) link::write_output(file, file, text);
        } catch (const link::HostError& error) {
            complain("run", ExitCode::bad_input, error.what());
            exit = exit == ExitCode::ok ? ExitCode::bad_input : exit;
        }
    };
    keep(options.report, report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    keep(options.junit, script::outcome_junit(player.scenario(), outcome));
    return exit;
}

}  // namespace fauxboard::tools
