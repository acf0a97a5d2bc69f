#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace fauxboard::tools {

/// What of a profile that changes while its board runs has to wait.
class ProfileChanges {
  public:
    /// Remembers how it stands now, with all that it extends.
    explicit ProfileChanges(std::string profile);
    /// Of what has changed: "" or "; boot at the board's next start; machine, identity at the next start of
    /// this program".
    std::string what_waits();

  private:
    nlohmann::ordered_json read() const;

    std::string profile_;
    nlohmann::ordered_json at_start_;  ///< of this program
    nlohmann::ordered_json before_;    ///< the last change
};

}  // namespace fauxboard::tools
