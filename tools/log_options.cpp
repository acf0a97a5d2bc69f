#include "tools/log_options.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/profile.h"
#include "emulator/host/program_log.h"
#include "tools/option_values.h"
#include "tools/run_options.h"
#include "tools/version.h"

namespace fauxboard::tools {
namespace {

constexpr std::uint64_t least_bytes = 4096;
constexpr unsigned most_files = 100;

host::LogLevel read_level(const std::string& text) {
    if (const auto level = host::log_level(text)) {
        return *level;
    }
    std::vector<std::string_view> names;
    std::string known;
    for (auto level = host::LogLevel::trace; level <= host::LogLevel::off;
         level = static_cast<host::LogLevel>(static_cast<unsigned>(level) + 1)) {
        names.push_back(host::level_name(level));
        known += fmt::format("{}{}", known.empty() ? "" : ", ", names.back());
    }
    const std::string_view nearest = behaviour::nearest(text, names);
    throw CLI::ValidationError(
        "--log-level", fmt::format("'{}' is no level; expected one of {}{}", text, known,
                                   nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
}

std::uint64_t read_size(const std::string& text) {
    const auto bytes = parse_size(text);
    if (!bytes || *bytes < least_bytes) {
        throw CLI::ValidationError(
            "--log-size", fmt::format("'{}' is no size for a log; expected bytes, or such as 64k, 10M, 1G, "
                                      "and no less than {}",
                                      text, least_bytes));
    }
    return *bytes;
}

}  // namespace

host::LogFile::Options LogOptions::for_file() const {
    return {file, most_bytes, files, host::ProgramLog::head(json)};
}

void add_log(CLI::App& command, LogOptions& options) {
    command
        .add_option_function<std::string>(
            "--log-level", [&options](const std::string& text) { options.level = read_level(text); },
            "What the program tells of its own doings, apart from the talk; in --log-file (default: info), "
            "else on stderr (default: as -q and -v say)")
        ->type_name("trace|debug|info|warning|error|off");
    CLI::Option* const file =
        command
            .add_option("--log-file", options.file,
                        "Keep a log of them in a file, older ones as FILE.1, FILE.2, ...")
            ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--log-size", [&options](const std::string& text) { options.most_bytes = read_size(text); },
            "A log file is followed by the next at this size (default: 10M)")
        ->type_name("SIZE")
        ->needs(file);
    command.add_option("--log-files", options.files, "So many log files at most (default: 5)")
        ->type_name("N")
        ->check(whole_between(1, most_files))
        ->needs(file);
    command.add_flag("--log-json", options.json, "The log file as JSON lines")->needs(file);
}

std::vector<std::string> first_words(const RunOptions& options, const behaviour::Profile& profile) {
    const std::string version = version_text();
    std::vector<std::string> out{version.substr(0, version.find('\n')) + " begins"};
    for (const std::string& file : profile.files) {
        out.push_back("profile " + profile.name + ": " + file);
    }
    const std::pair<const char*, const std::string&> files[] = {
        {"SD card", options.sd},        {"U-disk", options.udisk},    {"EEPROM", options.eeprom},
        {"UV panel", options.panel},    {"SPI", options.spi},         {"recording", options.record},
        {"control", options.control},   {"scenario", options.script}, {"report", options.report},
        {"JUnit report", options.junit}};
    for (const auto& [what, where] : files) {
        if (!where.empty()) {
            out.push_back(fmt::format("{}: {}", what, where));
        }
    }
    return out;
}

}  // namespace fauxboard::tools
