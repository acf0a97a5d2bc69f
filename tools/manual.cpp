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

}  // namespace fauxboard::tools
