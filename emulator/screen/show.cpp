// The pages as text.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/screen/screen.h"

namespace fauxboard::screen {
namespace {

constexpr std::size_t width = 78;

/// Columns of a UTF-8 text of narrow characters.
std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Words side by side, in as many lines as it takes.
std::string flow(const std::vector<std::string>& words) {
    std::string out;
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty() && columns(line) + 2 + columns(word) > width) {
            out += line + '\n';
            line.clear();
        }
        line += (line.empty() ? "" : "  ") + word;
    }
    return line.empty() ? out : out + line + '\n';
}

/// A label as it stands on the button; in round brackets when it leads to a page that stays shut.
void add_labels(const Standpoint& at, const Button& button, std::vector<std::string>& out) {
    const std::size_t rows = button.rows ? at.values[*button.rows].list.size() : 1;
    for (std::size_t row = 1; row <= rows; ++row) {
        if (!at.visible(button, row)) continue;
        const Scope scope = at.scope(button, row);
        const auto to = at.destination(button.leads_to, scope);
        const bool shut = to && !at.shut(*to).empty();
        out.push_back(
            fmt::format("{}{}{}", shut ? '(' : '[', button.label.render_for_people(scope), shut ? ')' : ']'));
    }
}

}  // namespace

std::string Screen::show_page(std::size_t id) const {
    const Page& page = profile_->pages[id];
    const Standpoint at{*profile_, values_, id, before_};
    const Scope scope{values_, 0, {}, 0};
    std::string out = page.title;
    out += page.title == page.path ? "\n" : fmt::format("  ({})\n", page.path);
    out += std::string(std::min(columns(out) - 1, width), '-') + '\n';
    for (const Template& line : page.shows) {
        out += line.render_for_people(scope) + '\n';
    }
    std::vector<std::string> own;
    std::vector<std::string> common;
    for (const std::size_t button : page.buttons) {
        const Button& one = profile_->buttons[button];
        add_labels(at, one, one.page == no_page ? common : own);
    }
    return out + flow(own) + flow(common);
}

std::string Screen::show(std::string_view path) const {
    if (const auto id = profile_->find_page(path)) {
        return show_page(*id);
    }
    std::vector<std::string_view> paths;
    for (const Page& page : profile_->pages) {
        paths.emplace_back(page.path);
    }
    const std::string_view near = behaviour::nearest(path, paths);
    return fmt::format("there is no page \"{}\"{}\n", printable(path),
                       near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

}  // namespace fauxboard::screen
