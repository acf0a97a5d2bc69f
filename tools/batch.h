#pragma once

#include <unistd.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/host/text_output.h"

namespace fauxboard::tools {

/// Text on its way to stdout, many lines at a time.
class Batch {
  public:
    ~Batch() { flush(); }
    Batch() = default;
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    /// False when nobody reads any more.
    bool add(std::string_view text, bool at_once = false) {
        text_ += text;
        return (!at_once && text_.size() < enough) || flush();
    }
    bool flush() { return text_.empty() || out_.write(std::exchange(text_, {})); }

  private:
    static constexpr std::size_t enough = 64U * 1024;
    host::TextOutput out_{STDOUT_FILENO, host::TextOutput::WhenFull::wait};
    std::string text_;
};

}  // namespace fauxboard::tools
