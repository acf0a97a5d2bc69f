#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/filament/config.h"
#include "emulator/filament/gcode_codes.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {

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

/// The place as bytes, into `out`; empty when its path is too long to be kept.
void put_place(const JobPlace& place, std::string& out);
/// The place that the bytes say; nothing when they cannot be one.
std::optional<JobPlace> place_from(std::string_view bytes);

}  // namespace fauxboard::filament
