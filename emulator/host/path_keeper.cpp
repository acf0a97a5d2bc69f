#include "emulator/host/path_keeper.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fauxboard::host {
namespace {

using control::Json;

/// What tells two layers apart; the thinnest are 0.04 mm.
constexpr double same_layer_mm = 0.015;

Json shown(float mm) {
    return std::round(double{mm} * 100) / 100;
}

}  // namespace

void PathKeeper::add(const filament::Travel& travel) {
    if (!travel.draws) {
        drawing_ = false;
        return;
    }
    if (!layer_ || std::abs(layer_->z - travel.z) > same_layer_mm) {
        below_ = std::exchange(layer_, Layer{travel.z, {}, {}});
        told_ = 0;
        told_layer_ = false;
        drawing_ = false;
    }
    std::vector<float>& points = layer_->points;
    if (points.size() / 2 + 2 > most_points) {
        return;
    }
    if (!std::exchange(drawing_, true)) {
        layer_->breaks.push_back(points.size());
        points.push_back(static_cast<float>(travel.from_x));
        points.push_back(static_cast<float>(travel.from_y));
    }
    points.push_back(static_cast<float>(travel.to_x));
    points.push_back(static_cast<float>(travel.to_y));
}

/// The lines of a layer from one of its points on; one that was under way there begins with the point before.
Json PathKeeper::lines(const Layer& layer, std::size_t from) {
    Json out = Json::array();
    for (std::size_t i = 0; i < layer.breaks.size(); ++i) {
        const std::size_t end = i + 1 < layer.breaks.size() ? layer.breaks[i + 1] : layer.points.size();
        if (end <= from) {
            continue;
        }
        std::size_t at = std::max(layer.breaks[i], from);
        if (at != layer.breaks[i]) {
            at -= 2;
        }
        Json line = Json::array();
        for (; at < end; ++at) {
            line.push_back(shown(layer.points[at]));
        }
        out.push_back(std::move(line));
    }
    return out;
}

Json PathKeeper::whole() const {
    Json out = Json::array();
    for (const auto* layer : {&below_, &layer_}) {
        if (*layer) {
            out.push_back({{"z", (*layer)->z}, {"d", lines(**layer, 0)}});
        }
    }
    return out;
}

Json PathKeeper::news() {
    if (!layer_ || (told_layer_ && told_ == layer_->points.size())) {
        return Json::array();
    }
    Json out = told_layer_ ? Json{{{"z", layer_->z}, {"d", lines(*layer_, told_)}}} : whole();
    told_layer_ = true;
    told_ = layer_->points.size();
    return out;
}

}  // namespace fauxboard::host
