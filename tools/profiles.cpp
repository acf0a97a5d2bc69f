// `fauxboard profiles`: the boards that `run --profile`, the touch screens that `screen --screen` and the
// scenarios that `run --script` know by name.

#include <fmt/format.h>

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

std::string table(const std::vector<Listed>& list) {
    if (list.empty()) {
        return "There are no profiles. Name their folder in FAUXBOARD_PROFILES.\n";
    }
    std::size_t name = 4;
    std::size_t title = 5;
    for (const Listed& one : list) {
        name = std::max(name, one.entry.name.size());
        title = std::max(title, one.entry.title.size());
    }
    std::string text =
        fmt::format("{:<8}  {:<{}}  {:<{}}  {}\n", "KIND", "NAME", name, "TITLE", title, "FILE");
    for (const Listed& one : list) {
        text += fmt::format("{:<8}  {:<{}}  {:<{}}  {}\n", one.kind, one.entry.name, name, one.entry.title,
                            title, one.entry.file.string());
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
    command->add_flag("--json", *as_json, "As a JSON array");
    command->callback([as_json, &exit] {
        const std::vector<Listed> list = everything();
        print(*as_json ? json(list) : table(list));
        exit = ExitCode::ok;
    });
}

}  // namespace fauxboard::tools
