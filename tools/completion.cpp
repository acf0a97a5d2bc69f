// What bash, zsh and fish read to complete the command line, made from its own declarations.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "tools/command_tree.h"
#include "tools/manual.h"

namespace fauxboard::tools {
namespace {

/// How a value is completed: by what the help calls it.
struct Values {
    std::vector<std::string> words;
    bool names = false;  ///< of profiles, screens and scenarios
    bool files = false;
};

Values values_of(const DeclaredOption& option) {
    Values out{option.choices(), option.type.find("NAME") != std::string::npos, false};
    for (const std::string_view file : {"FILE", "PATH", "DIR", "DEV", "LINK"}) {
        out.files = out.files || option.type.find(file) != std::string::npos;
    }
    return out;
}

/// The names of the commands right below `command`.
std::vector<std::string> below(const std::vector<DeclaredCommand>& commands, const DeclaredCommand& command) {
    const std::string head = command.path.empty() ? "" : command.path + " ";
    std::vector<std::string> out;
    for (const DeclaredCommand& sub : commands) {
        if (sub.path.size() > head.size() && sub.path.starts_with(head) &&
            sub.path.find(' ', head.size()) == std::string::npos) {
            out.push_back(sub.path.substr(head.size()));
        }
    }
    return out;
}

/// All that may stand where a word of `command` is wanted, options aside.
Values positionals(const std::vector<DeclaredCommand>& commands, const DeclaredCommand& command) {
    Values out{below(commands, command), false, false};
    for (const DeclaredOption& option : command.options) {
        if (option.names.empty()) {
            const Values more = values_of(option);
            out.words.insert(out.words.end(), more.words.begin(), more.words.end());
            out.names = out.names || more.names;
            out.files = out.files || more.files;
        }
    }
    return out;
}

std::string parent_of(const std::string& path) {
    const std::size_t space = path.rfind(' ');
    return space == std::string::npos ? "" : path.substr(0, space);
}

std::string last_of(const std::string& path) {
    return path.substr(path.rfind(' ') + 1);
}

/// For bash and zsh: `command` becomes the path of commands among the `words`, a shell's expansion.
std::string path_loop(const std::vector<DeclaredCommand>& commands, std::string_view words) {
    std::string text = fmt::format(
        "    local command= word\n"
        "    for word in {}; do\n"
        "        case \"$command $word\" in\n",
        words);
    for (const DeclaredCommand& command : commands) {
        if (!command.path.empty()) {
            fmt::format_to(std::back_inserter(text), "            '{} {}') command='{}' ;;\n",
                           parent_of(command.path), last_of(command.path), command.path);
        }
    }
    return text + "        esac\n    done\n";
}

// bash

constexpr std::string_view bash_names = "$(fauxboard profiles --names 2>/dev/null)";

std::string bash_reply(const Values& values, const std::vector<std::string>& options) {
    std::string words = fmt::format("{}", fmt::join(values.words, " "));
    for (const std::string& option : options) {
        words += (words.empty() ? "" : " ") + option;
    }
    words += values.names ? (words.empty() ? "" : " ") + std::string(bash_names) : "";
    if (words.empty() && !values.files) {
        return "COMPREPLY=()";
    }
    return fmt::format("COMPREPLY=($(compgen{} -W \"{}\" -- \"$cur\"))", values.files ? " -f" : "", words);
}

std::string bash_completion(const std::vector<DeclaredCommand>& commands) {
    std::string text =
        "# Completion of fauxboard for bash, made from its own declarations.\n"
        "_fauxboard() {\n"
        "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n" +
        path_loop(commands, "\"${COMP_WORDS[@]:1:COMP_CWORD-1}\"") + "    case \"$command $prev\" in\n";
    for (const DeclaredCommand& command : commands) {
        for (const DeclaredOption& option : command.options) {
            for (const std::string& name : option.value.empty() ? std::vector<std::string>{} : option.names) {
                fmt::format_to(std::back_inserter(text), "        '{} {}') {}; return ;;\n", command.path,
                               name, bash_reply(values_of(option), {}));
            }
        }
    }
    text += "    esac\n    case \"$command\" in\n";
    for (const DeclaredCommand& command : commands) {
        std::vector<std::string> options;
        for (const DeclaredOption& option : command.options) {
            options.insert(options.end(), option.names.begin(), option.names.end());
        }
        fmt::format_to(std::back_inserter(text), "        '{}') {} ;;\n", command.path,
                       bash_reply(positionals(commands, command), options));
    }
    return text + "    esac\n}\ncomplete -o filenames -F _fauxboard fauxboard\n";
}

// zsh

/// A text between single quotes, without what zsh's option specs and descriptions read as their own.
std::string zsh_quoted(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '\'':
                out += "'\\''";
                break;
            case '[':
                out += '(';
                break;
            case ']':
                out += ')';
                break;
            case ':':
            case '\\':
                out += '\\';
                [[fallthrough]];
            default:
                out += c;
        }
    }
    return out;
}

/// What _arguments does for a value: an action of its own language.
std::string zsh_action(const Values& values) {
    if (values.names) {
        return "_fauxboard_names";
    }
    if (values.files && values.words.empty()) {
        return "_files";
    }
    return values.words.empty() ? "" : fmt::format("({})", fmt::join(values.words, " "));
}

void zsh_arguments(std::string& text, const std::vector<DeclaredCommand>& commands,
                   const DeclaredCommand& command) {
    text += "            _arguments -s";
    for (const DeclaredOption& option : command.options) {
        for (const std::string& name : option.names) {
            const std::string value =
                option.value.empty() ? ""
                                     : ":" + zsh_quoted(option.value) + ":" + zsh_action(values_of(option));
            fmt::format_to(std::back_inserter(text), " \\\n                '{}{}[{}]{}'", name,
                           option.value.starts_with('[') ? "=-" : "", zsh_quoted(option.help), value);
        }
    }
    const std::vector<std::string> subs = below(commands, command);
    Values values = positionals(commands, command);
    if (!subs.empty()) {  // a socket's path may stand before them, and is a file
        values.names = values.files = false;
        values.words = subs;
    }
    const std::string action = zsh_action(values);
    fmt::format_to(std::back_inserter(text), " \\\n                '*:word:{}'\n",
                   action.empty() ? "_fauxboard_none" : action);
}

std::string zsh_completion(const std::vector<DeclaredCommand>& commands) {
    std::string text =
        "#compdef fauxboard\n"
        "# Completion of fauxboard for zsh, made from its own declarations.\n"
        "_fauxboard_names() {\n"
        "    local -a names=(${(f)\"$(fauxboard profiles --names 2>/dev/null)\"})\n"
        "    _alternative \"names:name:(${names})\" 'files:file:_files'\n"
        "}\n"
        "_fauxboard_none() { return 1 }  # a word may stand there, and none is known\n"
        "_fauxboard() {\n"
        "    local -a commands=(\n";
    for (const DeclaredCommand& command : commands) {
        if (!command.path.empty() && parent_of(command.path).empty()) {
            fmt::format_to(std::back_inserter(text), "        '{}:{}'\n", command.path,
                           zsh_quoted(command.help));
        }
    }
    text += "    )\n" + path_loop(commands, "\"${(@)words[2,CURRENT-1]}\"") +
            "    case \"$command\" in\n"
            "        '')\n"
            "            _describe command commands\n"
            "            ;;\n";
    for (const DeclaredCommand& command : commands) {
        if (!command.path.empty()) {
            fmt::format_to(std::back_inserter(text), "        '{}')\n", command.path);
            zsh_arguments(text, commands, command);
            text += "            ;;\n";
        }
    }
    return text +
           "    esac\n}\n"
           "if [[ $funcstack[1] = _fauxboard ]]; then _fauxboard \"$@\"; else compdef _fauxboard fauxboard; "
           "fi\n";
}

// fish

std::string fish_quoted(std::string_view text) {
    std::string out;
    for (const char c : text) {
        out += c == '\'' || c == '\\' ? "\\" : "";
        out += c;
    }
    return out;
}

/// That all words of the path were typed, and none of the commands right below it.
std::string fish_condition(const std::vector<DeclaredCommand>& commands, const DeclaredCommand& command) {
    if (command.path.empty()) {
        return "__fish_use_subcommand";
    }
    std::string text;
    std::string path = command.path + " ";
    for (std::size_t space = 0; (space = path.find(' ')) != std::string::npos; path.erase(0, space + 1)) {
        text += (text.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + path.substr(0, space));
    }
    if (const auto subs = below(commands, command); !subs.empty()) {
        text += fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(subs, " "));
    }
    return text;
}

std::string fish_values(const Values& values) {
    std::string words = fmt::format("{}", fmt::join(values.words, " "));
    words += values.names
                 ? (words.empty() ? "" : " ") + std::string("(fauxboard profiles --names 2>/dev/null)")
                 : "";
    return (values.files ? " -F" : "") + (words.empty() ? std::string() : " -a '" + words + "'");
}

std::string fish_completion(const std::vector<DeclaredCommand>& commands) {
    std::string text =
        "# Completion of fauxboard for fish, made from its own declarations.\n"
        "complete -c fauxboard -f\n";
    for (const DeclaredCommand& command : commands) {
        const std::string head =
            fmt::format("complete -c fauxboard -n '{}'", fish_condition(commands, command));
        for (const DeclaredCommand& sub : commands) {
            if (!sub.path.empty() && parent_of(sub.path) == command.path) {
                fmt::format_to(std::back_inserter(text), "{} -a '{}' -d '{}'\n", head, last_of(sub.path),
                               fish_quoted(sub.help));
            }
        }
        for (const DeclaredOption& option : command.options) {
            const std::string value = option.value.empty() ? ""
                                                           : (option.value.starts_with('[') ? "" : " -r") +
                                                                 fish_values(values_of(option));
            if (option.names.empty()) {
                if (const std::string words = fish_values(values_of(option)); !words.empty()) {
                    text += head + words + "\n";
                }
            }
            for (const std::string& name : option.names) {
                const bool wordy = name.starts_with("--");
                fmt::format_to(std::back_inserter(text), "{} {} {}{} -d '{}'\n", head, wordy ? "-l" : "-s",
                               name.substr(wordy ? 2 : 1), value, fish_quoted(option.help));
            }
        }
    }
    return text;
}

}  // namespace

std::string completion(const CLI::App& app, Shell shell) {
    const std::vector<DeclaredCommand> commands = declared_commands(app);
    switch (shell) {
        case Shell::bash:
            return bash_completion(commands);
        case Shell::zsh:
            return zsh_completion(commands);
        case Shell::fish:
            break;
    }
    return fish_completion(commands);
}

}  // namespace fauxboard::tools
