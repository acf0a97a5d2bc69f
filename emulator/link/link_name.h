#pragma once

// Internal to emulator/link.

#include <string>

namespace fauxboard::link {

/// A symlink of the user's choice to a pseudo-terminal, for as long as this object holds it.
class LinkName {
  public:
    LinkName() = default;
    LinkName(const LinkName&) = delete;
    LinkName& operator=(const LinkName&) = delete;
    ~LinkName() { remove(); }

    /// Makes the symlink `name` -> `target`. It never passes through a state where the name is missing or
    /// half made. An existing `name` is taken over only if it is a symlink to nowhere, or to `target` (left
    /// by a program that was killed); else LinkError.
    void create(const std::string& name, const std::string& target);
    /// Idempotent. Leaves a name alone that somebody has turned elsewhere meanwhile.
    void remove() noexcept;

  private:
    std::string name_;
    std::string target_;
};

}  // namespace fauxboard::link
