// `fauxboard screen interactive` on a terminal: a pseudo-terminal on which the test is the person.

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <regex>

#include "emulator/host/screen_files.h"
#include "emulator/screen/layout.h"
#include "emulator/screen/screen.h"
#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

/// The program with a terminal of its own; what it draws is read as it comes.
class AtTerminal {
  public:
    AtTerminal(const Args& args, int columns, int rows, const char* term = "xterm") {
        REQUIRE(::tcgetattr(pty_.master.get(), &before_) == 0);
        resize(columns, rows);
        pid_ = ::fork();
        REQUIRE(pid_ >= 0);
        if (pid_ == 0) {
            become(args, term);
        }
    }
    ~AtTerminal() {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }
    AtTerminal(const AtTerminal&) = delete;
    AtTerminal& operator=(const AtTerminal&) = delete;

    void type(std::string_view keys) const { link::test::say(pty_.master.get(), keys); }
    void resize(int columns, int rows) const {
        winsize size{};
        size.ws_col = static_cast<unsigned short>(columns);
        size.ws_row = static_cast<unsigned short>(rows);
        REQUIRE(::ioctl(pty_.master.get(), TIOCSWINSZ, &size) == 0);
    }
    void signal(int number) const { REQUIRE(::kill(pid_, number) == 0); }

    /// Reads on until `part` has been drawn behind what was seen last; false when it never is.
    bool sees(std::string_view part) {
        while (fresh_.find(part) == std::string::npos) {
            pollfd entry{.fd = pty_.master.get(), .events = POLLIN, .revents = 0};
            std::array<char, 4096> buffer;
            if (::poll(&entry, 1, patience_ms) <= 0) return false;
            const ssize_t count = ::read(pty_.master.get(), buffer.data(), buffer.size());
            if (count < 0 && errno == EAGAIN) continue;
            if (count <= 0) return false;
            fresh_.append(buffer.data(), static_cast<std::size_t>(count));
        }
        const std::size_t end = fresh_.find(part) + part.size();
        drawn_ += fresh_.substr(0, end);
        fresh_.erase(0, end);
        return true;
    }
    /// Has all drawn anew (Ctrl-L), since a change alone is drawn in bits, until `part` stands there, in
    /// whatever colours.
    bool shows(std::string_view part) {
        for (int frames = 0; frames < 3000; ++frames) {
            fresh_.clear();
            type("\x0c");
            if (!sees("\x1b[2J") || !sees("Virtual screen")) return false;
            const std::string frame = drawn_.substr(drawn_.rfind("\x1b[2J"));
            static const std::regex colours("\x1b(\\[[0-9;]*m|\\(B)");
            if (contains(std::regex_replace(frame, colours, ""), std::string(part))) return true;
        }
        return false;
    }
    /// The exit code; 1000 + the signal that ended it. What it still drew is read.
    int wait() {
        int status = 0;
        while (::waitpid(pid_, &status, WNOHANG) == 0) {
            pollfd entry{.fd = pty_.master.get(), .events = POLLIN, .revents = 0};
            ::poll(&entry, 1, 10);
            fresh_ += link::test::take(pty_.master.get());
        }
        fresh_ += link::test::take(pty_.master.get());
        pid_ = -1;
        return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
    }
    /// The terminal is as it was: its modes, the other screen and the mouse switched off again.
    void check_restored() {
        drawn_ += fresh_;
        termios now{};
        REQUIRE(::tcgetattr(pty_.master.get(), &now) == 0);
        CHECK(now.c_lflag == before_.c_lflag);
        CHECK(now.c_iflag == before_.c_iflag);
        CHECK(now.c_oflag == before_.c_oflag);
        CHECK(drawn_.rfind("\x1b[?1049l") > drawn_.rfind("\x1b[?1049h"));
        CHECK(drawn_.rfind("\x1b[?1006;1000l") > drawn_.rfind("\x1b[?1006;1000h"));
    }
    const std::string& drawn() const { return drawn_; }

  private:
    [[noreturn]] void become(const Args& args, const char* term) const {
        ::setsid();
        const int terminal = ::open(pty_.path.c_str(), O_RDWR);
        ::ioctl(terminal, TIOCSCTTY, 0);
        for (const int fd : {0, 1, 2})
            ::dup2(terminal, fd);
        ::setenv("TERM", term, 1);
        ::unsetenv("NO_COLOR");
        ::unsetenv("LINES");
        ::unsetenv("COLUMNS");
        std::vector<char*> words{const_cast<char*>(FAUXBOARD_PROGRAM)};
        for (const std::string& arg : args)
            words.push_back(const_cast<char*>(arg.c_str()));
        words.push_back(nullptr);
        ::execv(FAUXBOARD_PROGRAM, words.data());
        ::_exit(127);
    }

    link::test::OtherPty pty_;
    UniqueFd held_ = link::test::open_terminal(pty_.path);  ///< or the line ends with the program
    termios before_{};
    pid_t pid_ = -1;
    std::string fresh_;
    std::string drawn_;
};

struct Board {
    Program program{{"run", "--no-pacing", "--json"}};
    std::string path = program.ready()["path"];
    std::string says(std::string_view part) { return program.out().find(part); }
};

/// A cell of a button on the page as it is after power-on, for a mouse: the sequence that clicks it.
std::string click_on(const std::string& page, std::string_view label, int columns, int rows) {
    const screen::Screen screen(host::load_screen_by_name("geeetech-a30t"));
    screen::Standpoint at = screen.standpoint();
    at.page = screen.profile().find_page(page).value();
    const screen::PageView view = screen::view_page(at);
    const screen::Layout layout = screen::lay_out(view, {}, {}, columns, rows);
    for (std::size_t i = 0; i < view.buttons.size(); ++i) {
        if (view.buttons[i].label == label) {
            const std::string where = std::to_string(layout.spots[i].box.x + 2) + ';' +
                                      std::to_string(layout.spots[i].box.y + 2);  // counts from 1
            return "\x1b[<0;" + where + "M\x1b[<0;" + where + "m";
        }
    }
    return {};
}

TEST_CASE("keyboard, mouse and numbers press the screen's buttons, and the board hears of it") {
    Board board;
    AtTerminal user({"screen", "--port", board.path, "interactive"}, 100, 40);
    CHECK(user.sees("Main menu"));
    CHECK(user.sees("Virtual screen"));
    user.type("c");  // hot key of Control
    CHECK(user.shows("Motion Param"));

    const std::string click = click_on("Control", "Filament", 100, 40);
    REQUIRE(!click.empty());
    user.type(click);
    CHECK(user.shows("Hotend on"));
    const std::string on = click_on("Control/Filament", "Hotend on", 100, 40);
    user.type(on);
    CHECK(contains(board.says("M104 S200"), "\"screen\""));
    CHECK(user.shows("/ 200.0"));     // the page shows what came back
    CHECK(user.shows("target 200"));  // and the pane the talk in words

    user.type("q");
    CHECK(user.wait() == 0);
    user.check_restored();
}

TEST_CASE("Tab, arrows and Enter; a number typed in") {
    Board board;
    AtTerminal user({"screen", "--port", board.path, "interactive"}, 80, 24);
    CHECK(user.sees("Main menu"));
    user.type("\t\x1bOC\r");  // from Control to Printing to Setting
    CHECK(user.shows("Add-on"));
    user.type(click_on("Setting", "Add-on", 80, 24));
    CHECK(contains(board.says("M2139"), "\"screen\""));
    CHECK(user.shows("Screen lock PW"));
    user.type(click_on("Setting/Add-on", "Screen lock PW", 80, 24));
    user.type("4321\r");
    CHECK(contains(board.says("M2139 P2 W4321"), "\"screen\""));
    user.type("\x03");  // Ctrl-C
    CHECK(user.wait() == 0);
    user.check_restored();
}

TEST_CASE("a terminal that is too small says so, and the page is back when it has grown") {
    Board board;
    AtTerminal user({"screen", "--port", board.path, "interactive"}, 60, 10);
    CHECK(user.sees("60x10 cells are too few"));
    user.resize(100, 30);
    CHECK(user.sees("Main menu"));
    user.resize(70, 20);
    CHECK(user.sees("70x20 cells"));
    user.signal(SIGTERM);
    CHECK(user.wait() == 0);
    user.check_restored();
}

TEST_CASE("the board goes away: the status says so, the screen stays, and the terminal is restored") {
    Board board;
    AtTerminal user({"screen", "--port", board.path, "interactive"}, 80, 24);
    CHECK(user.sees("Main menu"));
    CHECK(contains(board.says("log Geeetech"), "LCD OK"));
    CHECK(board.program.stop() == 0);
    CHECK(user.sees("vanished"));  // with no key pressed
    CHECK(user.shows("vanished"));
    user.signal(SIGHUP);
    CHECK(user.wait() == 0);
    user.check_restored();
}

TEST_CASE("what cannot be: no such port, a terminal of no known kind") {
    AtTerminal missing({"screen", "--port", "/dev/ttyMISSING", "interactive"}, 80, 24);
    CHECK(missing.sees("/dev/ttyMISSING"));
    CHECK(missing.wait() == 4);
    Board board;
    AtTerminal unknown({"screen", "--port", board.path, "interactive"}, 80, 24, "no-such-terminal");
    CHECK(unknown.sees("Set TERM to what yours is"));
    CHECK(unknown.wait() == 2);
}

}  // namespace
}  // namespace fauxboard::e2e
