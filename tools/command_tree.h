#pragma once

// What a command line declares, as plain data for those who write about it.

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::tools {

struct DeclaredOption {
    std::vector<std::string> names;  ///< with their dashes, short ones first; empty for a positional
    std::string positional;          ///< its name, if it has no dashes
    std::string value;               ///< what it takes, as in the help: DEV, [=LINK]; empty for a flag
    std::string type;                ///< the same of a positional too: NAME|FILE, bash|zsh|fish
    std::string help;
    bool required = false;

    /// The words that it takes, when they are a few: those of the type bash|zsh|fish.
    std::vector<std::string> choices() const;
};

struct DeclaredCommand {
    std::string path;  ///< "run", "screen press"; empty for the program itself
    std::string help;
    std::vector<DeclaredOption> options;
};

/// The names of an option with their dashes, short ones first; empty for a positional.
std::vector<std::string> option_names(const CLI::Option& option);

/// What an option takes, as the help calls it: DEV, [=LINK]; empty for a flag.
std::string option_value(const CLI::Option& option);

/// The commands right below this one.
std::vector<const CLI::App*> commands_of(const CLI::App& command);

/// The command of that name below this one; null for none.
const CLI::App* find_command(const CLI::App& command, std::string_view name);

/// The options and positionals of one command, in the order of their declaration; those in groups come last.
std::vector<DeclaredOption> declared_options(const CLI::App& command);

/// The program, its commands and theirs, each before its own.
std::vector<DeclaredCommand> declared_commands(const CLI::App& app);

/// A sentence about the first word of a command line that is no command, or no option where it stands, with
/// the nearest that is one; empty when there is none such. `words` are without the program's name.
std::string unknown_word(const CLI::App& app, const std::vector<std::string>& words);

/// What the library has against a command line that it has parsed, for people: the command that it is about,
/// what is wrong, and what would be right.
std::string wrong_use(const CLI::App& app, const std::string& what);

}  // namespace fauxboard::tools
