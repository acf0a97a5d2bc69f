#pragma once

#include <array>
#include <cstdint>

#include "emulator/filament/arc.h"
#include "emulator/filament/names.h"
#include "emulator/machine/job_control.h"

namespace fauxboard::filament {

class HeatingWait;
class Mixer;
class Motion;
class Procedures;
class Thermal;
struct Fans;
struct GcodeLine;
struct Settings;

/// What codes set for all that come after them, whoever sends those: the firmware has it once.
struct GcodeModal {
    double unit_mm = 1;  ///< G20, G21
    double feed_mm_s = 25;
    std::array<double, 3> weights{};  ///< M163, until M164
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
};

/// Where codes come from (the file of a job, the USB side): each does one thing after the other.
struct GcodeSource {
    GcodeMachine& on;
    ArcSegments arc{};        ///< the rest of a G2 or G3 under way
    SimTime now{0};           ///< when the line is carried out
    SimTime wake{0};          ///< the next one not before (G4)
    std::uint64_t byte = 0;   ///< where the line begins in its file
    std::uint64_t moves = 0;  ///< G0 to G3 carried out
};

/// What a code does.
struct GcodeCode {
    char letter;
    int code;
    bool at_rest;  ///< only when all moves before it are done (the firmware's st_synchronize())
    void (*run)(GcodeSource&, const GcodeLine&);
    bool blocks = false;  ///< over only when what it moves is at rest again
};

/// The row of a code; nullptr when it is unknown.
const GcodeCode* find_code(char letter, int code);

/// Plans the next straight piece of the source's arc; there must be one, and room for it.
void stream_arc(GcodeSource& source);

}  // namespace fauxboard::filament
