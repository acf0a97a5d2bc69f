// `fauxboard replay`: a recorded talk once more, in virtual time, with our board on the other side.

#include "emulator/record/replay.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "emulator/host/folder_card.h"
#include "emulator/host/profile_files.h"
#include "emulator/link/host_error.h"
#include "emulator/link/output_file.h"
#include "emulator/record/compare.h"
#include "emulator/record/plot.h"
#include "tools/batch.h"
#include "tools/file_roles.h"
#include "tools/option_values.h"
#include "tools/progress.h"
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

/// More than this much is not held at once, as a comparison must.
constexpr std::uintmax_t most_compared_bytes = 256UL * 1024 * 1024;

/// When the recorded board first spoke.
std::optional<machine::SimTime> first_board_line(const std::string& file) {
    std::ifstream in = record::open_recording(file);
    record::OrderedRecording recording(record::RecordingReader(in, file));
    while (const auto line = recording.next()) {
        if (line->from == record::RecordedLine::From::board) {
            return line->t;
        }
    }
    return std::nullopt;
}

/// What the board would have told a person, on stderr so that stdout stays a recording.
void print_notice(const record::ReplayNotice& notice) {
    if (notice.level >= behaviour::Level::warning) {
        print_error(fmt::format("{:.3f} s: {}\n", machine::to_seconds(notice.t), notice.text));
    }
}

/// Line by line, however long the recording is.
ExitCode play(const ReplayArguments& arguments, const std::shared_ptr<const behaviour::Profile>& profile,
              const record::ReplayOptions& options) {
    std::ifstream in = record::open_recording(arguments.capture);
    record::OrderedRecording recording(record::RecordingReader(in, arguments.capture));
    Batch out;
    record::ReplayTalk talk;
    talk.first_board_line = first_board_line(arguments.capture);
    Progress progress;
    talk.next = [&] {
        auto line = recording.next();
        if (line && progress.due()) {
            progress.say(fmt::format("replay: {:.0f} s of the recording", machine::to_seconds(line->t)));
        }
        return line;
    };
    talk.on_line = [&](const record::RecordedLine& line) { out.add(record::recording_line(line)); };
    talk.on_notice = print_notice;
    record::replay(profile, talk, options);
    progress.clear();
    return ExitCode::ok;
}

ExitCode compare(const ReplayArguments& arguments, const std::shared_ptr<const behaviour::Profile>& profile,
                 const record::ReplayOptions& options) {
    std::error_code error;
    if (std::filesystem::file_size(arguments.capture, error) > most_compared_bytes && !error) {
        throw record::ReplayError("it is too large to be compared at once; cut it to 256 MiB");
    }
    const auto recording = record::load_recording(std::filesystem::path(arguments.capture));
    const record::ReplayResult result = record::replay(profile, recording, options);
    for (const record::ReplayNotice& notice : result.notices) {
        print_notice(notice);
    }
    if (!arguments.plot.empty()) {
        link::write_output(arguments.plot, arguments.plot,
                           record::plot_svg({{"recorded", recording}, {"replayed", result.lines}},
                                            record::prints_folded(*profile)));
        if (!arguments.compare) {
            return ExitCode::ok;
        }
    }
    const record::Comparison comparison =
        record::compare(recording, result.lines, record::prints_folded(*profile));
    print(arguments.json ? record::comparison_json(comparison).dump(2, ' ', true) + "\n"
                         : record::comparison_text(comparison));
    return comparison.ok() ? ExitCode::ok : ExitCode::failed;
}

ExitCode replay(const ReplayArguments& arguments) {
    const auto profile = host::load_profile_by_name(arguments.profile);
    FileRoles roles;
    roles.reads("the profile", profile->files);
    roles.reads("the recording", arguments.capture);
    roles.writes("the picture", arguments.plot);
    record::ReplayOptions options = arguments.options;
    std::optional<host::FolderCard> card;
    if (!arguments.sd.empty()) {
        options.services.sd = &card.emplace(arguments.sd);
    }
    return arguments.compare || !arguments.plot.empty() ? compare(arguments, profile, options)
                                                        : play(arguments, profile, options);
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
        ->type_name("NAME|FILE")
        ->capture_default_str();
    add_seed(*command, arguments->options.seed, "Start of the random sequence");
    command
        ->add_option("--sd", arguments->sd,
                     "Folder that is the board's SD card or stick, to be read and written")
        ->type_name("DIR");
    command->add_option("CAPTURE", arguments->capture, "The recording, JSON lines")
        ->type_name("FILE")
        ->required();
    CLI::Option* compare = command->add_flag(
        "--compare", arguments->compare,
        "Report instead how our lines differ from the recorded board's; exit code 1 when too much");
    command
        ->add_option("--plot", arguments->plot,
                     "Draw the curves instead, recorded against replayed: an SVG for any browser")
        ->type_name("FILE.svg");
    command->add_flag("--json", arguments->json, "The report as one JSON object")->needs(compare);
    command->callback([arguments, &exit] { exit = guarded(*arguments); });
}

}  // namespace fauxboard::tools
