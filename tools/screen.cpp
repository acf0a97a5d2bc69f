// `fauxboard screen`: a virtual touch screen on the other end of the line.

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <functional>
#include <memory>

#include "tools/screen_commands.h"
#include "tools/screen_session.h"

namespace fauxboard::tools {
namespace {

constexpr const char* examples =
    R"--(Examples:
  fauxboard screen --port /tmp/screen press "X+ (30mm)"      the end of a path is enough
  fauxboard screen --port /tmp/screen press Printing "File 1" yes
  fauxboard screen --port /tmp/screen press "Screen lock PW=1234"
  fauxboard screen --port auto tour --junit tour.xml         every button of a real board
  fauxboard screen --tcp :4000 show Control/Speed
  fauxboard screen --port /tmp/screen interactive            the pages, with keyboard and mouse
  fauxboard screen --control /tmp/board press Service "Move Z"   the screen that is part of a board

Exit codes: 0 all expectations met, 1 one was not, or a button cannot be pressed now, 2 there is no such
button or page, 3 the screen's file is wrong, 4 the line cannot be opened or was lost, 5 the board says nothing.)--";

/// A subcommand of `screen`. Its own options stand behind its name, those of the line before or behind.
CLI::App* add(CLI::App& screen, ScreenOptions& options, ExitCode& exit, const char* name, const char* help,
              ExitCode (*body)(const ScreenOptions&), ExitCode (*own)(const ScreenOptions&)) {
    CLI::App* command = screen.add_subcommand(name, help);
    command->fallthrough();
    command->callback([&options, &exit, body, own] {
        exit = guard_screen(options, [&] { return options.control.empty() ? body(options) : own(options); });
    });
    return command;
}

}  // namespace

void add_screen(CLI::App& app, ExitCode& exit) {
    CLI::App* command =
        app.add_subcommand("screen", "Be a touch screen: press buttons, see pages, check a board");
    const auto shared = std::make_shared<ScreenOptions>();
    ScreenOptions& options = *shared;
    command->require_subcommand(1);
    command->footer(examples);
    declare_screen_options(*command, options);

    CLI::App* one =
        add(*command, options, exit, "press", "Press buttons, and print the talk", press, press_own);
    one->add_option("BUTTON", options.buttons,
                    "Paths; 'NAME=5' types a number in, 'File 2' is the second row")
        ->required()
        ->type_name("");
    one->add_flag("--json", options.json, "The talk, judgements and results as JSON lines");
    one->add_flag("-v,--verbose", options.verbose, "Print also what was said before the first touch");

    CLI::App* all =
        add(*command, options, exit, "tour", "Press every button, and check what comes back", tour, tour_own);
    all->add_option("--junit", options.junit, "Write a report that CI servers read")->type_name("FILE");
    all->add_flag("--json", options.json, "The results as one JSON object instead of a table");

    CLI::App* page = add(*command, options, exit, "show", "Open a page, and print it", show, show_own);
    page->add_option("PAGE", options.page, "Its path, or the end of it (Main)")->type_name("");
    CLI::Option* json = page->add_flag("--json", options.json, "The page as one JSON object");
    page->add_option("--png", options.png, "Draw it instead, as the screen does")
        ->type_name("FILE.png")
        ->excludes(json);

    add(*command, options, exit, "interactive", "Show the pages in the terminal, with keyboard and mouse",
        interactive, interactive_own);

    // Keeps the options alive as long as the command line's own objects.
    command->callback([shared] {});
}

}  // namespace fauxboard::tools
