#pragma once

// Private to this folder: the parts of a screen profile, read and compiled. What is wrong goes into the
// findings, and reading goes on.

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/reader.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

/// The longest time that a screen waits for something.
inline constexpr double hour_ms = 3'600'000;

inline constexpr int box_button_width = 110;
inline constexpr int box_button_height = 36;
inline constexpr int box_button_gap = 19;

struct Compiler {
    behaviour::Findings& findings;
    ScreenProfile& profile;
    /// Pages by path, known before any button is read.
    std::vector<std::string_view> page_paths;
    /// Texts that stand somewhere, in the first language.
    std::set<std::string, std::less<>> translated{};

    // What stands under `key` of `reader`; nothing when it is absent.
    std::vector<Condition> conditions(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    std::vector<Assign> assigns(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    std::vector<Send> sends(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    std::vector<Target> targets(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    std::vector<Expectation> expectations(behaviour::ObjectReader& reader, std::string_view key,
                                          Allowed allowed);
    std::vector<Prepare> preparations(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    std::vector<std::string> texts(behaviour::ObjectReader& reader, std::string_view key);
    void time(behaviour::ObjectReader& reader, std::string_view key, SimTime& out, double min_ms,
              double max_ms);

    /// A declared value; reports an unknown one.
    std::optional<std::size_t> value(std::string_view name, const std::string& pointer);
    Template compile(std::string_view source, const std::string& pointer, Allowed allowed);

    // The large parts.
    void values(const behaviour::Json& node);
    void frames(const behaviour::Json& node);
    void talk(const behaviour::Json& node);
    void pages(const behaviour::Json& node);
    void everywhere(const behaviour::Json& node);

    // Of a board's own screen, in this order: what its texts need; then, with values and pages known, the
    // rest.
    void display_start(const behaviour::Json& node);
    void translations(const behaviour::Json& node);
    void looks_and_icons(const behaviour::Json& looks, const behaviour::Json& icons);
    void display_rest(const behaviour::Json& node);
    void display_idle(const behaviour::Json& node);
    void machine_events(const behaviour::Json& node);
    void boxes(const behaviour::Json& node);
    void check_translations();

  private:
    Expression expression(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    Deed::Argument argument(const behaviour::Json& node, const std::string& pointer, bool is_text,
                            Allowed allowed);
    void set_fields(const behaviour::Json& node, const std::string& pointer, Allowed allowed,
                    std::vector<Deed>& out);
    void deed(const std::string& name, const behaviour::Json& arguments, const std::string& pointer,
              Allowed allowed, std::vector<Deed>& out);
    std::vector<Deed> deeds(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    Effect effect(behaviour::ObjectReader& reader, Allowed allowed);
    Effects effects(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    Effects effects(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);

    std::optional<Color> color(const behaviour::Json& node, const std::string& pointer);
    std::optional<Color> color(behaviour::ObjectReader& reader, std::string_view key);
    Paints paints(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    Place place(behaviour::ObjectReader& reader, Allowed allowed);
    Words words(std::string_view source, const std::string& pointer, Allowed allowed);
    Words words(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    std::size_t named(behaviour::ObjectReader& reader, std::string_view key,
                      std::span<const std::string> names, std::string_view what);
    std::size_t icon_named(behaviour::ObjectReader& reader, std::string_view key);
    Figure figure(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    void text_keys(behaviour::ObjectReader& reader, Figure& out);
    void picture_keys(behaviour::ObjectReader& reader, Figure& out, Allowed allowed);
    std::vector<Figure> figures(behaviour::ObjectReader& reader, std::string_view key, Allowed allowed);
    ControlStyle look(const behaviour::Json& node, const std::string& pointer);
    Icon::Shape shape(const behaviour::Json& node, const std::string& pointer);
    Icon icon(const std::string& name, const behaviour::Json& node, const std::string& pointer);

    void key(behaviour::ObjectReader& reader, Control& out);
    void control(Button& button, behaviour::ObjectReader& reader, const std::string& pointer,
                 Allowed allowed);
    void entry(behaviour::ObjectReader& reader, PageFace& out);
    void page_face(Page& page, behaviour::ObjectReader& reader);
    void box(std::size_t id, const behaviour::Json& node, const std::string& pointer);
    void box_button(std::size_t page, std::string_view name, std::string_view key, int number, int of,
                    behaviour::ObjectReader& reader);

    std::optional<Condition> condition(const std::string& left, const behaviour::Json& right,
                                       const std::string& pointer, Allowed allowed);
    std::optional<Send> send(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    std::optional<Target> target(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    Expectation expectation(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    Prepare preparation(const behaviour::Json& node, const std::string& pointer, Allowed allowed);
    std::string line_text(behaviour::ObjectReader& reader, std::string_view key);
    void check_frame_name(const std::string& name, const std::string& pointer);
    ValueInfo value_info(const std::string& name, const behaviour::Json& node, const std::string& pointer);
    void value_names(behaviour::ObjectReader& reader, ValueInfo& info);
    FrameRule frame(const std::string& name, const behaviour::Json& node, const std::string& pointer);
    FrameCase frame_case(behaviour::ObjectReader& reader);
    void case_verdict(behaviour::ObjectReader& reader, FrameCase& out);
    TalkRules::Poll poll(const behaviour::Json& node, const std::string& pointer);
    std::vector<Read> reads(behaviour::ObjectReader& reader, std::string_view key, int depth);
    Read read(const behaviour::Json& node, const std::string& pointer, int depth);
    void read_bounds(behaviour::ObjectReader& reader, Read& out);
    void check_read(const Read& out, const std::string& pointer, bool& wants_into);
    void line_page(Page& out, behaviour::ObjectReader& reader);
    void page(std::size_t id, const behaviour::Json& node, const std::string& pointer);
    void button(std::size_t page, const std::string& name, const behaviour::Json& node,
                const std::string& pointer);
};

/// Calls `take(item, pointer)` for a value, or for each item where it is an array.
template <class Take>
void for_each_item(const behaviour::Json& node, const std::string& pointer, Take&& take) {
    if (!node.is_array()) {
        take(node, pointer);
        return;
    }
    for (std::size_t i = 0; i < node.size(); ++i) {
        take(node[i], pointer + "/" + std::to_string(i));
    }
}

}  // namespace fauxboard::screen
