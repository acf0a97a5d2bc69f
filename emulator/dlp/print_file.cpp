#include "emulator/dlp/print_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emulator/dlp/panel_line.h"

namespace fauxboard::dlp {
namespace {

using sliced::Outcome;

// What the board takes for a file of the first version, which says nothing of lifts.
constexpr double first_lift_mm = 5;
constexpr double first_mm_s = 2;
constexpr double seconds_per_min = 60;

void take_lift(const std::optional<sliced::Lift>& lift, LayerPlan& plan) {
    if (!lift) {
        return;
    }
    plan.lift_mm = static_cast<double>(lift->mm);
    plan.lift_mm_s = static_cast<double>(lift->mm_min) / seconds_per_min;
    // What does not say how fast it comes down comes down as it went up.
    plan.drop_mm_s =
        static_cast<double>(lift->retract_mm_min > 0 ? lift->retract_mm_min : lift->mm_min) / seconds_per_min;
}

/// Up or down by a lift, as the board reckons: too long where the speed is not reached on the way up.
double way_s(double mm, double mm_s, double mm_s2, double unreached_mm) {
    constexpr double factor = 1.414;
    const double speed = std::max(mm_s, 0.01);
    if (speed * speed / (2 * mm_s2) > mm / 2) {
        return 2 * factor * std::sqrt(unreached_mm / mm_s2);
    }
    return (mm - speed * speed / mm_s2) / speed + 2 * speed / mm_s2;
}

}  // namespace

double picture_load_s(Firmware firmware) {
    return firmware == Firmware::v008 ? 0.362 : 0.53;
}

Outcome<PrintFile> PrintFile::open(const sliced::ByteSource& source) {
    using Result = Outcome<PrintFile>;
    auto opened = sliced::SlicedFile::open(source);
    if (!opened) {
        return Result::failure(opened.problem());
    }
    PrintFile out(std::move(*opened));
    const sliced::Header& header = out.file_.header();
    if (header.width != panel_columns || header.height != panel_lines) {
        return Result::failure(fmt::format("Its pictures have {} x {} pixels; this panel has {} x {}.",
                                           header.width, header.height, panel_columns, panel_lines));
    }
    LayerPlan& common = out.common_;
    common.exposure_s = static_cast<double>(header.exposure_s);
    common.light_off_s = static_cast<double>(header.light_off_s);
    common.lift_mm = first_lift_mm;
    common.lift_mm_s = common.drop_mm_s = first_mm_s;
    take_lift(header.lift, common);
    out.bottom_exposure_s_ = static_cast<double>(header.bottom_exposure_s);
    return out;
}

Outcome<LayerPlan> PrintFile::layer(const sliced::ByteSource& source, std::uint32_t n) const {
    const auto record = file_.layer(source, n);
    if (!record) {
        return Outcome<LayerPlan>::failure(record.problem());
    }
    LayerPlan plan = common_;
    plan.z_mm = static_cast<double>(record->z_mm);
    plan.exposure_s = static_cast<double>(record->exposure_s);
    plan.light_off_s = static_cast<double>(record->light_off_s);
    take_lift(record->lift, plan);
    return plan;
}

Outcome<sliced::PictureRuns> PrintFile::picture(const sliced::ByteSource& source, std::uint32_t n,
                                                std::uint32_t sublayer) const {
    const auto record = file_.layer(source, n, sublayer);
    if (!record) {
        return Outcome<sliced::PictureRuns>::failure(record.problem());
    }
    return sliced::PictureRuns::of_layer(file_, source, n, *record, sublayer);
}

bool PrintFile::too_high(const MotorSettings& motor) const {
    const float height = static_cast<float>(layers()) * file_.header().layer_height_mm;
    return height > motor.max_pos_mm - static_cast<float>(common_.lift_mm);
}

std::uint32_t PrintFile::estimate_s(const MotorSettings& motor, Firmware firmware) const {
    constexpr double most_s = 4e9;
    const double acceleration = std::max(static_cast<double>(motor.acceleration), 0.1);
    const double up = way_s(common_.lift_mm, common_.lift_mm_s, acceleration, common_.lift_mm);
    const double down = way_s(common_.lift_mm, common_.drop_mm_s, acceleration, common_.lift_mm / 2);
    const double all = layers();
    const double bottom = std::min(layers(), bottom_layers());
    const double levels = antialiasing();
    double total = all * (up + down + common_.light_off_s) + bottom * bottom_exposure_s_ +
                   (all - bottom) * common_.exposure_s;
    if (levels > 1) {
        total +=
            firmware == Firmware::v008 ? all * (levels - 1) * picture_load_s(firmware) : all * levels * 0.51;
    }
    return static_cast<std::uint32_t>(std::clamp(total, 0.0, most_s));
}

}  // namespace fauxboard::dlp
