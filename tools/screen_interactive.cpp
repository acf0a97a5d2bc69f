// `fauxboard screen interactive`: the pages in the terminal, with keyboard and mouse.

#include <fmt/format.h>

#include <algorithm>

#include "emulator/link/host_error.h"
#include "emulator/screen/tour_report.h"
#include "protocol/annotate.h"
#include "tools/report.h"
#include "tools/screen_commands.h"
#include "tools/screen_session.h"
#include "tools/terminal.h"

namespace fauxboard::tools {
namespace {

using host::SimTime;
using screen::Ink;

constexpr double frames_per_second = 30;

/// The talk on the line, for the pane below the page.
class TalkPane final : public host::LiveObserver {
  public:
    explicit TalkPane(screen::Console& console) : console_(console) {}

    void on_received(SimTime, board::Channel, std::string_view line, board::Verdict) override {
        add("→", line, protocol::Direction::to_board, Ink::sent);
    }
    void on_sent(SimTime, board::Channel, std::string_view line) override {
        add("←", line, protocol::Direction::to_screen, Ink::came);
    }
    void on_notice(SimTime, board::Level, std::string_view text) override {
        console_.add_talk({Ink::warning, "! " + screen::printable(text)});
    }
    void on_link(SimTime, link::LinkState, std::string_view why) override {
        console_.add_talk({Ink::hint, "  " + screen::printable(why)});
    }

  private:
    void add(std::string_view arrow, std::string_view line, protocol::Direction direction, Ink ink) {
        const std::string words = protocol::explain(protocol::decode_line(line, direction));
        console_.add_talk({ink, fmt::format("{} {}   {}", arrow, screen::printable(line), words)});
    }

    screen::Console& console_;
};

class Interactive final : public host::ScreenUser {
  public:
    explicit Interactive(ScreenSession& session)
        : session_(session), console_(session.screen().profile().name), pane_(console_) {
        session.observe(pane_);
    }

    SimTime on_turn(SimTime now) override {
        if (!terminal_) {
            take_terminal();
        }
        if (!told_silence_ && session_.live().lines_heard() == 0 && now >= session_.first_word_due()) {
            told_silence_ = true;
            console_.say("the board says nothing; is it on, are baud rate and wires right?");
        }
        const SimTime silence = told_silence_ ? machine::never : session_.first_word_due();
        if (now < next_frame_) {
            return std::min(next_frame_, silence);
        }
        draw();
        next_frame_ = now + machine::from_seconds(session_.options().speed.factor / frames_per_second);
        return silence;
    }

    void on_judged(const screen::Judgement& judgement) override {
        if (judgement.verdict != screen::Verdict::ok) {
            pane_.on_notice(judgement.at, board::Level::warning,
                            fmt::format("{}: {}", screen::verdict_words(judgement.verdict), judgement.why));
        }
    }

    void on_link(link::LinkState, std::string_view why) override {
        console_.say(std::string(why));
        draw();  // there may be no turn any more, with the board gone
    }

    /// What could not be done with the terminal; "" when all went well.
    const std::string& trouble() const { return trouble_; }

  private:
    void take_terminal() {
        try {
            terminal_ = std::make_unique<Terminal>(
                session_.loop(),
                Terminal::Events{[this](const screen::Key& key) { press(key); }, [this] { draw(); },
                                 [this] { session_.finish(ExitCode::ok); }});
        } catch (const link::HostError& error) {
            trouble_ = error.what();
            session_.finish(ExitCode::usage);
        }
    }

    void press(const screen::Key& key) {
        const screen::Reaction reaction = console_.press(key);
        if (reaction.quit) {
            session_.finish(ExitCode::ok);
            return;
        }
        if (reaction.touch) {
            const screen::Touch& touch = *reaction.touch;
            const screen::PressResult result = session_.live().touch(touch.button, touch.row, touch.input);
            if (!result.pressed) {
                console_.say(result.sentence);
            }
        }
        draw();
    }

    void draw() {
        if (terminal_) {
            console_.resize(terminal_->columns(), terminal_->rows());
            console_.show(screen::view_page(session_.screen().standpoint()));
            terminal_->draw(console_.layout());
        }
    }

    ScreenSession& session_;
    screen::Console console_;
    TalkPane pane_;
    std::unique_ptr<Terminal> terminal_;
    SimTime next_frame_{0};
    bool told_silence_ = false;
    std::string trouble_;
};

}  // namespace

ExitCode interactive(const ScreenOptions& options) {
    if (!Terminal::here()) {
        return complain("screen", ExitCode::usage,
                        "interactive needs a terminal; press, tour and show do without one");
    }
    ScreenSession session(options);
    ExitCode code = ExitCode::ok;
    std::string trouble;
    {
        Interactive user(session);
        code = session.run(user);
        trouble = user.trouble();
    }  // the terminal is itself again
    if (!trouble.empty()) {
        return complain("screen", code, trouble);
    }
    const auto& findings = session.screen().findings();
    if (!findings.empty()) {
        print("What this screen did not take as it was meant:\n" + screen::findings_text(findings));
    }
    return session.interrupted() ? ExitCode::ok : code;
}

}  // namespace fauxboard::tools
