// `fauxboard screen show`: a page as a person would see it.

#include <fmt/format.h>

#include "emulator/drawing/draw.h"
#include "emulator/drawing/png.h"
#include "emulator/screen/page_view.h"
#include "emulator/screen/scene.h"
#include "emulator/screen/screen_json.h"
#include "emulator/screen/tour_report.h"
#include "tools/report.h"
#include "tools/screen_commands.h"
#include "tools/screen_walk.h"

namespace fauxboard::tools {
namespace {

using host::SimTime;

/// Once round the schedule and some, after the page was opened: what a board says unasked has come.
constexpr SimTime fill_time{4'500'000};

class Show final : public ScreenWalk {
  public:
    Show(ScreenSession& session, std::size_t page) : ScreenWalk(session), page_(page) {}

    /// The values on the page that no line has brought.
    std::vector<std::size_t> missing() const {
        const screen::ScreenProfile& profile = session().screen().profile();
        std::vector<std::size_t> out;
        for (const std::size_t value : screen::shown_values(profile, page_)) {
            const bool list = profile.values.at(value).kind == screen::ValueKind::list;
            if (!list && !session().live().told(value) && !profile.sources(value).empty()) {
                out.push_back(value);
            }
        }
        return out;
    }

  private:
    std::unique_ptr<screen::Tour> make_tour(SimTime now) override {
        fill_until_ = now + fill_time + session().slack();
        const auto route = screen::find_route_to_page(session().screen().standpoint(), page_);
        if (!route) {
            reason_ = fmt::format("no touch leads to the page \"{}\" now; it is shown without being opened",
                                  session().screen().profile().pages[page_].path);
            return nullptr;
        }
        if (route->empty()) {
            return nullptr;
        }
        // The tour finds the way to it by itself, and only what the page itself asks for is judged.
        const std::string& last = session().screen().profile().buttons[route->back().button].path;
        return std::make_unique<screen::Tour>(session().screen(), std::vector{last}, session().slack());
    }

    SimTime on_done(SimTime now) override {
        if (now < fill_until_ && !missing().empty()) {
            return fill_until_;
        }
        const bool answered = tour() == nullptr || tour()->passed();
        if (!answered) {
            reason_ = "the page may be incomplete: " + results().back().sentence;
        }
        session().finish(answered ? ExitCode::ok : ExitCode::timed_out);
        if (!reason_.empty()) {
            complain("screen", ExitCode::ok, reason_);
        }
        shown_ = true;
        return machine::never;
    }

    std::size_t page_;
    SimTime fill_until_{0};
    std::string reason_;
    bool shown_ = false;

  public:
    bool shown() const { return shown_; }
};

std::string names_of(const screen::ScreenProfile& profile, const std::vector<std::size_t>& values) {
    std::vector<std::string> out;
    for (const std::size_t value : values) {
        out.push_back(fmt::format("{} ({})", profile.values.at(value).name, profile.sources(value)));
    }
    return fmt::format("{}", fmt::join(out, ", "));
}

}  // namespace

ExitCode show(const ScreenOptions& options) {
    ScreenSession session(options);
    const screen::Screen& screen = session.screen();
    const screen::ResolvedPage meant = screen::resolve_page(screen.profile(), options.page);
    if (!meant.page) {
        return complain("screen", ExitCode::usage, meant.sentence);
    }
    Show user(session, *meant.page);
    const ExitCode code = session.run(user);
    if (!user.shown()) {
        return code;
    }
    const auto missing = user.missing();
    screen::Standpoint at = screen.standpoint();
    at.page = *meant.page;
    if (!options.png.empty()) {
        return keep_picture(options.png, drawing::png_bytes(drawing::draw(screen::scene_of(at))), code);
    }
    if (options.json) {
        print(screen::page_json(at, missing, screen.findings()));
        return code;
    }
    print(screen.show(screen.profile().pages[*meant.page].path));
    if (!missing.empty()) {
        complain("screen", code,
                 "the board has not told yet, so these stand as after power-on: " +
                     names_of(screen.profile(), missing));
    }
    if (!screen.findings().empty()) {
        complain(
            "screen", code,
            "what this screen did not take as it was meant:\n" + screen::findings_text(screen.findings()));
    }
    return code;
}

}  // namespace fauxboard::tools
