// The pages as text.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/screen/page_view.h"
#include "emulator/screen/screen.h"

namespace fauxboard::screen {
namespace {

constexpr std::size_t width = 78;

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

}  // namespace

std::string Screen::show_page(std::size_t id) const {
    const PageView view = view_page({*profile_, values_, id, before_});
    std::string out = view.title;
    out += view.title == view.path ? "\n" : fmt::format("  ({})\n", view.path);
    out += std::string(std::min(columns(out) - 1, width), '-') + '\n';
    for (const std::string& line : view.lines) {
        out += line + '\n';
    }
    std::vector<std::string> own;
    std::vector<std::string> common;
    for (const ButtonView& button : view.buttons) {
        // In round brackets when it leads to a page that stays shut.
        (button.everywhere ? common : own)
            .push_back(button.shut.empty() ? '[' + button.label + ']' : '(' + button.label + ')');
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
