#pragma once

#include <stdexcept>

namespace fauxboard::link {

/// Something of this computer that the user named cannot be used: a folder, a file. what() is a full sentence
/// that says what to do about it.
class HostError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace fauxboard::link
