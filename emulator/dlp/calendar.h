#pragma once

#include <chrono>
#include <cstdint>

#include "emulator/dlp/time.h"

namespace fauxboard::dlp {

/// A date and a time of day, as the board's clock has them.
struct Moment {
    int year = 2020;  ///< 2000 to 2099
    int month = 9;
    int day = 15;
    int hour = 7;
    int minute = 56;
    int second = 0;

    bool operator==(const Moment&) const = default;
};

inline int month_length(int year, int month) {
    using namespace std::chrono;
    return static_cast<int>(static_cast<unsigned>(
        (std::chrono::year(year) / std::chrono::month(static_cast<unsigned>(month)) / last).day()));
}

/// The board's clock, which runs on while the board is off. Never set, it begins on 15 Sep 2020, 07:56.
class Calendar {
  public:
    void set(const Moment& moment, SimTime now) {
        using namespace std::chrono;
        const auto day = sys_days(year(moment.year) / month(static_cast<unsigned>(moment.month)) /
                                  std::chrono::day(static_cast<unsigned>(moment.day)));
        at_zero_ = day.time_since_epoch() + hours(moment.hour) + minutes(moment.minute) +
                   seconds(moment.second) - floor<microseconds>(now);
    }
    Moment at(SimTime now) const {
        using namespace std::chrono;
        const auto time = floor<seconds>(at_zero_ + now);
        const auto days_now = floor<days>(time);
        const year_month_day date{sys_days(days_now)};
        const hh_mm_ss<seconds> of_day(time - days_now);
        return {static_cast<int>(date.year()),
                static_cast<int>(static_cast<unsigned>(date.month())),
                static_cast<int>(static_cast<unsigned>(date.day())),
                static_cast<int>(of_day.hours().count()),
                static_cast<int>(of_day.minutes().count()),
                static_cast<int>(of_day.seconds().count())};
    }
    /// 1 Monday to 7 Sunday.
    int weekday(SimTime now) const {
        using namespace std::chrono;
        return static_cast<int>(std::chrono::weekday(sys_days(floor<days>(at_zero_ + now))).iso_encoding());
    }

  private:
    static constexpr std::int64_t never_set_s = 1'600'156'560;  // 15 Sep 2020, 07:56:00
    SimTime at_zero_{never_set_s * 1'000'000};
};

/// A clock chip beside the board (DS3231), which 0.08 goes by when its settings say so.
struct ExternalClock {
    Calendar calendar;
    bool dead = false;  ///< it does not answer
};

}  // namespace fauxboard::dlp
