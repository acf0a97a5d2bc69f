#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/filament/gcode_codes.h"
#include "emulator/machine/machine_config.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

/// Everything a job needs to go on after the power was gone: where the move under way began, in the file and
/// in the machine.
struct JobPlace {
    int volume = 0;
    std::string path;         ///< on its disk
    std::uint64_t bytes = 0;  ///< size of the file: another one of that name is another file
    std::uint64_t byte = 0;   ///< start of the line to go on with
    int layer = 0;
    int layers = 0;
    SimTime elapsed{0};  ///< printed so far
    AxisValues at{};     ///< mm
    double nozzle_c = 0;
    double bed_c = 0;
    int part_fan_percent = 0;
    int speed_percent = 100;
    int flow_percent = 100;
    GcodeModal modal;
    bool relative = false;
    bool relative_e = false;
};

/// Where the place of a job outlives the board. keep() is called for every move: it must be quick, and a kill
/// at any moment must leave the place kept before or the new one.
class JobPlaceStore {
  public:
    virtual ~JobPlaceStore() = default;
    /// The place kept last; nothing when it was dropped, or never kept, or is broken.
    virtual std::optional<JobPlace> load() = 0;
    virtual void keep(const JobPlace& place) = 0;
    virtual void drop() = 0;
};

}  // namespace fauxboard::machine
