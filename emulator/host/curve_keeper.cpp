#include "emulator/host/curve_keeper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace fauxboard::host {
namespace {

using control::Json;

/// Which fields make a curve: temperatures of any name, and what moves while a print grows.
struct Rule {
    std::string_view unit;
    std::string_view ending;
};
constexpr std::array rules{Rule{"C", ".true"},        Rule{"C", ".target"},
                           Rule{"C", ".temperature"}, Rule{"mm", "position.z"},
                           Rule{"mm", "resin.z"},     Rule{"mm", "platform.height"},
                           Rule{"%", "job.progress"}, Rule{"%", "print.percent"}};

bool makes_curve(const behaviour::Field& field) {
    const bool asked_for = field.path.ends_with(".target");
    return (field.set == nullptr || asked_for) &&
           std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) {
               return field.unit == rule.unit && field.path.ends_with(rule.ending);
           });
}

float number(const Json& value) {
    return value.is_number() ? value.get<float>() : std::numeric_limits<float>::quiet_NaN();
}

/// Short: what a curve shows, not what a double holds.
Json shown(float value) {
    return std::isfinite(value) ? Json(std::round(double{value} * 1000) / 1000) : Json(nullptr);
}

}  // namespace

std::vector<control::Place> curve_places(const board::Board& board) {
    std::vector<control::Place> out;
    for (control::Place& place : control::all_places(board)) {
        if (out.size() < CurveKeeper::most_series && place.field != nullptr && makes_curve(*place.field) &&
            control::value_of(board, place).is_number()) {
            out.push_back(std::move(place));
        }
    }
    return out;
}

SimTime CurveKeeper::take(const board::Board& board, SimTime now) {
    if (now < due_) {
        return due_;
    }
    if (!std::exchange(chosen_, true)) {
        series_ = curve_places(board);
    }
    if (times_.size() == most_points) {
        thin();
    }
    times_.push_back(static_cast<float>(machine::to_seconds(now)));
    for (const control::Place& place : series_) {
        values_.push_back(number(control::value_of(board, place)));
    }
    due_ = now + every;
    return due_;
}

void CurveKeeper::thin() {
    const std::size_t wide = series_.size();
    std::size_t to = 0;
    for (std::size_t from = 0; from < times_.size(); ++from) {
        if (from < most_points / 2 && from % 2 != 0) {
            continue;
        }
        times_[to] = times_[from];
        std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(from * wide), wide,
                    values_.begin() + static_cast<std::ptrdiff_t>(to * wide));
        ++to;
    }
    times_.resize(to);
    values_.resize(to * wide);
}

Json CurveKeeper::to_json() const {
    Json out{{"series", Json::array()}, {"t", Json::array()}, {"values", Json::array()}};
    for (const float t : times_) {
        out["t"].push_back(shown(t));
    }
    for (std::size_t i = 0; i < series_.size(); ++i) {
        const behaviour::Field& field = *series_[i].field;
        out["series"].push_back({{"path", field.path}, {"unit", field.unit}, {"help", field.help}});
        Json column = Json::array();
        for (std::size_t at = i; at < values_.size(); at += series_.size()) {
            column.push_back(shown(values_[at]));
        }
        out["values"].push_back(std::move(column));
    }
    return out;
}

}  // namespace fauxboard::host
