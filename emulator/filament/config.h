#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/filament/heating_wait.h"
#include "emulator/filament/thermal_config.h"
#include "emulator/machine/events.h"
#include "emulator/machine/machine_config.h"

namespace fauxboard::filament {

enum class Axis : std::uint8_t { x, y, z, e };
inline constexpr std::size_t axis_count = 4;
using AxisValues = std::array<double, axis_count>;
using AxisTargets = std::array<std::optional<double>, axis_count>;

/// One step of a motion procedure. Profiles list them; `Motion` carries them out.
struct ProcedureStep {
    enum class Kind : std::uint8_t {
        zero,         ///< call the present place of the axes 0, as homing does before it moves
        home,         ///< run the axes into their end stops, one after the other
        to,           ///< go to absolute coordinates, mm
        by,           ///< go by a distance, mm
        probe,        ///< touch the bed here; Z becomes the measured height
        homed,        ///< from here on the axes count as homed
        wait,         ///< stand still
        lose_rounds,  ///< the schedule leaves out whole rounds (seen during every G28)
        raise,        ///< raise an event
    };
    // In an order that leaves no gaps: Motion holds 64 of them.
    Kind kind = Kind::wait;
    bool reference = false;  ///< probe: what it touches here is what heights count from, as when homing Z
    int rounds = 0;          ///< lose_rounds
    AxisTargets values{};    ///< to, by: mm. zero, home, homed: present = axis named
    double feed_mm_s = 0;    ///< shown as F while it runs; 0 leaves the shown value alone
    double seconds = -1;     ///< fixed duration; < 0: from distance and feed
    machine::EventId event = nullptr;  ///< raise
    bool together = false;             ///< home: all axes at the same time
    double bump_s = -1;  ///< home: second, slow touch of the end stops; < 0: as for every axis of the machine
    int mesh_point = -1;   ///< probe: what it measures is that point of the mesh, 0 to 8
    bool repeats = false;  ///< probe: one of a series at this place
};
using Procedure = std::vector<ProcedureStep>;

struct MotionConfig {
    std::array<double, 3> volume_mm{320, 320, 420};
    /// Where the head stands when the board is switched on: it reports 0, but homing takes as long as the way
    /// is.
    std::array<double, 3> power_on_mm{160, 200, 30};
    double homing_feed_mm_s = 20;
    double homing_bump_s = 4.5;    ///< per axis: second, slow touch of the end stop
    unsigned planner_blocks = 16;  ///< moves accepted ahead of the one being executed
    double default_feed_mm_s = 25;
    /// Height of the bed above its nominal plane at 3 x 3 points, mm; rows front to back.
    std::array<std::array<double, 3>, 3> bed_mesh_mm{};
    double probe_trigger_mm = 2.5;  ///< logical Z at which the probe touches the nominal plane
    std::array<double, 2> probe_offset_mm{-38.2, 0};
    double probe_spread_mm = 0;  ///< standard deviation of touches at one place (M48); all else is exact
    /// The motors switch themselves off so long after the last move, unless a job is under way; 0: never.
    double idle_off_s = 0;
    std::map<std::string, Procedure, std::less<>> procedures;
};

struct FilamentConfig {
    double piece_s = 0.7197;       ///< one piece of endless loading; measured over 105 pieces
    double piece_commit_s = 0.25;  ///< a stop later than this into a piece waits for the piece's end
    int feed_mm_s = 1;             ///< shown as F and FR while loading
    double min_extrude_c = 170;
    /// A detector that feels the filament move, instead of whether it is there, calls it out after so much
    /// was extruded and nothing moved; 0: it is a switch, as on the A30T.
    double detector_mm = 0;
};

struct JobConfig {
    /// How long a finished job is shown (PS:4) before the board is idle again. No request of the screens says
    /// that the page was left, and the A30's opens its file list only while idle.
    double finished_s = 10;
    /// A pause throws the planned moves away; else they are finished first.
    bool pause_at_once = false;
    /// A job that was cut off is paused at the next start, as if the user had paused it.
    bool cut_off_is_paused = false;
    /// A job that is taken up, cut off or paused, homes X and Y before it heats, and a pause counts as cut
    /// off.
    bool resume_homes_first = false;
};

/// The fan of the control board.
struct BoardFanConfig {
    int percent = 50;        ///< fixed speed; of a fan that runs by itself, its speed before it does
    bool automatic = false;  ///< it runs by itself, and M106 P2 holds until that changes
    int idle_percent = 71;
    int busy_percent = 100;  ///< while printing, or with a heater's target beyond these
    double nozzle_c = 50;
    double bed_c = 35;
    double starts_s = 0;  ///< from power-on
    int least_pwm = 0;    ///< of the part fan: a smaller value, unless 0, counts as this
};

/// What a board does against filament that is pulled through a cold nozzle (Marlin's
/// PREVENT_COLD_EXTRUSION).
struct ExtrusionConfig {
    bool guarded = false;   ///< by the bound of FilamentConfig, until M302 says otherwise
    double longest_mm = 0;  ///< of one move; 0: any
};

/// What a profile can say about a printer that melts filament.
struct Config : machine::MachineConfig {
    ThermalConfig thermal;
    MotionConfig motion;
    FilamentConfig filament;
    JobConfig job;
    HeatingWaitConfig heating;
    ExtrusionConfig extrusion;
    BoardFanConfig board_fan;
    double manual_level_start_mm = 8.0;
};

}  // namespace fauxboard::filament
