#pragma once

// A small profile to try things on, for tests that want no shipped one.

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/behaviour/profile.h"

namespace fauxboard::testing {

/// Finds sources in a map: name -> text.
inline behaviour::SourceFinder finder_in(std::map<std::string, std::string, std::less<>> files) {
    return [files = std::move(files)](std::string_view name,
                                      std::string_view) -> std::optional<behaviour::SourceText> {
        const auto hit = files.find(name);
        if (hit == files.end()) {
            return std::nullopt;
        }
        return behaviour::SourceText{hit->first, hit->second};
    };
}

inline constexpr std::string_view small_base = R"({
  "name": "small-base",
  "protocol": "smartto",
  "variables": { "count": { "value": 1, "min": 0, "max": 10, "help": "to count with" } },
  "machine": {
    "thermal": { "printed": "true" },
    "motion": {
      "volume_mm": [200, 200, 200],
      "power_on_position_mm": [10, 10, 10],
      "procedures": {
        "home": [ { "zero": "xyz" }, { "home": "xyz" }, { "homed": "xyz" }, { "raise": "motion.homed" } ],
        "home_x": [ { "home": "x" }, { "homed": "x" }, { "raise": "motion.axis_homed" } ],
        "level_start": [ { "to": { "z": 8 }, "feed_mm_s": 10 } ],
        "park": [ { "to": { "x": 0, "y": 190 }, "feed_mm_s": 100 } ]
      }
    },
    "card": { "entries": [ { "file": "a.gcode", "lines": [ "G28" ] },
                           { "folder": "sub", "entries": [ { "file": "b.gcode", "lines": [ "G28" ] } ] } ] }
  },
  "frames": { "L1": "L1 X{position.x:.3f}" }
})";

/// small_base with `over` put on top of it.
inline std::shared_ptr<const behaviour::Profile> small_profile(std::string_view over = "{}") {
    std::string text(over);
    text.insert(text.find('{') + 1, std::string(R"("name": "small", "extends": "small-base")") +
                                        (text.find(':') == std::string::npos ? "" : ","));
    return behaviour::load_profile({"small.json", text},
                                   finder_in({{"small-base", std::string(small_base)}}));
}

/// A profile that says nothing but the kind of its machine, and `more` of it.
inline std::shared_ptr<const behaviour::Profile> bare_profile(std::string_view kind,
                                                              std::string_view more = "") {
    return behaviour::load_profile(
        {"bare.json", R"({ "name": "bare", "protocol": "gcode", "frames": {}, "machine": { "kind": ")" +
                          std::string(kind) + "\"" + std::string(more) + " } }"},
        finder_in({}));
}

}  // namespace fauxboard::testing
