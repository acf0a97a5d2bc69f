// `fauxboard screen ... --control PATH`: the screen that is part of a running board.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/link/event_loop.h"
#include "emulator/link/host_error.h"
#include "emulator/link/output_file.h"
#include "emulator/screen/page_view.h"
#include "tools/control_screen.h"
#include "tools/ctl_text.h"
#include "tools/report.h"
#include "tools/screen_commands.h"
#include "tools/terminal.h"

namespace fauxboard::tools {
namespace {

std::string last_part(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

/// The page as the terminal's console takes it: buttons by their place in the page's list.
screen::PageView view_of(const Json& page) {
    screen::PageView out;
    out.path = place_of(page);
    out.title = page.value("title", "");
    for (const Json& text : page.at("texts")) {
        out.lines.push_back(text.get<std::string>());
    }
    if (const Json& box = page.at("box"); box.is_object()) {
        out.lines = {"[" + box.value("caption", "") + "]", box.value("text", "")};
        std::replace(out.lines.back().begin(), out.lines.back().end(), '\n', ' ');
    }
    std::size_t number = 0;
    for (const Json& control : page.at("controls")) {
        screen::ButtonView button;
        button.button = number++;
        button.row = 1;
        button.label = control.value("name", "");
        button.shut = control.value("enabled", true) ? "" : "it is dead now";
        out.buttons.push_back(std::move(button));
    }
    return out;
}

/// The board's screen in a terminal; looked at ten times a second.
class OwnInteractive {
  public:
    OwnInteractive(ControlScreen& screen, std::string name)
        : screen_(screen), console_(std::move(name)), page_(screen.page()) {}

    void run() {
        Terminal terminal(loop_, {[this](const screen::Key& key) { press(key); }, [this] { changed_ = true; },
                                  [this] { loop_.stop(); }});
        while (!loop_.stopped()) {
            const Json now = screen_.page();
            if (changed_ || now != page_) {
                page_ = now;
                changed_ = false;
                console_.resize(terminal.columns(), terminal.rows());
                console_.show(view_of(page_));
                terminal.draw(console_.layout());
            }
            loop_.run_one_for(look_every);
        }
    }

  private:
    static constexpr std::chrono::milliseconds look_every{100};

    void press(const screen::Key& key) {
        const screen::Reaction reaction = console_.press(key);
        changed_ = true;
        if (reaction.quit) {
            loop_.stop();
        } else if (reaction.touch && reaction.touch->button < page_.at("controls").size()) {
            const std::string why =
                screen_.touch(page_.at("controls")[reaction.touch->button].value("name", ""));
            if (!why.empty()) console_.say(why);
        }
    }

    ControlScreen& screen_;
    link::EventLoop loop_;
    link::Signals signals_{loop_, link::ending_signals(),
                           [this](int) { loop_.stop(); }};  // before ncurses does
    screen::Console console_;
    Json page_;
    bool changed_ = true;
};

}  // namespace

ExitCode keep_picture(const std::string& file, const std::string& png, ExitCode code) {
    try {
        link::write_output(file, file, png);
    } catch (const link::HostError& error) {
        return complain("screen", ExitCode::bad_input, error.what());
    }
    return code;
}

ExitCode show_own(const ScreenOptions& options) {
    ControlScreen screen(options.control);
    if (!options.png.empty()) {
        return keep_picture(options.png, screen.png(), ExitCode::ok);
    }
    const Json page = screen.page();
    print(options.json ? page.dump(2) + "\n" : answer_text(page));
    return ExitCode::ok;
}

ExitCode press_own(const ScreenOptions& options) {
    ControlScreen screen(options.control);
    for (const std::string& path : options.buttons) {
        const std::string why = screen.touch(last_part(path));
        const Json page = screen.page();
        if (options.json) {
            print(Json{{"button", path}, {"pressed", why.empty()}, {"why", why}, {"page", page}}.dump() +
                  "\n");
        } else if (why.empty()) {
            print(fmt::format("{}: {}\n", path, place_of(page)));
        }
        if (!why.empty()) {
            return complain("screen", ExitCode::failed, why);
        }
    }
    return ExitCode::ok;
}

ExitCode interactive_own(const ScreenOptions& options) {
    ControlScreen screen(options.control);
    OwnInteractive(screen, screen.profile()->name).run();
    return ExitCode::ok;
}

}  // namespace fauxboard::tools
