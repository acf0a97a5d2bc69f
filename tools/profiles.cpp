// `fauxboard profiles`: the boards that `run --profile`, the touch screens that `screen --screen` and the
// scenarios that `run --script` know by name.

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/host/script_files.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using host::ProfileEntry;

struct Listed {
    std::string_view kind;  ///< what it is: "board", "screen" or "scenario"
    ProfileEntry entry;
};

std::vector<Listed> everything() {
    std::vector<Listed> out;
    for (ProfileEntry& entry : host::list_profiles()) {
        out.push_back({"board", std::move(entry)});
    }
    for (ProfileEntry& entry : host::list_screens()) {
        out.push_back({"screen", std::move(entry)});
    }
    for (ProfileEntry& entry : host::list_scripts()) {
        out.push_back({"scenario", std::move(entry)});
    }
    return out;
}

/// As wide as the terminal is; where there is none, as wide as it comes.
std::size_t columns() {
    winsize size{};
    return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col != 0 ? size.ws_col
                                                                              : std::string::npos;
}

std::string names(const std::vector<Listed>& list) {
    std::string text;
    for (const Listed& one : list) {
        text += one.entry.name + "\n";
    }
    return text;
}

/// `text` in at most `most` columns; what is cut ends with a mark. Titles are plain text of one column a
/// letter.
std::string cut(const std::string& text, std::size_t most) {
    return text.size() <= most ? text : text.substr(0, most - 3) + "...";
}

std::string table(const std::vector<Listed>& list, std::size_t width) {
    if (list.empty()) {
        return "There are no profiles. Name their folder in FAUXBOARD_PROFILES.\n";
    }
    std::size_t name = 4;
    std::size_t title = 5;
    for (const Listed& one : list) {
        name = std::max(name, one.entry.name.size());
        title = std::max(title, one.entry.title.size());
    }
    constexpr std::size_t least_title = 20;
    constexpr std::size_t gaps = 8 + 2 + 2;  // the kind's column, and what stands between columns
    if (width != std::string::npos) {        // on a terminal the folders are said once, below
        title = std::min(title, std::max(least_title, width - std::min(width, gaps + name)));
    }
    std::string text = fmt::format("{:<8}  {:<{}}  {:<{}}{}\n", "KIND", "NAME", name, "TITLE", title,
                                   width == std::string::npos ? "  FILE" : "");
    std::vector<std::string> folders;
    for (const Listed& one : list) {
        text += fmt::format("{:<8}  {:<{}}  {:<{}}{}\n", one.kind, one.entry.name, name,
                            cut(one.entry.title, title), title,
                            width == std::string::npos ? "  " + one.entry.file.string() : "");
        if (std::string folder = one.entry.file.parent_path().string();
            std::find(folders.begin(), folders.end(), folder) == folders.end()) {
            folders.push_back(std::move(folder));
        }
    }
    if (width != std::string::npos) {
        text += "In";
        for (const std::string& folder : folders) {
            text += " " + folder;
        }
        text += "\n";
    }
    return text;
}

std::string json(const std::vector<Listed>& list) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const Listed& one : list) {
        out.push_back({{"name", one.entry.name},
                       {"kind", one.kind},
                       {"title", one.entry.title},
                       {"file", one.entry.file.string()}});
    }
    return out.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void add_profiles(CLI::App& app, ExitCode& exit) {
    CLI::App* command =
        app.add_subcommand("profiles", "List the boards, the screens and the scenarios that there are");
    const auto as_json = std::make_shared<bool>(false);
    const auto as_names = std::make_shared<bool>(false);
    CLI::Option* json_flag = command->add_flag("--json", *as_json, "As a JSON array");
    command->add_flag("--names", *as_names, "The names alone, a line each")->excludes(json_flag);
    command->callback([as_json, as_names, &exit] {
        const std::vector<Listed> list = everything();
        print(*as_json ? json(list) : *as_names ? names(list) : table(list, columns()));
        exit = ExitCode::ok;
    });
}

}  // namespace fauxboard::tools
