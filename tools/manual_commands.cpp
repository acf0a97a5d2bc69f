// `fauxboard manual` and `fauxboard completion`: what packages install, and what a shell can source.

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emulator/link/host_error.h"
#include "emulator/link/output_file.h"
#include "tools/command_tree.h"
#include "tools/commands.h"
#include "tools/manual.h"
#include "tools/option_values.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

/// Each page under its name in `folder`. Throws HostError.
void write_pages(const CLI::App& app, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    std::vector<const CLI::App*> commands = commands_of(app);
    commands.push_back(&app);
    for (const CLI::App* command : commands) {
        const std::string name = command == &app ? "fauxboard" : "fauxboard-" + command->get_name();
        const std::string file = (folder / (name + ".1")).string();
        link::write_output(file, file, man_page(app, *command));
    }
}

ExitCode manual(const CLI::App& app, const std::string& name, const std::string& folder) {
    if (!folder.empty()) {
        try {
            write_pages(app, folder);
        } catch (const link::HostError& error) {
            return complain("manual", ExitCode::bad_input, error.what());
        }
        return ExitCode::ok;
    }
    print(man_page(app, name.empty() ? app : *find_command(app, name)));
    return ExitCode::ok;
}

/// "run|fleet|...": those that there are when it is asked for.
std::string names_of(const CLI::App& app) {
    std::string names;
    for (const CLI::App* command : commands_of(app)) {
        names += (names.empty() ? "" : "|") + command->get_name();
    }
    return names;
}

}  // namespace

void add_manual(CLI::App& app, ExitCode& exit) {
    CLI::App* pages = app.add_subcommand("manual", "A manual page in roff: fauxboard manual run | man -l -");
    const auto name = std::make_shared<std::string>();
    const auto folder = std::make_shared<std::string>();
    CLI::Option* command =
        pages->add_option("COMMAND", *name, "The command; fauxboard itself when none is named")
            ->type_name_fn([&app] { return names_of(app); })
            ->check([&app](const std::string& text) { return unknown_word(app, {text}); });
    pages->add_option("--all", *folder, "Write every page into this folder")
        ->type_name("DIR")
        ->excludes(command);
    pages->callback([&app, name, folder, &exit] { exit = manual(app, *name, *folder); });

    CLI::App* shells = app.add_subcommand(
        "completion", "What a shell reads to complete commands: source <(fauxboard completion bash)");
    const auto shell = std::make_shared<std::string>();
    static const std::map<std::string, Shell> known{
        {"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}};
    shells->add_option("SHELL", *shell, "bash, zsh or fish")
        ->type_name("bash|zsh|fish")
        ->required()
        ->check(one_of({"bash", "zsh", "fish"}));
    shells->callback([&app, shell, &exit] {
        print(completion(app, known.at(*shell)));
        exit = ExitCode::ok;
    });
}

}  // namespace fauxboard::tools
