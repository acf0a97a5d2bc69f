#include "emulator/filament/procedures.h"

#include <array>

namespace fauxboard::filament {
namespace {

constexpr unsigned all_axes = 7;
/// Homes a machine that knows where it is, where that differs.
constexpr std::string_view home_known = "home_known";

}  // namespace

bool Procedures::run(std::string_view procedure, SimTime now) {
    const auto hit = config_.procedures.find(procedure);
    motion_.faults().probe_alarm = leveling_.probe_alarm;
    const bool taken = hit != config_.procedures.end() && motion_.run(hit->second, now, events_);
    tell_loop();
    return taken;
}

bool Procedures::home(unsigned mask, SimTime now) {
    if (mask == 0 || mask == all_axes) {
        const bool known = motion_.homed() && config_.procedures.contains(home_known);
        return run(known ? home_known : "home", now);
    }
    constexpr std::array<std::string_view, 3> names{"home_x", "home_y", "home_z"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if ((mask & (1U << i)) != 0 && !run(names[i], now)) {
            return false;
        }
    }
    return true;
}

void Procedures::advance(SimTime now) {
    motion_.faults().probe_alarm = leveling_.probe_alarm;
    motion_.advance(now, events_);
    tell_loop();
}

}  // namespace fauxboard::filament
