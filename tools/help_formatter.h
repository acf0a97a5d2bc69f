#pragma once

#include <CLI/Formatter.hpp>
#include <string>

namespace fauxboard::tools {

/// The library's help, less what only the library needs: default values of flags, counts, lists of what is
/// valid behind a type that names them already.
class HelpFormatter : public CLI::Formatter {
  public:
    /// With what the commands above it want before its name: `fauxboard ctl PATH get`.
    std::string make_usage(const CLI::App* command, std::string name) const override;
    std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace fauxboard::tools
