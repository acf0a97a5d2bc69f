#pragma once

// What the two fuzz targets of the screens share.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/screen/screen_profile.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {

/// Finds the shipped screens, and nothing else.
inline behaviour::SourceFinder screen_finder() {
    return [](std::string_view name, std::string_view) -> std::optional<behaviour::SourceText> {
        const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
        });
        static std::map<std::string, std::string, std::less<>> read;
        if (!plain || name.size() > 64) {
            return std::nullopt;
        }
        const std::string file =
            std::string(FAUXBOARD_SOURCE_DIR "/profiles/screens/").append(name).append(".json");
        auto hit = read.find(name);
        if (hit == read.end()) {
            std::ifstream in(file, std::ios::binary);
            if (!in) {
                return std::nullopt;
            }
            hit = read.emplace(name, std::string(std::istreambuf_iterator<char>(in), {})).first;
        }
        return behaviour::SourceText{file, hit->second};
    };
}

/// A screen as shipped, by name. Read once.
inline std::shared_ptr<const screen::ScreenProfile> shipped_screen(std::string_view name) {
    static std::map<std::string, std::shared_ptr<const screen::ScreenProfile>, std::less<>> loaded;
    auto hit = loaded.find(name);
    if (hit == loaded.end()) {
        const auto source = screen_finder()(name, {});
        require(source.has_value(), "a shipped screen is missing");
        hit = loaded.emplace(name, screen::load_screen(*source, screen_finder())).first;
    }
    return hit->second;
}

}  // namespace fauxboard::fuzz
