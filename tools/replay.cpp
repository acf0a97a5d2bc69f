// `fauxboard replay`: a recorded talk once more, in virtual time, with our board on the other side.

#include "emulator/record/replay.h"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <optional>

#include "emulator/host/folder_card.h"
#include "emulator/host/profile_files.h"
#include "emulator/link/host_error.h"
#include "emulator/record/compare.h"
#include "emulator/record/plot.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

struct ReplayArguments {
    std::string profile = "geeetech-a30t";
    std::string capture;
    std::string sd;
    record::ReplayOptions options;
    std::string plot;  ///< file; empty: none
    bool compare = false;
    bool json = false;
};

/// What the board would have told a person, on stderr so that stdout stays a recording.
void print_notices(const record::ReplayResult& result) {
    for (const record::ReplayNotice& notice : result.notices) {
        if (notice.level >= behaviour::Level::warning) {
            fmt::print(stderr, "{:.3f} s: {}\n", machine::to_seconds(notice.t), notice.text);
        }
    }
}

void write_plot(const std::string& file, const std::string& svg) {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out << svg;
    out.close();
    if (!out) {
        throw link::HostError(fmt::format("{} cannot be written. Name a file in a folder of yours.", file));
    }
}

ExitCode replay(const ReplayArguments& arguments) {
    const auto profile = host::load_profile_by_name(arguments.profile);
    const auto recording = record::load_recording(std::filesystem::path(arguments.capture));
    record::ReplayOptions options = arguments.options;
    std::optional<host::FolderCard> card;
    if (!arguments.sd.empty()) {
        options.services.sd = &card.emplace(arguments.sd);
    }
    const record::ReplayResult result = record::replay(profile, recording, options);
    print_notices(result);
    if (!arguments.plot.empty()) {
        write_plot(arguments.plot, record::plot_svg({{"recorded", recording}, {"replayed", result.lines}},
                                                    profile->machine->thermal.fold));
        if (!arguments.compare) {
            return ExitCode::ok;
        }
    }
    if (!arguments.compare) {
        std::string text;
        for (const record::RecordedLine& line : result.lines) {
            text += record::recording_line(line);
        }
        print(text);
        return ExitCode::ok;
    }
    const record::Comparison comparison =
        record::compare(recording, result.lines, record::prints_folded(*profile));
    print(arguments.json ? record::comparison_json(comparison).dump(2, ' ', true) + "\n"
                         : record::comparison_text(comparison));
    return comparison.ok() ? ExitCode::ok : ExitCode::failed;
}

ExitCode guarded(const ReplayArguments& arguments) {
    try {
        return replay(arguments);
    } catch (const behaviour::ProfileError& error) {
        return complain("replay", ExitCode::bad_input, error.what());
    } catch (const record::RecordingError& error) {
        return complain("replay", ExitCode::bad_input, error.what());
    } catch (const link::HostError& error) {
        return complain("replay", ExitCode::bad_input, error.what());
    } catch (const record::ReplayError& error) {
        return complain("replay", ExitCode::bad_input, arguments.capture + ": " + error.what());
    }
}

}  // namespace

void add_replay(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand(
        "replay",
        "Put a recorded screen's requests to a board in virtual time; its lines come out on stdout");
    const auto arguments = std::make_shared<ReplayArguments>();
    command->add_option("--profile", arguments->profile, "The board: a name (see `profiles`) or a file")
        ->capture_default_str();
    command->add_option("--seed", arguments->options.seed, "Start of the random sequence")
        ->capture_default_str();
    command->add_option("--sd", arguments->sd,
                        "Folder that is the board's SD card or stick, to be read and written");
    command->add_option("capture", arguments->capture, "The recording, JSON lines")->required();
    CLI::Option* compare = command->add_flag(
        "--compare", arguments->compare,
        "Report instead how our lines differ from the recorded board's; exit code 1 when too much");
    command->add_option("--plot", arguments->plot,
                        "Draw the curves instead, recorded against replayed: an SVG for any browser")
        ->type_name("FILE.svg");
    command->add_flag("--json", arguments->json, "The report as one JSON object")->needs(compare);
    command->callback([arguments, &exit] { exit = guarded(*arguments); });
}

}  // namespace fauxboard::tools
