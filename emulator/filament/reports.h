#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {

/// What a board tells by itself every so many seconds, whatever else it does: M155, M154 and M27 S. The first
/// report comes one interval after it was asked for.
class Reports {
  public:
    enum class Kind : std::uint8_t { temperatures, position, job };
    static constexpr std::size_t kinds = 3;

    void power_on() { *this = Reports{}; }
    /// 0 ends them.
    void set(Kind kind, double seconds, SimTime now) {
        Report& report = reports_[static_cast<std::size_t>(kind)];
        report.seconds = seconds;
        report.due = seconds > 0 ? now + from_seconds(seconds) : never;
    }
    double seconds(Kind kind) const { return reports_[static_cast<std::size_t>(kind)].seconds; }

    void advance(SimTime now, EventQueue& events) {
        constexpr std::array raised{event("report.temperatures"), event("report.position"),
                                    event("report.job")};
        for (std::size_t i = 0; i < kinds; ++i) {
            if (reports_[i].due <= now) {
                reports_[i].due += from_seconds(reports_[i].seconds);
                events.raise(raised[i]);
            }
        }
    }
    SimTime next_event() const {
        return machine::earliest(reports_[0].due, reports_[1].due, reports_[2].due);
    }

  private:
    struct Report {
        double seconds = 0;
        SimTime due = never;
    };
    std::array<Report, kinds> reports_{};
};

}  // namespace fauxboard::filament
