#include "emulator/screen/page_view.h"

#include <algorithm>

namespace fauxboard::screen {
namespace {

void add_views(const Standpoint& at, std::size_t id, std::vector<ButtonView>& out) {
    const Button& button = at.profile.buttons[id];
    const std::size_t rows = button.rows ? at.values[*button.rows].list.size() : 1;
    for (std::size_t row = 1; row <= rows; ++row) {
        if (!at.visible(button, row)) continue;
        const Scope scope = at.scope(button, row);
        const auto to = at.destination(button.leads_to, scope);
        out.push_back({id, row, button.label.render_for_people(scope), to ? at.shut(*to) : std::string{},
                       button.page == no_page, button.input});
    }
}

}  // namespace

PageView view_page(const Standpoint& at) {
    const Page& page = at.profile.pages[at.page];
    PageView out;
    out.page = at.page;
    out.path = page.path;
    out.title = page.title;
    const Scope scope{at.values, 0, {}, 0};
    for (const Template& line : page.shows) {
        out.lines.push_back(line.render_for_people(scope));
    }
    for (const std::size_t id : page.buttons) {
        add_views(at, id, out.buttons);
    }
    std::stable_partition(out.buttons.begin(), out.buttons.end(),
                          [](const ButtonView& view) { return !view.everywhere; });
    return out;
}

std::vector<std::size_t> shown_values(const ScreenProfile& profile, std::size_t page) {
    std::vector<std::size_t> out;
    const auto add = [&](std::size_t value) {
        if (std::find(out.begin(), out.end(), value) == out.end()) out.push_back(value);
    };
    for (const Template& line : profile.pages[page].shows) {
        std::for_each(line.values().begin(), line.values().end(), add);
    }
    for (const std::size_t id : profile.pages[page].buttons) {
        if (profile.buttons[id].rows) add(*profile.buttons[id].rows);
    }
    return out;
}

std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace fauxboard::screen
