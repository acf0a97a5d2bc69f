#pragma once

// What the screen that a board has of its own needs beyond one that hangs on a line: places in pixels, looks
// and drawings, two languages, and effects on the board itself. All of it is data of the screen's profile.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/machine/events.h"
#include "emulator/machine/sim_time.h"
#include "emulator/screen/expression.h"

namespace fauxboard::screen {

using machine::SimTime;

inline constexpr std::size_t no_page = static_cast<std::size_t>(-1);

using Color = std::uint32_t;  ///< 0xRRGGBB

struct Rect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    /// A touch on an edge pixel counts as inside.
    bool contains(int px, int py) const { return px >= x && px < x + width && py >= y && py < y + height; }
};

/// A rectangle in pixels, origin top left.
struct Place {
    std::array<Expression, 4> parts;  ///< x, y, width, height

    Rect evaluate(const Scope& scope) const;
};

/// A text in each of the screen's languages.
struct Words {
    std::vector<Template> by_language;

    bool empty() const { return by_language.empty(); }
    const Template& in(std::size_t language) const {
        return by_language[language < by_language.size() ? language : 0];
    }
};

/// A colour that may depend on what is shown: the first whose conditions hold.
struct Paint {
    std::vector<Condition> when;
    Color color = 0;
};
using Paints = std::vector<Paint>;

enum class Align : std::uint8_t { left, center, right };

/// One thing drawn on a page, or on a control (then its place counts from the control's corner).
struct Figure {
    enum class Kind : std::uint8_t { fill, frame, text, icon, picture };
    Kind kind = Kind::fill;
    std::vector<Condition> when;
    Place at;
    Paints paints;  ///< of a control's text, when empty: as the control's look says
    Words text;
    double size = 16;  ///< of the text, pixels from line to line
    Align align = Align::left;
    unsigned lines = 1;    ///< a longer text is broken into so many
    bool cut = false;      ///< a text that is too long ends in "..."; else it is squeezed
    std::size_t icon = 0;  ///< of Display::icons
    std::string picture;   ///< a picture of the machine's
    Expression index;      ///< which of them, where there are several
    bool whole = true;     ///< fitted into the place, aspect kept; else each pixel `step` of the picture's
    int step = 1;
    bool turned = false;  ///< rows of the picture become columns, from left to right
};

/// How a kind of control looks.
struct ControlStyle {
    std::optional<Color> fill;
    std::optional<Color> frame;
    std::optional<Color> pressed_fill;
    Color text = 0;
    Color pressed_text = 0;
    Color disabled_text = 0x404040;
    double size = 18;       ///< of its label
    int radius = 0;         ///< of its corners
    bool vanishes = false;  ///< when it is disabled
    unsigned lines = 1;     ///< of its label
    Align align = Align::center;
    int margin = 4;  ///< between its edge and its label
};

/// A drawing of polygons, in units of its own.
struct Icon {
    struct Point {
        double x = 0;
        double y = 0;
    };
    struct Shape {
        std::vector<std::vector<Point>> outlines;  ///< what lies within an odd number of them is filled
        std::optional<Color> color;                ///< else that of whoever draws it
    };
    std::string name;
    double width = 0;
    double height = 0;
    std::vector<Shape> shapes;
};

/// What a touch, a page or an event leads to.
struct Target {
    enum class Where : std::uint8_t { page, back, before, close };
    std::vector<Condition> when;
    Where where = Where::page;
    std::size_t page = no_page;
};

/// One action on the machine: a row of behaviour::actions(), or a field that is set.
struct Deed {
    struct Argument {
        bool given = false;
        bool is_text = false;
        Template text;
        Expression number;
    };
    const behaviour::ActionInfo* action = nullptr;
    const behaviour::Field* field = nullptr;
    std::vector<Argument> arguments;  ///< one for each of the action; one for a field
};

/// What comes of a touch or an event. Of several the first whose conditions hold.
struct Effect {
    std::vector<Condition> when;
    std::vector<Assign> assume;  ///< all from the values as they were
    std::vector<Deed> deeds;     ///< then, with the values as they are now
    std::vector<Target> leads_to;
    bool uncovers = false;     ///< what hides the page goes: a screensaver
    SimTime idle_at_least{0};  ///< the next fall into idleness comes no sooner
};
using Effects = std::vector<Effect>;

/// Keys of a page on which a number is typed.
enum class EntryKey : std::uint8_t { digit, dot, erase, clear, sign };

/// A control: where it stands and what it does.
struct Control {
    Place at;
    std::size_t look = 0;
    Words label;
    std::optional<std::size_t> icon;
    Paints icon_paints;
    std::vector<Condition> enabled;
    std::vector<Figure> draw;
    Effects touch;
    Effects hold;  ///< held so long: `hold_after`
    SimTime hold_after{0};
    std::optional<EntryKey> key;
    char digit = '0';
    unsigned slots = 0;  ///< of a control with rows: so many places, filled from the list or empty
    Expression first;    ///< rows before the first place
};

/// A message box: everything about it but its buttons, which are the page's.
struct BoxFace {
    Words caption;
    Words text;  ///< lines, each ended by \n
};

/// Number entry: a text that grows key by key.
struct Entry {
    std::size_t text = 0;    ///< value: what stands in the display
    std::size_t number = 0;  ///< value: the same as a number
    Expression start;        ///< when the page opens
    Expression decimals;     ///< of it; 0: a whole number
    std::size_t most = 10;   ///< characters
};

/// A page of a board's own screen.
struct PageFace {
    enum class Kind : std::uint8_t { page, box, cover };
    Kind kind = Kind::page;
    Words title;
    std::optional<Color> background;  ///< else the display's
    bool bare = false;                ///< without the display's own drawing
    std::vector<Figure> draw;
    Effects on_open;
    Effects on_close;
    std::optional<BoxFace> box;
    std::optional<Entry> entry;
};

/// How a finger is felt. Sources: the firmware's own timing.
struct Finger {
    SimTime tick{16'000};       ///< between two looks at the sensor
    unsigned press_ticks = 4;   ///< with contact in a row: a press
    SimTime look{25'000};       ///< between two looks of the page at what was pressed
    unsigned long_ticks = 100;  ///< after the press: nothing comes of the release any more
};

/// The screen of a board's own.
struct Display {
    int width = 0;
    int height = 0;
    Color background = 0xFFFFFF;
    std::vector<Figure> draw;    ///< on every page, below all else: the title's place
    Figure title;                ///< how a page's title is drawn; its text is left out
    ControlStyle box;            ///< of message boxes: body and text
    ControlStyle caption;        ///< of their captions
    std::size_t box_button = 0;  ///< look
    std::vector<std::string> languages;
    Expression language;
    Expression rotated;  ///< not 0: turned by 180 degrees, with the touches
    Finger finger;
    std::optional<std::size_t> touch_x;  ///< values that hold where the finger is, or was; 0: nowhere yet
    std::optional<std::size_t> touch_y;
    std::vector<Expression> felt;  ///< x and y at which the program takes it to be; none: where it is
    std::vector<ControlStyle> looks;
    std::vector<std::string> look_names;
    std::vector<Icon> icons;
    std::vector<Dictionary> dictionaries;  ///< one for each language; the first is empty
    Effects power_on;
    Effects press;  ///< of an enabled control
    std::map<machine::EventId, Effects> events;
    Expression idle_ms;                    ///< 0: never
    std::vector<std::size_t> idle_values;  ///< that it looks at
    Effects idle;
};

}  // namespace fauxboard::screen
