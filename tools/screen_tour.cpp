// `fauxboard screen tour`: every button, and whether what comes back is what the screen expects.

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "emulator/host/text_output.h"
#include "emulator/link/output_file.h"
#include "emulator/screen/tour_report.h"
#include "tools/progress.h"
#include "tools/report.h"
#include "tools/screen_commands.h"
#include "tools/screen_walk.h"

namespace fauxboard::tools {
namespace {

using host::SimTime;

/// That the reader of a pipe has to take the report.
constexpr std::chrono::seconds junit_patience{5};

class WholeTour final : public ScreenWalk {
  public:
    using ScreenWalk::ScreenWalk;
    bool done() const { return tour() != nullptr && tour()->done(); }
    std::size_t total() const { return session().screen().profile().buttons.size(); }
    void clear_progress() { progress_.clear(); }

  private:
    std::unique_ptr<screen::Tour> make_tour(SimTime) override {
        return std::make_unique<screen::Tour>(session().screen(), session().slack());
    }
    void on_result(const screen::TourResult& result) override {
        progress_.say(fmt::format("{:4} of {}  {}", results().size(), total(),
                                  std::string_view(result.button).substr(0, 60)));
    }
    SimTime on_done(SimTime) override {
        session().finish(tour()->passed() ? ExitCode::ok : ExitCode::failed);
        return machine::never;
    }

    Progress progress_;
};

}  // namespace

ExitCode tour(const ScreenOptions& options) {
    // Opened before the tour, so that a wrong name is told before and not after it.
    std::optional<link::OutputFile> junit;
    if (!options.junit.empty()) {
        junit.emplace(options.junit, fmt::format("The JUnit report {}", options.junit), junit_patience);
    }
    ScreenSession session(options);
    WholeTour user(session);
    ExitCode code = session.run(user);
    user.clear_progress();
    if (user.results().empty()) {
        return code;  // it never began, and why has been said
    }
    if (!user.done()) {
        complain("screen", code,
                 fmt::format("the tour ended after {} of {} buttons{}", user.results().size(), user.total(),
                             session.interrupted() ? ", because it was told to" : ""));
    }
    const std::string& name = session.screen().profile().name;
    const auto& findings = session.screen().findings();
    const screen::ScreenCounters& counters = session.screen().counters();
    const bool talks = session.screen().profile().talk.queued;
    if (options.json) {
        print(screen::tour_json(name, user.results(), findings, talks ? &counters : nullptr));
    } else {
        print(screen::tour_table(user.results()) + (talks ? screen::talk_text(counters) : ""));
        if (!findings.empty()) {
            print("\nWhat this screen did not take as it was meant:\n" + screen::findings_text(findings));
        }
    }
    if (junit) {
        std::string why = junit->append(screen::tour_junit(name, user.results()));
        why = why.empty() ? junit->finish() : why;
        if (!why.empty()) {
            code = complain("screen", ExitCode::bad_input,
                            fmt::format("the JUnit report {} could not be written ({})", options.junit, why));
        }
    }
    return code;
}

}  // namespace fauxboard::tools
