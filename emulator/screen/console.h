#pragma once

// A person at a terminal in front of the screen: keys and clicks in, touches and cells out. No terminal here.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "emulator/screen/layout.h"

namespace fauxboard::screen {

struct Key {
    enum class Kind : std::uint8_t {
        character,
        enter,
        escape,
        tab,
        back_tab,
        up,
        down,
        left,
        right,
        backspace,
        page_up,
        page_down,
        click,
    };
    Kind kind = Kind::character;
    char character = '\0';
    int x = 0;  ///< of a click
    int y = 0;
};

struct Touch {
    std::size_t button = 0;
    std::size_t row = 0;
    std::optional<double> input;
};

/// What a key comes to.
struct Reaction {
    bool quit = false;
    std::optional<Touch> touch;
};

/// What the person at the terminal sees and does. The focus stays on a button while it is there, and goes
/// back to the first when the page changes.
class Console {
  public:
    explicit Console(std::string screen_name) { look_.screen = std::move(screen_name); }

    void resize(int columns, int rows);
    /// The page as it is now.
    void show(PageView view);
    /// One more line of the talk; the last 500 are kept.
    void add_talk(TalkLine line);
    /// A sentence for the status line, until the next key.
    void say(std::string sentence) { look_.status = std::move(sentence); }
    Reaction press(const Key& key);
    Layout layout() const;

  private:
    Reaction press_button(std::size_t index);
    Reaction type(const Key& key);
    Reaction send_entry();
    Reaction press_hot(char key);
    void move(int dx, int dy);
    void step(bool forward);
    void scroll_talk(bool back);

    PageView view_;
    Look look_;
    std::deque<TalkLine> talk_;
    int columns_ = least_columns;
    int rows_ = least_rows;
};

}  // namespace fauxboard::screen
