#pragma once

// What a page shows, taken apart: for text, for JSON, for a terminal to draw.

#include <optional>
#include <string>
#include <vector>

#include "emulator/screen/navigation.h"

namespace fauxboard::screen {

/// A button as it stands on the page.
struct ButtonView {
    std::size_t button = 0;
    std::size_t row = 0;         ///< 1 for a button without rows
    std::string label;           ///< UTF-8 without control bytes
    std::string shut;            ///< why it leads nowhere now; empty when it does
    bool everywhere = false;     ///< stands on every page
    std::optional<Input> input;  ///< it asks for a number
};

struct PageView {
    std::size_t page = 0;
    std::string path;
    std::string title;
    std::vector<std::string> lines;   ///< values in words, as they stand on the page
    std::vector<ButtonView> buttons;  ///< those that are there now, the page's own first
};

/// The page `at` stands on.
PageView view_page(const Standpoint& at);

/// The values that the page shows, its rows included, each once.
std::vector<std::size_t> shown_values(const ScreenProfile& profile, std::size_t page);

/// Columns of a UTF-8 text of narrow characters.
std::size_t columns(std::string_view text);

}  // namespace fauxboard::screen
