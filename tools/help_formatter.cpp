#include "tools/help_formatter.h"

#include <CLI/Option.hpp>

#include "tools/command_tree.h"

namespace fauxboard::tools {

std::string HelpFormatter::make_usage(const CLI::App* command, std::string) const {
    std::string path = command->get_name();
    for (const CLI::App* above = command->get_parent(); above != nullptr; above = above->get_parent()) {
        std::string words = above->get_name();
        for (const DeclaredOption& option : declared_options(*above)) {
            words += option.names.empty() && option.required ? " " + option.positional : "";
        }
        path = words + " " + path;
    }
    return Formatter::make_usage(command, path);
}

std::string HelpFormatter::make_option_name(const CLI::Option* option, bool is_positional) const {
    if (is_positional) {
        return option->get_name(true);
    }
    std::string text;
    for (const std::string& name : option_names(*option)) {
        text += (text.empty() ? "" : ",") + name;
    }
    return text;
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    std::string text;
    if (const std::string value = option_value(*option); !value.empty()) {
        text += (value.starts_with('[') ? "" : " ") + value;
    }
    if (!option->get_default_str().empty()) {
        text += " (default " + option->get_default_str() + ")";
    }
    if (option->get_required()) {
        text += " (required)";
    }
    return text;
}

}  // namespace fauxboard::tools
