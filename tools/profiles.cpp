// `fauxboard profiles`: the boards that `run --profile` knows by name.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "emulator/host/profile_files.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using host::ProfileEntry;

std::string table(const std::vector<ProfileEntry>& profiles) {
    if (profiles.empty()) {
        return "There are no profiles. Name their folder in FAUXBOARD_PROFILES.\n";
    }
    std::size_t name = 4;
    std::size_t title = 5;
    for (const ProfileEntry& entry : profiles) {
        name = std::max(name, entry.name.size());
        title = std::max(title, entry.title.size());
    }
    std::string text = fmt::format("{:<{}}  {:<{}}  {}\n", "NAME", name, "TITLE", title, "FILE");
    for (const ProfileEntry& entry : profiles) {
        text +=
            fmt::format("{:<{}}  {:<{}}  {}\n", entry.name, name, entry.title, title, entry.file.string());
    }
    return text;
}

std::string json(const std::vector<ProfileEntry>& profiles) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ProfileEntry& entry : profiles) {
        list.push_back({{"name", entry.name}, {"title", entry.title}, {"file", entry.file.string()}});
    }
    return list.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void add_profiles(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("profiles", "List the boards that there are");
    const auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "As a JSON array");
    command->callback([as_json, &exit] {
        const std::vector<ProfileEntry> list = host::list_profiles();
        print(*as_json ? json(list) : table(list));
        exit = ExitCode::ok;
    });
}

}  // namespace fauxboard::tools
