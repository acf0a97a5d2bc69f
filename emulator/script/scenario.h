#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/fault/spec.h"
#include "emulator/screen/screen_profile.h"
#include "emulator/script/pattern.h"
#include "emulator/script/units.h"

namespace fauxboard::behaviour {
struct Document;
}

namespace fauxboard::script {

using behaviour::Json;

struct StepKind;

/// Who plays: what a scenario is checked against, and what it is played with.
struct Cast {
    std::shared_ptr<const behaviour::Profile> profile;
    std::shared_ptr<const screen::ScreenProfile> screen;  ///< null: none in this process
};

/// A place in a scenario's files.
struct Where {
    std::string file;
    std::size_t line = 0;
    std::string pointer;
};

/// Something that can be waited for.
struct Trigger {
    enum class Kind : std::uint8_t {
        time,
        request,       ///< a line that the board took from the screen
        line,          ///< a line that the board said to the screen
        host_request,  ///< a line that the board took from its USB side
        host_line,     ///< a line that the board said there
        event,
        field,
        page,    ///< the virtual screen has it open
        shows,   ///< the virtual screen shows a text that matches
        judged,  ///< the virtual screen took a line otherwise than it was meant, in words that match
    };
    Kind kind = Kind::time;
    SimTime time{0};
    std::shared_ptr<const Pattern> pattern;
    machine::EventId event{};
    std::vector<behaviour::Condition> conditions;
    std::vector<std::string> fields;  ///< those that the conditions look at
    std::size_t page = 0;
    std::string words;  ///< "the event motion.homed (...)"

    /// Something that is so or not, and must be looked at; the others happen.
    bool is_state() const {
        return kind == Kind::field || kind == Kind::page || kind == Kind::shows || kind == Kind::judged;
    }
};

struct Step;

/// Steps one after the other.
struct Block {
    std::string name;
    std::vector<Step> steps;
};

/// One step, checked and compiled. Which members count is the business of its kind.
struct Step {
    const StepKind* kind = nullptr;
    Where where;
    std::string why;    ///< the author's sentence, may be empty
    std::string words;  ///< ours

    // Watches: wait, expect, expect_next, never.
    Trigger trigger;
    SimTime within{0};                                     ///< of virtual time
    std::optional<SimTime> real;                           ///< of real time; nothing: by default
    std::vector<std::shared_ptr<const Pattern>> ignoring;  ///< lines that expect_next looks over
    bool next = false;                                     ///< the very next line has to be it
    bool now = false;                                      ///< it has to be so at once

    // Acts: do, set, send, request, host, press, touch, screenshot, fault, clear, note, upload.
    std::vector<behaviour::ActionCall> calls;
    std::optional<behaviour::Send> frame;
    std::string bytes;      ///< for the line; of a file
    bool numbered = false;  ///< they get the number that the board expects, and a checksum
    std::string text;       ///< a button, a control, a fault's name, a note, a file's name
    int x = 0;              ///< a pixel to touch, when there is no text
    int y = 0;
    SimTime lasts{0};  ///< of a touch
    std::optional<fault::FaultSpec> fault;

    // Blocks: repeat, together, include, never with steps.
    std::vector<Block> blocks;
    std::optional<std::uint64_t> rounds = 1;  ///< nothing: without end
    bool guards = false;                      ///< `trigger` must not come meanwhile
    bool until = false;                       ///< `trigger` ends the rounds
    bool until_first = false;                 ///< of branches: the others are given up when one is through

    /// Values of it are known only when it is its turn: it is compiled anew then.
    bool dynamic = false;
    std::shared_ptr<const behaviour::Document> document;  ///< where it stands; dynamic steps only
    std::shared_ptr<const Json> source;                   ///< dynamic steps only
};

/// A scenario, checked against a board and a screen. Immutable.
class Scenario {
  public:
    std::string name;
    std::string title;
    Cast cast;
    std::vector<std::string> files;  ///< what it was read from
    Block main;
    std::size_t steps = 0;                                        ///< all of them, those of blocks included
    std::vector<std::pair<std::string, std::string>> parameters;  ///< name and value as JSON
    /// What is on its SD card, when it brings one.
    std::shared_ptr<const std::vector<machine::BuiltInEntry>> card;
    /// Limits of steps that give none.
    struct Limits {
        SimTime wait = std::chrono::seconds(60);
        SimTime expect = std::chrono::seconds(2);
    } limits;
};

}  // namespace fauxboard::script
