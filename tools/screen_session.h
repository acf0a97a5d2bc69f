#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "emulator/host/clock.h"
#include "emulator/host/live_screen.h"
#include "emulator/host/recorder.h"
#include "emulator/link/event_loop.h"
#include "emulator/screen/screen.h"
#include "tools/commands.h"
#include "tools/screen_options.h"

namespace fauxboard::tools {

/// The screen, its line, its clock, in the order in which they must come and (backwards) go.
class ScreenSession {
  public:
    /// Opens nothing yet. Throws behaviour::ProfileError, link::HostError and link::LinkError.
    explicit ScreenSession(const ScreenOptions& options);

    /// Opens the line and runs until finish(), a signal, or the end of the line. Throws link::LinkError.
    ExitCode run(host::ScreenUser& user);
    /// Ends run(), which returns `code`.
    void finish(ExitCode code);
    /// The same with a sentence on stderr.
    void fail(ExitCode code, std::string_view sentence);
    /// A signal asked for the end.
    bool interrupted() const { return interrupted_; }

    /// Told of every line from now on. `observer` outlives the session.
    void observe(host::LiveObserver& observer) { observers_.add(observer); }
    screen::Screen& screen() { return screen_; }
    host::LiveScreen& live() { return *live_; }
    link::EventLoop& loop() { return loop_; }
    const ScreenOptions& options() const { return options_; }
    /// "pty /dev/pts/5"
    std::string line_name() const { return link_->describe(); }
    const link::LinkStats& stats() const { return link_->stats(); }

    /// When the board must have said something, in the screen's time.
    host::SimTime first_word_due() const;
    /// How much later than a screen expects it a reply may come: beyond real time, this computer's own
    /// delays do not shrink with the clock.
    host::SimTime slack() const;
    /// "nothing came from the board on ... in 10 s; ..."
    std::string silence_sentence() const;

  private:
    std::unique_ptr<link::Link> make_link();

    const ScreenOptions& options_;
    link::EventLoop loop_;
    host::Observers observers_;
    screen::Screen screen_;
    std::optional<host::Recorder> recorder_;
    std::unique_ptr<host::Clock> clock_;
    std::unique_ptr<link::Link> link_;
    std::optional<host::LiveScreen> live_;
    link::Signals signals_;
    ExitCode result_ = ExitCode::ok;
    bool interrupted_ = false;
};

/// Runs `body` and turns what it throws into a sentence and an exit code.
ExitCode guard_screen(const ScreenOptions& options, const std::function<ExitCode()>& body);

}  // namespace fauxboard::tools
