#pragma once

#include <cstdint>
#include <string_view>

namespace fauxboard::behaviour {

enum class Level : std::uint8_t { debug, info, warning, error };

/// Takes what a person wants to know: a clamped value, an unknown code. Must not call back.
class NoticeSink {
  public:
    virtual ~NoticeSink() = default;
    virtual void notice(Level level, std::string_view text) = 0;
};

}  // namespace fauxboard::behaviour
