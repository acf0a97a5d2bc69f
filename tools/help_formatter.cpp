#include "tools/help_formatter.h"

#include <CLI/Option.hpp>

#include "tools/command_tree.h"

namespace fauxboard::tools {

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
