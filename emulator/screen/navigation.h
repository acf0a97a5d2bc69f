#pragma once

// Finding a button by what a person writes, and the way to it through the pages.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

/// What a path means.
struct Resolved {
    std::optional<std::size_t> button;
    std::size_t row = 0;  ///< of a button with rows; 0: the first that is there
    std::optional<double> input;
    std::string sentence;  ///< why there is no button: the nearest names, or the candidates
};

/// A path is the whole of a button's path, or the end of it from a slash on. "=5" behind it is the number
/// typed in. A button with rows takes "File 2", or the entry as it stands in the list. Small and capital
/// letters count only where they tell buttons apart. Of several the one on `page` is meant.
Resolved resolve(const ScreenProfile& profile, std::span<const Shown> values, std::size_t page,
                 std::string_view path);

/// Buttons whose name ends with this word as well, though only `button` has it for a name: a person who
/// writes "on" may have meant "Sound on".
std::vector<std::string> also_ending(const ScreenProfile& profile, std::size_t button, std::string_view word);

/// What the path of a page means: the whole of it or its end from a slash on, small or capital.
struct ResolvedPage {
    std::optional<std::size_t> page;
    std::string sentence;  ///< why there is none: the nearest, or the candidates
};
ResolvedPage resolve_page(const ScreenProfile& profile, std::string_view path);

/// One touch.
struct Step {
    std::size_t button = 0;
    std::size_t row = 0;
};

/// Where a screen stands: what decides which buttons are there and where they lead.
struct Standpoint {
    const ScreenProfile& profile;
    std::span<const Shown> values;
    std::size_t page = 0;
    std::size_t before = 0;  ///< the page that was open before this one

    /// The scope of a button's expressions.
    Scope scope(const Button& button, std::size_t row, double input = 0) const;
    /// Of a control with rows: the one in its first place.
    std::size_t first_row(const Button& button) const;
    /// The row to press: `row` itself if it is there, the first that is there for 0; nothing when none is. 1
    /// for a button without rows that is there.
    std::optional<std::size_t> visible(const Button& button, std::size_t row = 0) const;
    /// The page the first of `targets` whose conditions hold leads to.
    std::optional<std::size_t> destination(const std::vector<Target>& targets, const Scope& scope) const;
    /// "" when the page may be opened now, else why not.
    std::string shut(std::size_t page_id) const;
    /// Why the button is not there; "" when it is.
    std::string hidden(const Button& button, std::size_t row) const;
};

/// The touches that lead from where the screen stands to a page with this button, those that send least
/// first. Nothing when there is no way now.
std::optional<std::vector<Step>> find_route(const Standpoint& from, std::size_t button, std::size_t row);

/// The same to a page. Empty when it is open already.
std::optional<std::vector<Step>> find_route_to_page(const Standpoint& from, std::size_t page);

/// What keeps a way shut.
struct Obstacle {
    std::string why;
    bool hidden = false;  ///< a button that the screen would show, were its values others
};

/// Why find_route() found nothing.
Obstacle find_obstacle(const Standpoint& from, std::size_t button, std::size_t row);

}  // namespace fauxboard::screen
