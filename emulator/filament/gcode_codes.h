#pragma once

#include <array>
#include <cstdint>

#include "emulator/filament/arc.h"
#include "emulator/filament/autotune.h"
#include "emulator/filament/names.h"
#include "emulator/machine/commands.h"
#include "emulator/machine/job_control.h"

namespace fauxboard::filament {

class HeatingWait;
class HostCommands;
class Mixer;
class Motion;
class Procedures;
class Thermal;
struct ExtrusionGuard;
struct Fans;
struct GcodeLine;
struct MotionConfig;
struct Settings;
struct ToldText;

/// What codes set for all that come after them, whoever sends those: the firmware has it once.
struct GcodeModal {
    double unit_mm = 1;  ///< G20, G21
    double feed_mm_s = 25;
    std::array<double, 3> weights{};  ///< M163, until M164
    int kept_speed_percent = 100;     ///< M220 B, until M220 R
};

/// What codes act on.
struct GcodeMachine {
    Motion& motion;
    Procedures& moves;
    Thermal& thermal;
    HeatingWait& wait;
    Mixer& mixer;
    Fans& fans;
    Settings& settings;
    GcodeModal& modal;
    Job& job;
    EventQueue& events;
    machine::JobControl& control;
    machine::Commands& commands;
    HostCommands& host;
    ExtrusionGuard& guard;
    ToldText& told;
    const MotionConfig& config;
    Autotune& autotuned;
};

/// Where codes come from (the file of a job, the USB side): each does one thing after the other.
struct GcodeSource {
    GcodeMachine& on;
    bool of_job = false;      ///< the file of a job
    ArcSegments arc{};        ///< the rest of a G2 or G3 under way
    SimTime now{0};           ///< when the line is carried out
    SimTime wake{0};          ///< the next one not before (G4)
    std::uint64_t byte = 0;   ///< where the line begins in its file
    std::uint64_t next = 0;   ///< where the line after it begins
    std::uint64_t moves = 0;  ///< G0 to G3 carried out
};

/// What must be so before a code is carried out.
enum class Needs : std::uint8_t {
    nothing,
    room,  ///< in the planner
    rest,  ///< all moves before it are done (the firmware's st_synchronize())
    turn,  ///< nobody waits for a temperature
};

/// What a code does.
struct GcodeCode {
    char letter;
    int code;
    Needs needs;
    void (*run)(GcodeSource&, const GcodeLine&);
    bool blocks = false;   ///< over only when what it moves is at rest again
    bool by_rule = false;  ///< carried out only where a profile's rule says so: few boards know it
};

/// Carries the code out; false when there is none, or it wants a rule and there is none.
bool run_code(const GcodeCode* code, bool by_rule, GcodeSource& source, const GcodeLine& line);

/// The row of a code; nullptr when it is unknown.
const GcodeCode* find_code(char letter, int code);

/// Plans the next straight piece of the source's arc; there must be one, and room for it.
void stream_arc(GcodeSource& source);

}  // namespace fauxboard::filament
