#pragma once

// Private to this folder: the parts of a screen profile, read and compiled. What is wrong goes into the
// findings, and reading goes on.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/reader.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

struct Compiler {
    behaviour::Findings& findings;
    ScreenProfile& profile;
    /// Pages by path, known before any button is read.
    std::vector<std::string_view> page_paths;

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

  private:
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
