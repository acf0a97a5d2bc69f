#pragma once

// Where on a terminal what stands: a page as rows of cells with boxes to hit. No terminal here.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/screen/page_view.h"

namespace fauxboard::screen {

inline constexpr int least_columns = 80;
inline constexpr int least_rows = 24;

/// What a text is, for whoever gives it a colour.
enum class Ink : std::uint8_t {
    plain,
    title,
    frame,
    label,
    shut,     ///< a button that leads nowhere now
    focus,    ///< the button that Enter presses
    hot,      ///< the letter that presses a button
    sent,     ///< said by the screen
    came,     ///< said by the board
    warning,  ///< what a real screen would not have taken as it was meant
    hint,
    status,
};

/// A piece of text within one row of cells. UTF-8 of narrow characters; later ones lie on top.
struct Run {
    int x = 0;
    int y = 0;
    std::string text;
    Ink ink = Ink::plain;
};

struct Box {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    bool contains(int column, int row) const {
        return column >= x && column < x + width && row >= y && row < y + height;
    }
};

/// A button to hit; the same index as in PageView::buttons.
struct Spot {
    Box box;
    bool visible = true;  ///< not scrolled away
    char hot = '\0';      ///< a small letter or a digit; '\0': none left for it
};

struct TalkLine {
    Ink ink = Ink::plain;
    std::string text;  ///< printable
};

/// What the person at the terminal has done to the view.
struct Look {
    std::string screen;                ///< its name
    std::size_t focus = 0;             ///< index of a button
    std::optional<std::string> entry;  ///< what has been typed into the focused button so far
    std::size_t talk_back = 0;         ///< lines of the talk scrolled back
    std::string status;                ///< says more than the usual hint; may be empty
};

struct Layout {
    int columns = 0;
    int rows = 0;
    std::vector<Run> runs;
    std::vector<Spot> spots;
    bool too_small = false;
    int talk_rows = 0;  ///< room for the talk

    /// The index of the button at a cell.
    std::optional<std::size_t> hit(int column, int row) const;
    /// The cells as text, a line each: for tests, and for whoever has no terminal.
    std::string text() const;
};

/// Title bar, values, buttons, the talk on the line, status. Buttons are boxes of three rows where they all
/// fit, else of one; what still does not fit is scrolled to where the focus is.
Layout lay_out(const PageView& view, const Look& look, std::span<const TalkLine> talk, int columns, int rows);

}  // namespace fauxboard::screen
