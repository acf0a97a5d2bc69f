#include "tests/support/reference_time.h"
#include "tests/support/printers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace fauxboard::testing {
namespace {

struct Segment {
    double length = 0, nominal = 0, acceleration = 0, safe = 0, entry_limit = 0, entry = 0;
    std::array<double, 4> speed{};
};

class Estimate {
  public:
    explicit Estimate(const filament::Settings& settings) : settings_(settings) {}

    void take(const std::string& text) {
        std::istringstream words(text.substr(0, text.find(';')));
        std::string code;
        words >> code;
        std::map<char, double> values;
        for (std::string word; words >> word;) {
            values[word[0]] = std::atof(word.c_str() + 1);
        }
        if (code == "G90" || code == "G91") {
            relative_ = code == "G91";
        } else if (code == "M82" || code == "M83") {
            relative_e_ = code == "M83";
        } else if (code == "G92") {
            for (const auto& [name, value] : values) {
                at_[axis(name)] = value;
            }
        } else if (code == "G0" || code == "G1") {
            move(values);
        }
    }

    double seconds() {
        double behind = 0;
        for (std::size_t i = segments_.size(); i-- > 0;) {
            Segment& s = segments_[i];
            s.entry = std::min(s.entry_limit, std::sqrt(behind * behind + 2 * s.acceleration * s.length));
            behind = s.entry;
        }
        double sum = 0;
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const Segment& s = segments_[i];
            double exit = 0;
            if (i + 1 < segments_.size()) {
                Segment& next = segments_[i + 1];
                next.entry =
                    std::min(next.entry, std::sqrt(s.entry * s.entry + 2 * s.acceleration * s.length));
                exit = std::min(next.entry, s.nominal);
            }
            sum += time(s, exit);
        }
        return sum;
    }

  private:
    static std::size_t axis(char name) { return std::string("XYZE").find(name); }

    void move(const std::map<char, double>& values) {
        std::array<double, 4> way{};
        for (const auto& [name, value] : values) {
            if (name == 'F') {
                feed_ = value / 60;
                continue;
            }
            const std::size_t i = axis(name);
            way[i] = relative_ || (i == 3 && relative_e_) ? value : value - at_[i];
            at_[i] += way[i];
        }
        Segment s;
        s.length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        s.acceleration = settings_.acceleration_mm_s2;
        if (s.length == 0) {
            s.length = std::abs(way[3]);
            s.acceleration = settings_.retract_acceleration_mm_s2;
        }
        if (s.length == 0) {
            return;
        }
        double slow_down = 1;
        for (std::size_t i = 0; i < 4; ++i) {
            s.speed[i] = feed_ * way[i] / s.length;
            if (std::abs(s.speed[i]) > settings_.velocity_mm_s[i]) {
                slow_down = std::min(slow_down, settings_.velocity_mm_s[i] / std::abs(s.speed[i]));
            }
            const double most = settings_.max_acceleration_mm_s2[i];
            if (s.acceleration * std::abs(way[i]) / s.length > most) {
                s.acceleration = most * s.length / std::abs(way[i]);
            }
        }
        s.nominal = feed_ * slow_down;
        s.safe = s.nominal;
        for (std::size_t i = 0; i < 4; ++i) {
            s.speed[i] *= slow_down;
            if (std::abs(s.speed[i]) > settings_.jerk_mm_s[i]) {
                s.safe = std::min(s.safe, settings_.jerk_mm_s[i]);
            }
        }
        s.entry_limit = segments_.empty() ? s.safe : junction(segments_.back(), s);
        segments_.push_back(s);
    }

    double junction(const Segment& before, const Segment& s) const {
        const bool faster_before = before.nominal > s.nominal;
        const double lower = faster_before ? s.nominal : before.nominal;
        double factor = 1;
        for (std::size_t i = 0; i < 4; ++i) {
            const double exit = before.speed[i] * (faster_before ? s.nominal / before.nominal : 1) * factor;
            const double entry = s.speed[i] * factor;
            double jump = std::abs(exit - entry);
            if ((exit > 0 && entry < 0) || (exit < 0 && entry > 0)) {
                jump = std::max(std::abs(exit), std::abs(entry));
            }
            if (jump > settings_.jerk_mm_s[i]) {
                factor *= settings_.jerk_mm_s[i] / jump;
            }
        }
        const double highest = lower * factor;
        const bool as_good_as_stopping = before.safe > highest * 0.99 && s.safe > highest * 0.99;
        return as_good_as_stopping ? s.safe : highest;
    }

    static double time(const Segment& s, double exit) {
        const double up = (s.nominal * s.nominal - s.entry * s.entry) / (2 * s.acceleration);
        const double down = (s.nominal * s.nominal - exit * exit) / (2 * s.acceleration);
        if (up + down <= s.length) {
            return (s.nominal - s.entry) / s.acceleration + (s.nominal - exit) / s.acceleration +
                   (s.length - up - down) / s.nominal;
        }
        const double meet =
            (2 * s.acceleration * s.length - s.entry * s.entry + exit * exit) / (4 * s.acceleration);
        const double peak =
            std::sqrt(s.entry * s.entry + 2 * s.acceleration * std::clamp(meet, 0.0, s.length));
        return (peak - s.entry) / s.acceleration + std::max(peak - exit, 0.0) / s.acceleration;
    }

    const filament::Settings& settings_;
    std::vector<Segment> segments_;
    std::array<double, 4> at_{};
    double feed_ = 25;
    bool relative_ = false;
    bool relative_e_ = false;
};

}  // namespace

double reference_seconds(std::string_view gcode, const filament::Settings& settings) {
    Estimate estimate(settings);
    std::istringstream lines{std::string(gcode)};
    for (std::string line; std::getline(lines, line);) {
        estimate.take(line);
    }
    return estimate.seconds();
}

}  // namespace fauxboard::testing
