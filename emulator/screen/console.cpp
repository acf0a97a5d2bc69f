#include "emulator/screen/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

namespace fauxboard::screen {
namespace {

constexpr std::size_t most_talk = 500;
constexpr std::size_t most_typed = 12;

bool quits(char key) {
    return key == 'q' || key == 'Q';
}

}  // namespace

void Console::resize(int columns, int rows) {
    columns_ = columns;
    rows_ = rows;
}

void Console::show(PageView view) {
    std::size_t focus = 0;
    if (view.page == view_.page && look_.focus < view_.buttons.size()) {
        const ButtonView& old = view_.buttons[look_.focus];
        const auto same = std::find_if(view.buttons.begin(), view.buttons.end(), [&](const ButtonView& one) {
            return one.button == old.button && one.row == old.row;
        });
        if (same != view.buttons.end()) {
            focus = static_cast<std::size_t>(same - view.buttons.begin());
        } else {
            look_.entry.reset();
        }
    } else {
        look_.entry.reset();
    }
    view_ = std::move(view);
    look_.focus = focus;
}

void Console::add_talk(TalkLine line) {
    talk_.push_back(std::move(line));
    if (talk_.size() > most_talk) {
        talk_.pop_front();
    }
    if (look_.talk_back != 0 && look_.talk_back < talk_.size()) {
        ++look_.talk_back;  // what is being read stays where it is
    }
}

Layout Console::layout() const {
    const std::vector<TalkLine> talk(talk_.begin(), talk_.end());
    return lay_out(view_, look_, talk, columns_, rows_);
}

Reaction Console::press(const Key& key) {
    look_.status.clear();
    const Layout now = layout();
    if (now.too_small) {
        return {key.kind == Key::Kind::character && quits(key.character), std::nullopt};
    }
    if (key.kind == Key::Kind::click) {
        const auto hit = now.hit(key.x, key.y);
        look_.entry.reset();
        return hit ? press_button(*hit) : Reaction{};
    }
    if (look_.entry) {
        return type(key);
    }
    switch (key.kind) {
        case Key::Kind::character:
            return press_hot(key.character);
        case Key::Kind::enter:
            return press_button(look_.focus);
        case Key::Kind::tab:
        case Key::Kind::back_tab:
            step(key.kind == Key::Kind::tab);
            break;
        case Key::Kind::up:
        case Key::Kind::down:
            move(0, key.kind == Key::Kind::up ? -1 : 1);
            break;
        case Key::Kind::left:
        case Key::Kind::right:
            move(key.kind == Key::Kind::left ? -1 : 1, 0);
            break;
        case Key::Kind::page_up:
        case Key::Kind::page_down:
            scroll_talk(key.kind == Key::Kind::page_up);
            break;
        case Key::Kind::escape:
        case Key::Kind::backspace:
        case Key::Kind::click:
            break;
    }
    return {};
}

Reaction Console::press_hot(char key) {
    if (quits(key)) {
        return {true, std::nullopt};
    }
    if (key == ' ') {
        return press_button(look_.focus);
    }
    const char small = key >= 'A' && key <= 'Z' ? static_cast<char>(key - 'A' + 'a') : key;
    const Layout now = layout();
    for (std::size_t i = 0; i < now.spots.size(); ++i) {
        if (now.spots[i].hot != '\0' && now.spots[i].hot == small) {
            return press_button(i);
        }
    }
    return {};
}

Reaction Console::press_button(std::size_t index) {
    if (index >= view_.buttons.size()) {
        return {};
    }
    look_.focus = index;
    const ButtonView& button = view_.buttons[index];
    if (button.input) {
        look_.entry = std::string();
        return {};
    }
    return {false, Touch{button.button, button.row, std::nullopt}};
}

Reaction Console::type(const Key& key) {
    std::string& text = *look_.entry;
    if (key.kind == Key::Kind::enter) {
        return send_entry();
    }
    if (key.kind == Key::Kind::escape) {
        look_.entry.reset();
    } else if (key.kind == Key::Kind::backspace) {
        if (!text.empty()) text.pop_back();
    } else if (key.kind == Key::Kind::character) {
        const bool fits = (key.character >= '0' && key.character <= '9') || key.character == '.' ||
                          (key.character == '-' && text.empty());
        if (!fits) {
            look_.status = "digits, please; Esc leaves it";
        } else if (text.size() < most_typed) {
            text += key.character;
        }
    }
    return {};
}

Reaction Console::send_entry() {
    const ButtonView& button = view_.buttons[look_.focus];
    const std::string& text = *look_.entry;
    double number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) {
        look_.status = "that is no number";
        return {};
    }
    if (number < button.input->min || number > button.input->max) {
        look_.status = fmt::format("from {} to {}, please", short_text(button.input->min),
                                   short_text(button.input->max));
        return {};
    }
    look_.entry.reset();
    return {false, Touch{button.button, button.row, number}};
}

void Console::step(bool forward) {
    if (const std::size_t count = view_.buttons.size(); count != 0) {
        look_.focus = (look_.focus + (forward ? 1 : count - 1)) % count;
    }
}

/// To the nearest button in that direction: rows apart count more than columns.
void Console::move(int dx, int dy) {
    const Layout now = layout();
    if (look_.focus >= now.spots.size()) {
        return;
    }
    const auto middle = [](const Box& box) { return box.x + box.width / 2; };
    const Box from = now.spots[look_.focus].box;
    int best = std::numeric_limits<int>::max();
    std::size_t target = look_.focus;
    for (std::size_t i = 0; i < now.spots.size(); ++i) {
        const Box& to = now.spots[i].box;
        const int along = dx != 0 ? (to.x - from.x) * dx : (to.y - from.y) * dy;
        const bool same_row = to.y == from.y;
        if (along <= 0 || (dx != 0 && !same_row)) {
            continue;
        }
        const int distance = dx != 0 ? along : along * 1000 + std::abs(middle(to) - middle(from));
        if (distance < best) {
            best = distance;
            target = i;
        }
    }
    look_.focus = target;
}

void Console::scroll_talk(bool back) {
    const auto page = static_cast<std::size_t>(std::max(1, layout().talk_rows - 1));
    if (back) {
        const std::size_t most = talk_.size() > page ? talk_.size() - page : 0;
        look_.talk_back = std::min(look_.talk_back + page, most);
    } else {
        look_.talk_back -= std::min(look_.talk_back, page);
    }
}

}  // namespace fauxboard::screen
