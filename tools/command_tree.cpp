#include "tools/command_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <algorithm>
#include <cctype>
#include <utility>

#include "emulator/behaviour/nearest.h"

namespace fauxboard::tools {
namespace {

/// Its type, without the library's own words for what is valid.
std::string type_of(const CLI::Option& option) {
    std::string type = option.get_type_name();
    for (const std::string_view valid : {":{", ":UINT", ":INT", ":FLOAT", ":NONNEGATIVE", ":POSITIVE"}) {
        type.resize(std::min(type.size(), type.find(valid)));
    }
    return type;
}

DeclaredOption describe(const CLI::Option& option) {
    DeclaredOption out;
    out.names = option_names(option);
    out.positional = out.names.empty() ? option.get_name(true) : std::string();
    out.value = option_value(option);
    out.type = type_of(option);
    out.help = option.get_description();
    out.required = option.get_required();
    return out;
}

/// The commands below `command`, or (`named` false) its groups of options, which the library keeps as
/// commands without a name.
std::vector<const CLI::App*> children(const CLI::App& command, bool named) {
    return command.get_subcommands([named](const CLI::App* sub) { return sub->get_name().empty() != named; });
}

void collect(const CLI::App& command, const std::string& path, std::vector<DeclaredCommand>& out) {
    out.push_back({path, command.get_description(), declared_options(command)});
    for (const CLI::App* sub : commands_of(command)) {
        collect(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), out);
    }
}

std::string sentence(const CLI::App& command, std::string_view what, const std::string& word,
                     const std::vector<std::string>& known, bool list) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    const std::string_view nearest = behaviour::nearest(word, names);
    std::string text = command.get_parent() == nullptr ? "" : command.get_name() + ": ";
    text += fmt::format("there is no {} '{}'", what, word);
    if (list) {
        text += fmt::format("; known: {}", fmt::join(known, " "));
    }
    if (!nearest.empty()) {
        text += fmt::format("; did you mean '{}'?", nearest);
    }
    return text;
}

/// The command that takes what `command` does not know, as the library has it; null for none.
const CLI::App* falls_through_to(const CLI::App& command) {
    const CLI::App* to = command.get_fallthrough() ? command.get_parent() : nullptr;
    while (to != nullptr && to->get_name().empty() && to->get_parent() != nullptr) {
        to = to->get_parent();
    }
    return to;
}

const CLI::Option* own_option(const CLI::App& command, const std::string& name) {
    if (const CLI::Option* const option = command.get_option_no_throw(name); option != nullptr) {
        return option;
    }
    for (const CLI::App* group : children(command, false)) {
        if (const CLI::Option* const option = own_option(*group, name); option != nullptr) {
            return option;
        }
    }
    return nullptr;
}

/// The option that `word` names, of this command or of one that it falls through to; null for none.
const CLI::Option* option_of(const CLI::App& command, std::string_view word) {
    const std::string name(word.substr(0, word.find('=')));
    for (const CLI::App* at = &command; at != nullptr; at = falls_through_to(*at)) {
        if (const CLI::Option* const option = own_option(*at, name); option != nullptr) {
            return option;
        }
    }
    return nullptr;
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::App* at = &command; at != nullptr; at = falls_through_to(*at)) {
        for (const DeclaredOption& option : declared_options(*at)) {
            known.insert(known.end(), option.names.begin(), option.names.end());
        }
    }
    return sentence(command, "option", word.substr(0, word.find('=')), known, false);
}

std::string unknown_command(const CLI::App& command, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::App* sub : commands_of(command)) {
        known.push_back(sub->get_name());
    }
    return sentence(command, "command", word, known, true);
}

/// `-5` is a number, and `-` standard input.
bool is_option(const std::string& word) {
    return word.starts_with("--") ||
           (word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

std::size_t count_positionals(const CLI::App& command) {
    const std::vector<DeclaredOption> options = declared_options(command);
    return static_cast<std::size_t>(std::count_if(
        options.begin(), options.end(), [](const DeclaredOption& option) { return option.names.empty(); }));
}

/// What the library says of a value that is not there and of a word too many, as the rest of the program
/// would.
std::string plainly(const std::string& what) {
    if (const std::size_t colon = what.find(": "), missing = what.rfind(" missing");
        colon != std::string::npos && missing == what.size() - std::string_view(" missing").size()) {
        const std::size_t value = what.find(" required ");
        return value == std::string::npos
                   ? what
                   : what.substr(0, colon) + " needs a value" +
                         what.substr(value + std::string_view(" required").size(),
                                     missing - value - std::string_view(" required").size());
    }
    for (const std::string_view many :
         {"The following argument was not expected: ", "The following arguments were not expected: "}) {
        if (what.starts_with(many)) {
            return "not expected: " + what.substr(many.size());
        }
    }
    return what;
}

}  // namespace

std::vector<std::string> DeclaredOption::choices() const {
    std::vector<std::string> words(1);
    for (const char c : type) {
        if (c == '|') {
            words.emplace_back();
        } else if (std::islower(static_cast<unsigned char>(c)) == 0) {
            return {};  // a placeholder, such as NAME
        } else {
            words.back() += c;
        }
    }
    return words.size() > 1 ? words : std::vector<std::string>{};
}

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
    return children(command, true);
}

const CLI::App* find_command(const CLI::App& command, std::string_view name) {
    for (const CLI::App* sub : commands_of(command)) {
        if (sub->get_name() == name) {
            return sub;
        }
    }
    return nullptr;
}

std::vector<std::string> option_names(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) {
        names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        names.push_back("--" + name);
    }
    return names;
}

std::string option_value(const CLI::Option& option) {
    if (option_names(option).empty() || option.get_items_expected_max() == 0) {
        return {};
    }
    return type_of(option);
}

std::string unknown_word(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    std::size_t positionals = count_positionals(app);  // which may come before a subcommand
    for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
        const std::string& word = words[i];
        if (is_option(word)) {
            const bool one_letter = word[1] != '-';  // behind which others, or its value, may stand
            const std::string name = one_letter ? word.substr(0, 2) : word;
            const CLI::Option* const option = option_of(*command, name);
            if (option == nullptr) {
                return unknown_option(*command, name);
            }
            const bool has_value = one_letter ? word.size() > 2 : word.find('=') != std::string::npos;
            i += option->get_items_expected_min() > 0 && !has_value ? 1U : 0U;
        } else if (word.starts_with('-') || commands_of(*command).empty()) {
            continue;  // the library's own business
        } else if (const CLI::App* const sub = find_command(*command, word); sub != nullptr) {
            command = sub;
            positionals = count_positionals(*sub);
        } else if (positionals != 0) {
            --positionals;
        } else {
            return unknown_command(*command, word);
        }
    }
    return {};
}

std::vector<DeclaredOption> declared_options(const CLI::App& command) {
    std::vector<DeclaredOption> out;
    for (const CLI::Option* option : command.get_options()) {
        out.push_back(describe(*option));
    }
    for (const CLI::App* group : children(command, false)) {
        for (DeclaredOption& option : declared_options(*group)) {  // each group has a --help of its own
            const bool again = std::any_of(out.begin(), out.end(), [&option](const DeclaredOption& known) {
                return !option.names.empty() && known.names == option.names;
            });
            if (!again) {
                out.push_back(std::move(option));
            }
        }
    }
    return out;
}

std::vector<DeclaredCommand> declared_commands(const CLI::App& app) {
    std::vector<DeclaredCommand> out;
    collect(app, {}, out);
    return out;
}

std::string wrong_use(const CLI::App& app, const std::string& what) {
    const CLI::App* command = &app;
    std::string path = app.get_name();
    for (auto parsed = app.get_subcommands(); !parsed.empty(); parsed = command->get_subcommands()) {
        command = parsed.front();
        path += " " + command->get_name();
    }
    std::string text = path + ": " + plainly(what);
    if (const auto below = commands_of(*command); what == "A subcommand is required" && !below.empty()) {
        std::vector<std::string> known;
        for (const CLI::App* sub : below) {
            known.push_back(sub->get_name());
        }
        text = fmt::format("{}: a command is missing; known: {}", path, fmt::join(known, " "));
    }
    return fmt::format("{}\nRun {} --help for more information.\n", text, path);
}

}  // namespace fauxboard::tools
