#pragma once

#include <string_view>

namespace fauxboard::machine {

/// A command under way, for whoever carries it out.
class BegunCommand {
  public:
    virtual ~BegunCommand() = default;
    /// As the machine's own codes say; false when it has no such code, or one that wants a rule of the
    /// profile
    /// (`by_rule`) and there is none.
    virtual bool run_code(bool by_rule) = 0;
};

/// Who carries out commands of a file by rules of its own.
class FileCommands {
  public:
    virtual ~FileCommands() = default;
    /// False: it has none for this code.
    virtual bool carry_out(std::string_view command, char letter, int code) = 0;
};

struct Commands {
    BegunCommand* begun = nullptr;     ///< what is being carried out
    FileCommands* of_files = nullptr;  ///< asked before the machine's own codes
};

}  // namespace fauxboard::machine
