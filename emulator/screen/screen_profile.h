#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/source.h"
#include "emulator/machine/sim_time.h"
#include "emulator/screen/display.h"
#include "emulator/screen/expression.h"
#include "emulator/screen/judgement.h"
#include "emulator/screen/values.h"

namespace fauxboard::screen {

/// How the screen hears and speaks.
struct LineRules {
    bool framed_in =
        false;  ///< takes frames with a right checksum only; else looks for its codes in any line
    bool framed_out = false;          ///< sends "N-0 body*XOR"; else bare lines
    std::size_t buffer_bytes = 1279;  ///< the receiving ring; a line that fills it is lost
    SimTime byte_time{0};  ///< a byte takes so long on the line; 0: what comes together is there at once
    SimTime tick{20'000};  ///< it looks into the ring so often
    SimTime answer_after{12'000};  ///< an answer leaves no sooner after the line came
    SimTime deaf{1'200'000};       ///< from power-on; what comes meanwhile is lost
    std::size_t code_within = 8;   ///< the L must stand in so many first bytes
    std::string hello;             ///< said once it hears, as it stands, line end included
    bool lf_only = false;       ///< lines end with LF, both ways; a CR is part of one. Else CR ends one, too
    bool skips_blanks = false;  ///< those at the start of a line
    std::size_t jams_at = 0;    ///< a line of so many bytes: it never reads again; 0: none does
};

/// How one key of a frame is read.
struct Read {
    enum class As : std::uint8_t {
        u8,
        u16,
        i32,
        real,
        text,
        mark,
        list_start,
        list_entry,
        list_end,
        list_append
    };
    enum class From : std::uint8_t { last, start, column };
    enum class Bad : std::uint8_t { drop_rest, crash, zero, cut };

    std::string key;  ///< found as C's strstr does; empty: right here
    From from = From::last;
    std::size_t column = 0;
    As as = As::real;
    std::optional<std::size_t> into;  ///< value; for list_start, list_entry and list_append a list
    std::optional<double> min;
    std::optional<double> max;
    bool bounds_first =
        false;  ///< the bounds are those of the number as it was read, before it is cut to its kind
    Bad outside = Bad::drop_rest;
    std::string until;          ///< texts: what ends them; empty: the end of the line
    std::size_t less = 0;       ///< texts: so many bytes before `until` do not belong to it
    std::size_t min_bytes = 0;  ///< texts: a shorter one is not taken
    std::size_t max_bytes = 0;  ///< texts: room; 0 no limit
    Bad too_long = Bad::cut;
    Bad no_end = Bad::drop_rest;
    std::string why;         ///< said when it is outside, too long or without end
    std::string bug;         ///< said whenever it is read: the screen takes it as something else
    std::vector<Read> then;  ///< read only if this one was found, from where it ended
};

struct Send {
    std::vector<Condition> when;
    Template line;  ///< the body
};

/// One way to take a frame; the first whose words all stand in the line, and whose conditions hold.
struct FrameCase {
    std::vector<std::string> has;
    std::vector<std::string> lacks;  ///< none of them may stand in the line
    std::vector<Condition> when;
    std::string ignored;            ///< not empty: known and of no effect, and why
    Verdict verdict = Verdict::ok;  ///< what a line taken so does to the screen beside what it brings
    std::string why;                ///< of `verdict`
    std::vector<Read> read;
    std::vector<Assign> assume;        ///< after it was read
    bool acknowledges = false;         ///< it ends the command that is under way
    std::vector<std::string> answers;  ///< the waits that it ends; see TalkRules::Wait
    bool forgets = false;              ///< the board started anew: nothing is under way any more
    std::vector<Target> opens;
    std::vector<Send> answer;
    bool restarts = false;
};

struct FrameRule {
    std::string name;       ///< "L3", or the words a line without code starts with
    std::string title;      ///< "temperatures"
    bool anywhere = false;  ///< the words may stand anywhere; a line that no case is for goes on
    bool goes_on = false;   ///< the rules below it take the line, too
    std::vector<FrameCase> cases;
};

/// How a screen speaks that sends one command at a time and waits for its acknowledgement.
struct TalkRules {
    /// What the screen asks again and again.
    struct Poll {
        SimTime every{0};
        std::vector<Condition> when;
        std::vector<Assign> assume;  ///< each time, before anything is sent
        std::vector<Send> send;      ///< not again while the same still waits for its turn
    };
    /// A command for whose answer it waits with everything else shut: an acknowledgement alone does not do.
    struct Wait {
        std::string command;  ///< how it starts: "M21"
        std::string why;      ///< what becomes of the screen without the answer
    };
    bool queued = false;  ///< else everything is sent at once and nothing is waited for
    std::size_t most_waiting = 64;
    SimTime timeout{15'000'000};       ///< without a line for so long, it gives up waiting
    std::string timed_out;             ///< what it says then
    std::vector<std::string> at_once;  ///< commands that overtake, and are not waited for
    std::vector<Poll> polls;
    std::vector<Wait> waits;
};

/// One frame or line that must come back.
struct Expectation {
    std::string frame;              ///< "L24"; empty: `line` counts
    std::string line;               ///< how a line must start, frame taken off
    std::vector<std::size_t> with;  ///< values it must carry
    std::vector<Condition> where;   ///< what those values must be
    SimTime within{500'000};
};

/// One step of the tour before it touches a button.
struct Prepare {
    enum class Kind : std::uint8_t { press, receive, wait_for, wait };
    Kind kind = Kind::press;
    std::vector<Condition> when;  ///< else the step is left out
    std::string text;             ///< press: a path; receive: the body of a frame shown to the screen
    std::vector<Condition> until;
    SimTime limit{0};
};

/// A number that a person types in.
struct Input {
    double normally = 0;
    double min = 0;
    double max = 0;
};

struct Button {
    std::string path;            ///< "Control/Move/X+ (30mm)"
    std::string name;            ///< "X+ (30mm)"
    Template label;              ///< what stands on it
    std::size_t page = no_page;  ///< no_page: stands on every page that does not leave it out
    std::vector<Condition> when;
    std::vector<Assign> assume;  ///< what the screen takes for granted from then on, before it sends
    std::vector<Send> send;
    std::vector<Target> leads_to;
    std::vector<Expectation> expect;  ///< empty: silence
    std::vector<Prepare> prepare;
    SimTime settle{0};  ///< the machine is busy so long after the last expectation
    std::optional<Input> input;
    std::optional<std::size_t> rows;  ///< stands once per entry of this list
    std::optional<Control> control;   ///< on a board's own screen
};

struct Page {
    std::string path;  ///< "Control/Move"
    std::string title;
    std::size_t parent = no_page;
    std::vector<Template> shows;
    std::vector<std::size_t> buttons;    ///< in the order of the profile, those of every page last
    std::vector<Condition> open_when;    ///< else it stays shut
    std::vector<Assign> assume;          ///< on opening
    std::vector<Send> send;              ///< on opening
    std::vector<Expectation> expect;     ///< what must come back then
    bool stays = false;                  ///< does not fall back when nobody touches it
    std::vector<std::string> opened_by;  ///< bodies of frames that open it, for the tour
    PageFace face;                       ///< on a board's own screen
};

/// A screen, checked and compiled. Immutable; many screens may share it.
class ScreenProfile {
  public:
    std::string name;
    std::string title;
    std::vector<std::string> files;    ///< what it was read from, base first
    std::vector<std::string> assumed;  ///< what no source says, a sentence each
    LineRules line;
    TalkRules talk;
    ValueTable values;
    std::map<unsigned, FrameRule> codes;  ///< L codes
    std::vector<FrameRule> words;         ///< lines without one
    std::vector<Page> pages;
    std::vector<Button> buttons;  ///< in the order in which the tour presses them
    std::size_t main_page = 0;
    SimTime idle{15'000'000};  ///< without a touch for so long, most pages fall back
    std::vector<Target> idle_target;
    SimTime silence{500'000};          ///< so long the tour listens where nothing must come
    std::vector<Prepare> tour_first;   ///< before the first button
    std::vector<std::string> unasked;  ///< frames and lines the board sends by itself
    std::optional<Display> display;    ///< of a board's own screen; nothing: it hangs on a line

    std::optional<std::size_t> find_page(std::string_view path) const;
    /// The names of the frames that set this value: "L2, L6".
    std::string sources(std::size_t value) const;
};

/// Checks and compiles a screen profile. Throws behaviour::ProfileError with everything that is wrong.
std::shared_ptr<const ScreenProfile> load_screen(const behaviour::SourceText& source,
                                                 const behaviour::SourceFinder& find);

}  // namespace fauxboard::screen
