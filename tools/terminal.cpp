#include "tools/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <langinfo.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "emulator/link/host_error.h"
// Its macros are named as other headers' functions are.
#define NCURSES_NOMACROS 1
#include <ncurses.h>

namespace fauxboard::tools {
namespace {

using screen::Ink;
using screen::Key;

constexpr int escape_delay_ms = 25;    ///< so long an Esc alone is not known from the start of a key
constexpr int redraw_key = 'L' - '@';  ///< Ctrl-L, for a terminal that somebody else has written on
constexpr std::size_t inks = static_cast<std::size_t>(Ink::status) + 1;

/// The frames are no ASCII. Where the user's words are not UTF-8, the terminal mostly is all the same.
void choose_utf8() {
    std::setlocale(LC_CTYPE, "");
    if (std::strcmp(::nl_langinfo(CODESET), "UTF-8") != 0) {
        std::setlocale(LC_CTYPE, "C.UTF-8");
    }
}

/// The terminal once more: what the event loop waits for does not block, and on stdin that would be the
/// shell's terminal, too, and stay when we are gone.
link::UniqueFd open_again() {
    std::array<char, 256> name{};
    const bool known = ::ttyname_r(STDIN_FILENO, name.data(), name.size()) == 0;
    link::UniqueFd fd(::open(known ? name.data() : "/dev/tty", O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!fd) {
        throw link::HostError(fmt::format("The terminal {} cannot be opened ({}). Use press, tour and show.",
                                          known ? name.data() : "/dev/tty",
                                          std::system_category().message(errno)));
    }
    return fd;
}

std::optional<Key> plain_key(Key::Kind kind) {
    Key key;
    key.kind = kind;
    return key;
}

std::optional<Key> click() {
    MEVENT event{};
    if (::getmouse(&event) != OK || (event.bstate & (BUTTON1_RELEASED | BUTTON1_CLICKED)) == 0) {
        return std::nullopt;
    }
    Key key;
    key.kind = Key::Kind::click;
    key.x = event.x;
    key.y = event.y;
    return key;
}

std::optional<Key> key_of(int code) {
    struct Row {
        int code;
        Key::Kind kind;
    };
    static constexpr std::array<Row, 15> table{{{'\r', Key::Kind::enter},
                                                {'\n', Key::Kind::enter},
                                                {KEY_ENTER, Key::Kind::enter},
                                                {27, Key::Kind::escape},
                                                {'\t', Key::Kind::tab},
                                                {KEY_BTAB, Key::Kind::back_tab},
                                                {KEY_UP, Key::Kind::up},
                                                {KEY_DOWN, Key::Kind::down},
                                                {KEY_LEFT, Key::Kind::left},
                                                {KEY_RIGHT, Key::Kind::right},
                                                {KEY_BACKSPACE, Key::Kind::backspace},
                                                {127, Key::Kind::backspace},
                                                {8, Key::Kind::backspace},
                                                {KEY_PPAGE, Key::Kind::page_up},
                                                {KEY_NPAGE, Key::Kind::page_down}}};
    for (const Row& row : table) {
        if (row.code == code) return plain_key(row.kind);
    }
    if (code == KEY_MOUSE) {
        return click();
    }
    if (code < ' ' || code > '~') {
        return std::nullopt;
    }
    Key key;
    key.character = static_cast<char>(code);
    return key;
}

}  // namespace

struct Terminal::Curses {
    Curses() {
        choose_utf8();
        ::set_escdelay(escape_delay_ms);
        handle = ::newterm(nullptr, stdout, stdin);
        if (handle == nullptr) {
            const char* term = std::getenv("TERM");
            throw link::HostError(
                fmt::format("Nothing is known about a terminal of the kind '{}'. Set TERM to what yours is "
                            "(xterm, mostly), or use press, tour and show.",
                            term == nullptr ? "" : term));
        }
        ::cbreak();  // Ctrl-C stays a signal
        ::noecho();
        ::nonl();
        ::curs_set(0);
        ::keypad(stdscr, TRUE);
        ::nodelay(stdscr, TRUE);
        ::mouseinterval(0);
        ::mousemask(BUTTON1_RELEASED | BUTTON1_CLICKED, nullptr);
        choose_inks();
    }
    ~Curses() {
        ::mousemask(0, nullptr);
        ::endwin();
        ::delscreen(handle);
    }
    Curses(const Curses&) = delete;
    Curses& operator=(const Curses&) = delete;

    void choose_inks() {
        const auto set = [this](Ink ink, attr_t attributes) {
            attribute[static_cast<std::size_t>(ink)] = attributes;
        };
        set(Ink::title, A_REVERSE | A_BOLD);
        set(Ink::shut, A_DIM);
        set(Ink::focus, A_REVERSE);
        set(Ink::hot, A_UNDERLINE | A_BOLD);
        set(Ink::warning, A_BOLD);
        set(Ink::hint, A_DIM);
        set(Ink::status, A_REVERSE);
        const char* no_color = std::getenv("NO_COLOR");
        if (!::has_colors() || (no_color != nullptr && *no_color != '\0')) {
            return;
        }
        ::start_color();
        ::use_default_colors();
        const auto colour = [this](Ink ink, short pair, short foreground) {
            ::init_pair(pair, foreground, -1);
            attribute[static_cast<std::size_t>(ink)] |= static_cast<attr_t>(COLOR_PAIR(pair));
        };
        colour(Ink::sent, 1, COLOR_CYAN);
        colour(Ink::came, 2, COLOR_GREEN);
        colour(Ink::warning, 3, COLOR_YELLOW);
        colour(Ink::frame, 4, COLOR_BLUE);
    }

    SCREEN* handle = nullptr;
    std::array<attr_t, inks> attribute{};
};

bool Terminal::here() {
    return ::isatty(STDIN_FILENO) == 1 && ::isatty(STDOUT_FILENO) == 1;
}

Terminal::Terminal(link::EventLoop& loop, Events events)
    : events_(std::move(events)),
      resized_(loop, {SIGWINCH}, [this](int) { on_resized(); }),  // so that ncurses' handler gets none
      curses_(std::make_unique<Curses>()),
      terminal_(open_again()),
      keys_(loop, [this] { read_keys(); }) {
    keys_.start(terminal_.get());
}

Terminal::~Terminal() = default;

void Terminal::on_resized() {
    winsize size{};
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row != 0 && size.ws_col != 0) {
        ::resizeterm(size.ws_row, size.ws_col);
    }
    events_.on_resize();
}

void Terminal::read_keys() {
    int waiting = 0;
    if (::ioctl(STDIN_FILENO, FIONREAD, &waiting) != 0 || waiting == 0) {
        keys_.stop();
        events_.on_hangup();
        return;
    }
    for (int code = ::getch(); code != ERR; code = ::getch()) {
        if (code == redraw_key) {
            ::clearok(curscr, TRUE);
            events_.on_resize();
        }
        if (const auto key = key_of(code)) {
            events_.on_key(*key);
        }
    }
    if (::ioctl(STDIN_FILENO, FIONREAD, &waiting) != 0 || waiting == 0) {
        keys_.drained();
    }
}

int Terminal::columns() const {
    return ::getmaxx(stdscr);
}

int Terminal::rows() const {
    return ::getmaxy(stdscr);
}

void Terminal::draw(const screen::Layout& layout) {
    ::erase();
    for (const screen::Run& run : layout.runs) {
        ::attrset(static_cast<int>(curses_->attribute[static_cast<std::size_t>(run.ink)]));
        ::mvaddstr(run.y, run.x, run.text.c_str());
    }
    ::refresh();
}

}  // namespace fauxboard::tools
