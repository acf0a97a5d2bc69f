// `fauxboard decode`: what each line of a recording means, in words.

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cerrno>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/link/host_error.h"
#include "emulator/link/waiting_file.h"
#include "emulator/record/screen_judge.h"
#include "emulator/record/transcript.h"
#include "emulator/record/transcript_words.h"
#include "tools/batch.h"
#include "tools/decode_spi.h"
#include "tools/profile_words.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

constexpr const char* legend =
    R"(Forms, told apart by their content, line by line:
  {"t": 16.451778, "from": "screen", "line": "..."}   what run, tap and replay record
  15:15:12.123456789 - line                           one direction a file; several are merged by time
  2024-01-02 10:00:00,100 - Send: line                OctoPrint's serial.log; without times, its terminal's
                                                      Send: and Recv:, printcore's SENT: and RECV:
  anything else                                       the line itself
or, as a whole, what run --spi writes: every packet and command on the wires to a UV panel.
Marks at the start of a line: ! its checksum is wrong, ? its code or a field is unknown, x it cannot be read,
* anything else: with --screen, what that screen would have ignored, missed, cut, dropped, misread or crashed on.
For lines that do not say who said them, that is told by what they say.)";

struct DecodeOptions {
    std::vector<std::string> files;
    std::string screen;   ///< name or file; empty: no screen judges
    std::string profile;  ///< name or file; empty: the protocol's words alone
    bool json = false;
};

/// The files, kept open while they are read.
class Inputs {
  public:
    /// Throws HostError.
    explicit Inputs(const std::vector<std::string>& files) {
        if (files.empty()) {
            add("-");
        }
        for (const std::string& file : files) {
            add(file);
        }
    }
    std::vector<record::TranscriptReader> take() { return std::move(readers_); }
    /// Whether one of them failed before its end.
    bool failed() const {
        return std::any_of(streams_.begin(), streams_.end(),
                           [](const std::ifstream& stream) { return stream.bad(); });
    }

  private:
    void add(const std::string& file) {
        if (file == "-") {
            readers_.emplace_back(std::cin, "stdin");
            return;
        }
        errno = 0;
        std::error_code error;
        const auto kind = std::filesystem::status(file, error).type();
        if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::fifo) {
            throw link::HostError(fmt::format(
                "{} cannot be read: {}.", file,
                error ? error.message() : "it is no file and no pipe; a stream comes by standard input"));
        }
        if (link::must_be_waited_for(file)) {
            throw link::HostError(fmt::format(
                "{} cannot be read: it would have to be waited for; a stream comes by standard input.",
                file));
        }
        std::ifstream& in = streams_.emplace_back(file, std::ios::binary);
        if (!in) {
            throw link::HostError(
                fmt::format("{} cannot be read: {}.", file, std::system_category().message(errno)));
        }
        readers_.emplace_back(in, file);
    }

    std::deque<std::ifstream> streams_;
    std::vector<record::TranscriptReader> readers_;
};

/// What the profile has words for is not unknown.
void add_own_words(const behaviour::Profile& profile, record::JudgedLine& line) {
    if (!line.decoded) {
        return;
    }
    line.own = profile_words(profile, behaviour::Channel::main, *line.decoded);
    if (!line.own.empty()) {
        std::erase_if(line.marks,
                      [](const record::LineMark& mark) { return mark.kind.starts_with("unknown"); });
    }
}

ExitCode decode(const DecodeOptions& options) {
    try {
        std::ios::sync_with_stdio(false);  // so that lines of a pipe are taken as they come
        if (options.files.size() <= 1) {
            const std::string file = options.files.empty() ? "-" : options.files.front();
            std::error_code error;
            std::ifstream from_file;
            if (std::filesystem::is_regular_file(file, error) && !link::must_be_waited_for(file)) {
                from_file.open(file, std::ios::binary);
            }
            std::istream& in = file == "-" ? std::cin : from_file;
            if ((file == "-" || from_file.is_open()) && is_spi(in)) {
                return decode_spi(in, file == "-" ? "stdin" : file, options.json);
            }
        }
        Inputs inputs(options.files);
        const bool live = options.files.empty();
        std::vector<record::LineJudge> judges = record::line_judges();
        if (!options.screen.empty()) {
            judges.push_back(record::screen_judge(host::load_screen_by_name(options.screen)));
        }
        const auto profile = options.profile.empty() ? nullptr : host::load_profile_by_name(options.profile);
        record::Transcripts transcripts(inputs.take());
        std::size_t lines = 0;
        bool sense = false;
        protocol::PeerName peer;
        Batch batch;
        while (auto entry = transcripts.next()) {
            record::JudgedLine line = record::judge(std::move(*entry), judges);
            if (profile) {
                add_own_words(*profile, line);
            }
            line.peer = line.decoded ? peer.at(*line.decoded) : peer.get();
            ++lines;
            sense = sense || record::makes_sense(line);
            const std::string text = options.json ? record::json_line(line) : record::text_line(line);
            if (!batch.add(text, live && std::cin.rdbuf()->in_avail() <= 0)) {
                return ExitCode::ok;
            }
        }
        batch.flush();
        if (inputs.failed()) {
            throw link::HostError("The input could not be read to its end.");
        }
        if (lines != 0 && !sense) {
            return complain("decode", ExitCode::bad_input,
                            "nothing here is of a form that decode knows; its --help names those.");
        }
        return ExitCode::ok;
    } catch (const behaviour::ProfileError& error) {
        return complain("decode", ExitCode::bad_input, error.what());
    } catch (const link::HostError& error) {
        return complain("decode", ExitCode::bad_input, error.what());
    }
}

}  // namespace

void add_decode(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("decode", "Say in words what each line of a recording means");
    const auto options = std::make_shared<DecodeOptions>();
    command->add_option("FILE", options->files, "Recordings; none or '-': standard input")->type_name("FILE");
    command
        ->add_option(
            "--screen", options->screen,
            "Judge the board's lines as this screen would take them: a name of `fauxboard profiles`, or "
            "a file")
        ->type_name("NAME|FILE");
    add_words_of(*command, options->profile);
    command->add_flag("--json", options->json, "One JSON object a line; timed ones are a recording again");
    command->footer(legend);
    command->callback([options, &exit] { exit = decode(*options); });
}

}  // namespace fauxboard::tools
