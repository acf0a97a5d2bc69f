#include "tools/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "tools/command_tree.h"

namespace fauxboard::tools {
namespace {

/// Text as roff takes it: a backslash, a leading dot or quote, and a hyphen that is to be one.
std::string roff(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool starts = i == 0 || text[i - 1] == '\n';
        if (starts && (c == '.' || c == '\'')) {
            out += "\\&";
        }
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            out += c;
        }
    }
    return out;
}

std::string option_head(const DeclaredOption& option) {
    if (option.names.empty()) {
        return fmt::format("\\fI{}\\fR", roff(option.positional));
    }
    std::string out;
    for (const std::string& name : option.names) {
        out += fmt::format("{}\\fB{}\\fR", out.empty() ? "" : ", ", roff(name));
    }
    if (!option.value.empty()) {
        out += fmt::format("{}\\fI{}\\fR", option.value.starts_with('[') ? "" : " ", roff(option.value));
    }
    return out;
}

void synopsis(std::string& text, const std::string& program, const CLI::App& command) {
    fmt::format_to(std::back_inserter(text), ".SH SYNOPSIS\n\\fB{}\\fR [\\fIOPTION\\fR]...", roff(program));
    for (const DeclaredOption& option : declared_options(command)) {
        if (option.names.empty()) {
            const std::string name = "\\fI" + roff(option.positional) + "\\fR";
            text += option.required ? " " + name : " [" + name + "]";
        }
    }
    const bool commands = !commands_of(command).empty();
    text += commands ? " \\fICOMMAND\\fR ...\n" : "\n";
}

void options(std::string& text, const CLI::App& command) {
    for (const DeclaredOption& option : declared_options(command)) {
        fmt::format_to(std::back_inserter(text), ".TP\n{}\n{}\n", option_head(option), roff(option.help));
    }
}

/// What completes the value of an option: by what the help calls it.
std::string_view values_of(const DeclaredOption& option) {
    if (option.value == "NAME|FILE" || option.value == "NAME") {
        return "names";
    }
    if (option.value.find("FILE") != std::string::npos || option.value.find("PATH") != std::string::npos ||
        option.value.find("DIR") != std::string::npos || option.value.find("DEV") != std::string::npos) {
        return "files";
    }
    return option.value.empty() ? "none" : "words";
}

std::string bash_completion(const std::vector<DeclaredCommand>& commands) {
    std::string text =
        "# Completion of fauxboard for bash, made from its own declarations.\n"
        "_fauxboard() {\n"
        "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command= word i\n"
        "    for ((i = 1; i < COMP_CWORD; i++)); do\n"
        "        word=${COMP_WORDS[i]}\n"
        "        case \"$command $word\" in\n";
    for (const DeclaredCommand& command : commands) {
        if (!command.path.empty()) {
            const std::size_t space = command.path.rfind(' ');
            fmt::format_to(std::back_inserter(text), "            '{} {}') command='{}' ;;\n",
                           space == std::string::npos ? "" : command.path.substr(0, space),
                           space == std::string::npos ? command.path : command.path.substr(space + 1),
                           command.path);
        }
    }
    text +=
        "        esac\n"
        "    done\n"
        "    case \"$command $prev\" in\n";
    for (const DeclaredCommand& command : commands) {
        for (const DeclaredOption& option : command.options) {
            const std::string_view kind = values_of(option);
            for (const std::string& name : kind == "none" ? std::vector<std::string>{} : option.names) {
                fmt::format_to(
                    std::back_inserter(text), "        '{} {}') {}; return ;;\n", command.path, name,
                    kind == "names"
                        ? "COMPREPLY=($(compgen -f -W \"$(fauxboard profiles --names 2>/dev/null)\" "
                          "-- \"$cur\"))"
                    : kind == "files" ? "COMPREPLY=($(compgen -f -- \"$cur\"))"
                                      : "COMPREPLY=()");
            }
        }
    }
    text +=
        "    esac\n"
        "    case \"$command\" in\n";
    for (const DeclaredCommand& command : commands) {
        std::string words;
        for (const DeclaredCommand& sub : commands) {
            const std::string head = command.path.empty() ? "" : command.path + " ";
            if (!sub.path.empty() && sub.path.starts_with(head) &&
                sub.path.find(' ', head.size()) == std::string::npos) {
                words += sub.path.substr(head.size()) + " ";
            }
        }
        for (const DeclaredOption& option : command.options) {
            for (const std::string& name : option.names) {
                words += name + " ";
            }
        }
        fmt::format_to(std::back_inserter(text),
                       "        '{}') COMPREPLY=($(compgen -f -W '{}' -- \"$cur\")) ;;\n", command.path,
                       words);
    }
    return text +
           "    esac\n"
           "}\n"
           "complete -o filenames -F _fauxboard fauxboard\n";
}

/// A text between single quotes of zsh or fish, without what their option specs read as their own.
std::string quoted(std::string_view text, bool zsh) {
    std::string out;
    for (const char c : text) {
        if (c == '\'') {
            out += zsh ? "'\\''" : "\\'";
        } else if (zsh && (c == '[' || c == ']' || c == ':' || c == '\\')) {
            out += c == ':' || c == '\\' ? "\\" : "";
            out += c == '[' ? '(' : c == ']' ? ')' : c;
        } else {
            out += c == '\n' ? ' ' : c;
        }
    }
    return out;
}

void zsh_options(std::string& text, const DeclaredCommand& command) {
    text += "            _arguments -s";
    for (const DeclaredOption& option : command.options) {
        const std::string_view kind = values_of(option);
        for (const std::string& name : option.names) {
            fmt::format_to(std::back_inserter(text), " \\\n                '{}{}[{}]{}'", name,
                           option.value.starts_with('[') ? "=-" : "", quoted(option.help, true),
                           kind == "none"    ? ""
                           : kind == "names" ? ":name:_fauxboard_names"
                           : kind == "files" ? ":file:_files"
                                             : ":value:");
        }
    }
    text += " \\\n                '*:file:_files'\n";
}

std::string zsh_completion(const std::vector<DeclaredCommand>& commands) {
    std::string text =
        "#compdef fauxboard\n"
        "# Completion of fauxboard for zsh, made from its own declarations.\n"
        "_fauxboard_names() {\n"
        "    local -a names=(${(f)\"$(fauxboard profiles --names 2>/dev/null)\"})\n"
        "    _alternative \"names:name:(${names})\" 'files:file:_files'\n"
        "}\n"
        "_fauxboard() {\n"
        "    local -a commands=(\n";
    for (const DeclaredCommand& command : commands) {
        if (!command.path.empty() && command.path.find(' ') == std::string::npos) {
            fmt::format_to(std::back_inserter(text), "        '{}:{}'\n", command.path,
                           quoted(command.help, true));
        }
    }
    text +=
        "    )\n"
        "    if (( CURRENT == 2 )); then\n"
        "        _describe command commands\n"
        "        return\n"
        "    fi\n"
        "    local command=${words[2]}\n"
        "    [[ -n ${_fauxboard_nested[(r)$command ${words[3]}]} && CURRENT -gt 3 ]] && command+=\" "
        "${words[3]}\"\n"
        "    case \"$command\" in\n";
    std::string nested;
    for (const DeclaredCommand& command : commands) {
        if (command.path.empty()) {
            continue;
        }
        fmt::format_to(std::back_inserter(text), "        '{}')\n", command.path);
        zsh_options(text, command);
        text += "            ;;\n";
        if (command.path.find(' ') != std::string::npos) {
            nested += " '" + command.path + "'";
        }
    }
    return text + "    esac\n}\ntypeset -ga _fauxboard_nested=(" + nested + " )\n_fauxboard \"$@\"\n";
}

std::string fish_completion(const std::vector<DeclaredCommand>& commands) {
    std::string text =
        "# Completion of fauxboard for fish, made from its own declarations.\n"
        "complete -c fauxboard -n __fish_use_subcommand -f\n";
    for (const DeclaredCommand& command : commands) {
        const std::size_t space = command.path.find(' ');
        if (command.path.empty()) {
            continue;
        }
        const std::string condition =
            space == std::string::npos
                ? "__fish_use_subcommand"
                : fmt::format("__fish_seen_subcommand_from {}", command.path.substr(0, space));
        fmt::format_to(std::back_inserter(text), "complete -c fauxboard -n '{}' -a '{}' -d '{}'\n", condition,
                       space == std::string::npos ? command.path : command.path.substr(space + 1),
                       quoted(command.help, false));
        const std::string own = space == std::string::npos ? command.path : command.path.substr(space + 1);
        for (const DeclaredOption& option : command.options) {
            const std::string_view kind = values_of(option);
            for (const std::string& name : option.names) {
                fmt::format_to(std::back_inserter(text),
                               "complete -c fauxboard -n '__fish_seen_subcommand_from {}' {} {}{} -d '{}'\n",
                               own, name.starts_with("--") ? "-l" : "-s",
                               name.substr(name.starts_with("--") ? 2 : 1),
                               kind == "none"    ? ""
                               : kind == "names" ? " -r -a '(fauxboard profiles --names)'"
                                                 : " -r",
                               quoted(option.help, false));
            }
        }
    }
    return text;
}

}  // namespace

std::string man_page(const CLI::App& app, const CLI::App& command) {
    const bool whole = &app == &command;
    std::string name = app.get_name();
    if (!whole) {
        name += ' ' + (command.get_parent() != &app && command.get_parent() != nullptr
                           ? command.get_parent()->get_name() + ' ' + command.get_name()
                           : command.get_name());
    }
    std::string title = name;
    std::replace(title.begin(), title.end(), ' ', '-');
    std::string upper = title;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::string help = command.get_description();
    const std::string first = help.substr(0, help.find(':'));
    std::string text = fmt::format(".TH {} 1 \"\" \"fauxboard\"\n.SH NAME\n{} \\- {}\n", upper, roff(title),
                                   roff(whole ? "stands in for a 3D printer's control board" : first));
    synopsis(text, name, command);
    fmt::format_to(std::back_inserter(text), ".SH DESCRIPTION\n{}\n.SH OPTIONS\n", roff(help));
    options(text, command);
    const auto subs = commands_of(command);
    if (!subs.empty()) {
        text += ".SH COMMANDS\n";
        for (const CLI::App* sub : subs) {
            fmt::format_to(std::back_inserter(text), ".TP\n\\fB{}\\fR\n{}\n", roff(sub->get_name()),
                           roff(sub->get_description()));
            if (!whole) {
                text += ".RS\n";
                options(text, *sub);
                text += ".RE\n";
            }
        }
    }
    if (const std::string footer = command.get_footer(); !footer.empty()) {
        fmt::format_to(std::back_inserter(text), ".SH EXAMPLES AND EXIT CODES\n.nf\n{}\n.fi\n", roff(footer));
    }
    return text + fmt::format(".SH SEE ALSO\n{}\n",
                              whole ? "fauxboard\\-run(1), fauxboard\\-screen(1), fauxboard\\-ctl(1), "
                                      "fauxboard\\-describe(1)"
                                    : "fauxboard(1)");
}

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
