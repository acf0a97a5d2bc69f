// `fauxboard screen press`: buttons by name, and what comes of them.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "emulator/host/json_log.h"
#include "emulator/host/line_log.h"
#include "emulator/screen/screen_json.h"
#include "tools/report.h"
#include "tools/screen_commands.h"
#include "tools/screen_walk.h"

namespace fauxboard::tools {
namespace {

using host::SimTime;

bool page_has_rows(const screen::ScreenProfile& profile, std::size_t page) {
    const auto& buttons = profile.pages[page].buttons;
    return std::any_of(buttons.begin(), buttons.end(),
                       [&](std::size_t id) { return profile.buttons[id].rows.has_value(); });
}

/// What is wrong with a path before anything is sent; "" for nothing. Tells when a word might have meant
/// another button. Once a page with a list has been opened
/// a path may be an entry of that list, which nobody knows yet.
std::string objection(const screen::ScreenProfile& profile, const std::vector<std::string>& paths) {
    const auto values = profile.values.power_on();
    std::size_t page = profile.main_page;
    for (const std::string& path : paths) {
        const screen::Resolved meant = screen::resolve(profile, values, page, path);
        if (!meant.button) {
            return page_has_rows(profile, page) ? std::string{} : meant.sentence;
        }
        const screen::Button& button = profile.buttons[*meant.button];
        if (const auto others = screen::also_ending(profile, *meant.button, path); !others.empty()) {
            complain("screen", ExitCode::ok,
                     fmt::format("\"{}\" is taken as \"{}\"; there are {}, too", path, button.path,
                                 fmt::join(others, ", ")));
        }
        if (button.page != screen::no_page) page = button.page;
        const screen::Standpoint at{profile, values, page, page};
        page = at.destination(button.leads_to, at.scope(button, 1)).value_or(page);
    }
    return {};
}

/// A command that no table has is one of the screen's own buttons.
std::string own_words(board::Channel, const protocol::DecodedLine& line) {
    const bool own = line.code == nullptr && line.direction == protocol::Direction::to_board;
    return own && !line.code_text.empty() ? line.code_text + ": the screen's own" : std::string();
}

class Press final : public ScreenWalk {
  public:
    explicit Press(ScreenSession& session) : ScreenWalk(session), out_(STDOUT_FILENO, wait) {
        if (session.options().json) {
            auto log = std::make_unique<host::JsonLog>(out_);
            log->ask(own_words);
            log_ = std::move(log);
        } else {
            auto log = std::make_unique<host::LineLog>(out_, host::Detail::verbose, 0);
            log->ask(own_words);
            log_ = std::move(log);
        }
        if (session.options().verbose) {
            session.observe(*log_);
        }
    }

    void on_judged(const screen::Judgement& judgement) override {
        if (judgement.verdict == screen::Verdict::ok || !(tour() || session().options().verbose)) {
            return;
        }
        const SimTime at = session().live().line_time(judgement.at);
        if (session().options().json) {
            out_.write(screen::judgement_json(judgement, at));
        } else {
            log_->on_notice(at, board::Level::warning, judgement.sentence());
        }
    }

  private:
    static constexpr auto wait = host::TextOutput::WhenFull::wait;

    std::unique_ptr<screen::Tour> make_tour(SimTime) override {
        if (!session().options().verbose) {
            session().observe(*log_);  // what came before the first touch is not its answer
        }
        return std::make_unique<screen::Tour>(session().screen(), session().options().buttons,
                                              session().slack());
    }

    void on_result(const screen::TourResult& result) override {
        if (session().options().json) {
            out_.write(screen::result_json(result));
        } else {
            out_.write(fmt::format("{}: {}\n", screen::tour_verdict_words(result.verdict), result.sentence));
        }
    }

    SimTime on_done(SimTime) override {
        const bool all = tour()->passed();
        session().finish(all ? ExitCode::ok : ExitCode::failed);
        if (const auto wrong = std::find_if(
                results().begin(), results().end(),
                [](const screen::TourResult& one) { return one.verdict != screen::TourVerdict::met; });
            wrong != results().end()) {
            complain("screen", ExitCode::failed,
                     fmt::format("{}: {}", screen::tour_verdict_words(wrong->verdict), wrong->sentence));
        }
        return machine::never;
    }

    host::TextOutput out_;
    std::unique_ptr<host::LiveObserver> log_;
};

}  // namespace

ExitCode press(const ScreenOptions& options) {
    ScreenSession session(options);
    const screen::ScreenProfile& profile = session.screen().profile();
    if (const std::string wrong = objection(profile, options.buttons); !wrong.empty()) {
        return complain("screen", ExitCode::usage, wrong);
    }
    Press user(session);
    return session.run(user);
}

}  // namespace fauxboard::tools
