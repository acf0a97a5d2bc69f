#include "emulator/screen/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace fauxboard::screen {
namespace {

constexpr int least_talk = 5;  ///< rows, its rule included
constexpr std::string_view usual_status =
    "Virtual screen, no real one.  Tab, arrows, Enter, letters or mouse.  q quits";

int width_of(std::string_view text) {
    return static_cast<int>(columns(text));
}

/// The first `most` columns of a text; one that is cut ends in "~".
std::string cut(std::string_view text, int most) {
    if (width_of(text) <= most) {
        return std::string(text);
    }
    int count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool starts = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
        if (starts && ++count == most) {
            return std::string(text.substr(0, i)) + "~";
        }
    }
    return {};
}

std::string repeat(std::string_view text, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) {
        out += text;
    }
    return out;
}

std::string pad(std::string_view text, int width) {
    return cut(text, width) + std::string(static_cast<std::size_t>(std::max(0, width - width_of(text))), ' ');
}

std::string words_on(const ButtonView& button, int most) {
    std::string label = button.shut.empty() ? button.label : '(' + button.label + ')';
    if (button.input) label += " = ?";
    return cut(label, most);
}

/// Boxes side by side from (0, 0) on; the buttons of every page start a row of their own. Returns the height.
int place(const PageView& view, int width, bool tall, std::vector<Spot>& out) {
    const int height = tall ? 3 : 1;
    int x = 0;
    int y = 0;
    bool everywhere = false;
    out.clear();
    for (const ButtonView& button : view.buttons) {
        const int wide = width_of(words_on(button, width - 4)) + (tall ? 4 : 2);
        const bool part = button.everywhere && !everywhere && !out.empty();
        everywhere = button.everywhere;
        if (x != 0 && (part || x + wide > width)) {
            x = 0;
            y += height;
        }
        out.push_back({{x, y, wide, height}, true, '\0'});
        x += wide + 1;
    }
    return out.empty() ? 0 : y + height;
}

/// A letter of its label for each button, else a digit. 'q' quits.
void give_hot_keys(const PageView& view, std::vector<Spot>& spots) {
    std::set<char> taken{'q'};
    const auto take = [&](Spot& spot, char key) {
        const bool fresh = taken.insert(key).second;
        if (fresh) spot.hot = key;
        return fresh;
    };
    for (std::size_t i = 0; i < spots.size(); ++i) {
        for (const char c : view.buttons[i].label) {
            const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            if (small >= 'a' && small <= 'z' && take(spots[i], small)) break;
        }
        for (char digit = '1'; spots[i].hot == '\0' && digit <= '9'; ++digit) {
            take(spots[i], digit);
        }
    }
}

class Drawing {
  public:
    Drawing(const PageView& view, const Look& look, std::span<const TalkLine> talk, Layout& out)
        : view_(view), look_(look), talk_(talk), out_(out) {}

    void draw() {
        title();
        values();
        buttons();
        talk();
        put(0, out_.rows - 1, pad(bottom(), out_.columns), Ink::status);
    }

  private:
    void put(int x, int y, std::string text, Ink ink) { out_.runs.push_back({x, y, std::move(text), ink}); }

    void title() {
        const std::string right = look_.screen + ' ';
        std::string left = ' ' + view_.title;
        if (view_.title != view_.path) left += "   " + view_.path;
        put(0, 0, pad(left, out_.columns - width_of(right)) + right, Ink::title);
    }

    void values() {
        for (const std::string& line : view_.lines) {
            if (y_ + 4 + least_talk >= out_.rows) break;
            put(1, y_++, cut(line, out_.columns - 2), Ink::plain);
        }
        ++y_;
    }

    void buttons() {
        const int room = out_.rows - 1 - least_talk - y_;
        int height = place(view_, out_.columns - 2, true, out_.spots);
        if (height > room) {
            height = place(view_, out_.columns - 2, false, out_.spots);
        }
        give_hot_keys(view_, out_.spots);
        int first = 0;  // row that is scrolled to the top
        if (height > room && look_.focus < out_.spots.size()) {
            first = std::clamp(out_.spots[look_.focus].box.y - room / 2, 0, height - room);
        }
        for (std::size_t i = 0; i < out_.spots.size(); ++i) {
            Spot& spot = out_.spots[i];
            spot.visible = spot.box.y >= first && spot.box.y + spot.box.height <= first + room;
            spot.box.x += 1;
            spot.box.y += y_ - first;
            if (spot.visible) button(i);
        }
        if (first > 0) put(out_.columns - 8, y_, "^ more", Ink::hint);
        if (first + room < height) put(out_.columns - 8, y_ + room - 1, "v more", Ink::hint);
        y_ += std::min(height, room);
    }

    void button(std::size_t index) {
        const Spot& spot = out_.spots[index];
        const Box& box = spot.box;
        const ButtonView& view = view_.buttons[index];
        const Ink ink = index == look_.focus ? Ink::focus : view.shut.empty() ? Ink::label : Ink::shut;
        const std::string label = words_on(view, out_.columns - 6);
        const int text_x = box.x + (box.height == 3 ? 2 : 1);
        const int text_y = box.y + (box.height == 3 ? 1 : 0);
        if (box.height == 3) {
            const Ink frame = index == look_.focus ? Ink::focus : Ink::frame;
            const std::string line = repeat("─", box.width - 2);
            put(box.x, box.y, "┌" + line + "┐", frame);
            put(box.x, text_y, "│ " + label + " │", frame);
            put(box.x, box.y + 2, "└" + line + "┘", frame);
            put(text_x, text_y, label, ink);
        } else {
            put(box.x, box.y, '[' + label + ']', ink);
        }
        hot_key(spot, label, text_x, text_y);
    }

    void hot_key(const Spot& spot, const std::string& label, int x, int y) {
        if (spot.hot >= '1' && spot.hot <= '9') {
            put(x - 1, y, std::string(1, spot.hot), Ink::hot);
            return;
        }
        for (std::size_t i = 0; spot.hot != '\0' && i < label.size(); ++i) {
            if (label[i] == spot.hot || label[i] == spot.hot - 'a' + 'A') {
                put(x + width_of(std::string_view(label).substr(0, i)), y, std::string(1, label[i]),
                    Ink::hot);
                return;
            }
        }
    }

    void talk() {
        put(0, y_, "── the line " + repeat("─", out_.columns - 12), Ink::hint);
        out_.talk_rows = out_.rows - 2 - y_;
        const auto room = static_cast<std::size_t>(std::max(0, out_.talk_rows));
        const std::size_t back = std::min(look_.talk_back, talk_.size() - std::min(talk_.size(), room));
        const std::size_t end = talk_.size() - back;
        const std::size_t begin = end - std::min(end, room);
        for (std::size_t i = begin; i < end; ++i) {
            put(0, y_ + 1 + static_cast<int>(i - begin), cut(talk_[i].text, out_.columns), talk_[i].ink);
        }
    }

    std::string bottom() const {
        if (look_.entry && look_.focus < view_.buttons.size() && view_.buttons[look_.focus].input) {
            const ButtonView& button = view_.buttons[look_.focus];
            return fmt::format(" {}, {} to {}: {}_   {}", button.label, short_text(button.input->min),
                               short_text(button.input->max), *look_.entry,
                               look_.status.empty() ? "Enter: send; Esc: leave it" : look_.status);
        }
        return ' ' + (look_.status.empty() ? std::string(usual_status) : "Virtual screen: " + look_.status);
    }

    const PageView& view_;
    const Look& look_;
    std::span<const TalkLine> talk_;
    Layout& out_;
    int y_ = 1;
};

/// The cells of a UTF-8 text of narrow characters.
std::vector<std::string> cells(std::string_view text) {
    std::vector<std::string> out;
    for (const char c : text) {
        if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U || out.empty()) {
            out.emplace_back();
        }
        out.back() += c;
    }
    return out;
}

}  // namespace

std::optional<std::size_t> Layout::hit(int column, int row) const {
    for (std::size_t i = 0; i < spots.size(); ++i) {
        if (spots[i].visible && spots[i].box.contains(column, row)) {
            return i;
        }
    }
    return std::nullopt;
}

std::string Layout::text() const {
    const auto height = static_cast<std::size_t>(std::max(0, rows));
    const auto width = static_cast<std::size_t>(std::max(0, columns));
    std::vector<std::vector<std::string>> grid(height, std::vector<std::string>(width, " "));
    for (const Run& run : runs) {
        int x = run.x;
        for (std::string& cell : cells(run.text)) {
            if (run.y >= 0 && run.y < rows && x >= 0 && x < columns) {
                grid[static_cast<std::size_t>(run.y)][static_cast<std::size_t>(x)] = std::move(cell);
            }
            ++x;
        }
    }
    std::string out;
    for (const auto& row : grid) {
        std::string line = fmt::format("{}", fmt::join(row, ""));
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + '\n';
    }
    return out;
}

Layout lay_out(const PageView& view, const Look& look, std::span<const TalkLine> talk, int columns,
               int rows) {
    Layout out;
    out.columns = columns;
    out.rows = rows;
    if (columns < least_columns || rows < least_rows) {
        out.too_small = true;
        const std::string sentence = fmt::format("{}x{} cells are too few, {}x{} needed. q quits", columns,
                                                 rows, least_columns, least_rows);
        out.runs.push_back({0, 0, cut(sentence, columns), Ink::warning});
        return out;
    }
    Drawing(view, look, talk, out).draw();
    return out;
}

}  // namespace fauxboard::screen
