#include "tools/sliced_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"

namespace fauxboard::tools {
namespace {

using nlohmann::ordered_json;
using sliced::Header;
using sliced::Lift;
using sliced::Preview;

std::string slicer(std::uint32_t version) {
    return fmt::format("{}.{}.{}.{}", version >> 24, version >> 16 & 0xFF, version >> 8 & 0xFF,
                       version & 0xFF);
}

std::string words(const Lift& lift) {
    return fmt::format("{:g} mm at {:g} mm/min, back at {:g} mm/min", lift.mm, lift.mm_min,
                       lift.retract_mm_min);
}

std::string words(const std::optional<Preview>& preview) {
    return preview ? fmt::format("{} x {}", preview->width, preview->height) : "none";
}

std::string row(std::string_view what, std::string_view value) {
    return fmt::format("{:<14}{}\n", what, value);
}

ordered_json json(const std::optional<Lift>& lift) {
    return lift ? ordered_json{{"mm", lift->mm},
                               {"mm_min", lift->mm_min},
                               {"retract_mm_min", lift->retract_mm_min}}
                : ordered_json(nullptr);
}

ordered_json json(const std::optional<Preview>& preview) {
    return preview ? ordered_json{{"width", preview->width}, {"height", preview->height}}
                   : ordered_json(nullptr);
}

}  // namespace

std::string sliced_text(const Header& header, std::uint64_t file_bytes) {
    std::string text = row("Format", fmt::format("{}, version {}, {} bytes", to_string(header.format),
                                                 header.version, file_bytes));
    text += row("Pictures", fmt::format("{} x {} pixels{}", header.width, header.height,
                                        header.mirrored ? ", mirrored" : ""));
    text += row("Bed",
                fmt::format("{:g} x {:g} x {:g} mm", header.bed_mm[0], header.bed_mm[1], header.bed_mm[2]));
    text += row("Layers", fmt::format("{} of {:g} mm, {:g} mm in all; {} bottom layers", header.layers,
                                      header.layer_height_mm, header.model_height_mm, header.bottom_layers));
    text += row("Exposure",
                fmt::format("{:g} s, bottom {:g} s; light off {:g} s, bottom {:g} s", header.exposure_s,
                            header.bottom_exposure_s, header.light_off_s, header.bottom_light_off_s));
    text += row("Light", fmt::format("{} of 255, bottom {}", header.pwm, header.bottom_pwm));
    if (header.lift && header.bottom_lift) {
        text += row("Lift", words(*header.lift));
        text += row("Bottom lift", words(*header.bottom_lift));
        text += row("Resin",
                    fmt::format("{:g} ml, {:g} g, cost {:g}", header.resin_ml, header.resin_g, header.cost));
    }
    text += row("Print time", fmt::format("{}:{:02}:{:02}", header.print_time_s / 3600,
                                          header.print_time_s / 60 % 60, header.print_time_s % 60));
    if (header.level_sets > 1 || header.anti_aliasing > 1) {
        text += row("Anti-aliasing", fmt::format("level {}, {} picture(s) per layer", header.anti_aliasing,
                                                 header.level_sets));
    }
    if (!header.machine.empty()) {
        text += row("Machine", behaviour::as_ascii(header.machine));
    }
    if (header.slicer_version != 0) {
        text += row("Slicer", slicer(header.slicer_version));
    }
    text += row("Cipher", header.key == 0 ? "none" : fmt::format("key 0x{:08X}", header.key));
    return text + row("Previews", fmt::format("large {}, small {}", words(header.large_preview),
                                              words(header.small_preview)));
}

ordered_json sliced_json(const Header& header, std::uint64_t file_bytes) {
    return {{"format", to_string(header.format)},
            {"version", header.version},
            {"bytes", file_bytes},
            {"width", header.width},
            {"height", header.height},
            {"mirrored", header.mirrored},
            {"bed_mm", header.bed_mm},
            {"layers", header.layers},
            {"bottom_layers", header.bottom_layers},
            {"layer_height_mm", header.layer_height_mm},
            {"model_height_mm", header.model_height_mm},
            {"exposure_s", header.exposure_s},
            {"bottom_exposure_s", header.bottom_exposure_s},
            {"light_off_s", header.light_off_s},
            {"bottom_light_off_s", header.bottom_light_off_s},
            {"pwm", header.pwm},
            {"bottom_pwm", header.bottom_pwm},
            {"lift", json(header.lift)},
            {"bottom_lift", json(header.bottom_lift)},
            {"resin_ml", header.resin_ml},
            {"resin_g", header.resin_g},
            {"cost", header.cost},
            {"print_time_s", header.print_time_s},
            {"level_sets", header.level_sets},
            {"anti_aliasing", header.anti_aliasing},
            {"machine", header.machine},
            {"slicer", slicer(header.slicer_version)},
            {"key", header.key},
            {"large_preview", json(header.large_preview)},
            {"small_preview", json(header.small_preview)}};
}

ordered_json layer_json(const sliced::Layer& layer, std::uint32_t n) {
    return {{"layer", n},
            {"z_mm", layer.z_mm},
            {"exposure_s", layer.exposure_s},
            {"light_off_s", layer.light_off_s},
            {"lift", json(layer.lift)},
            {"offset", layer.data_offset},
            {"bytes", layer.data_bytes},
            {"end", layer.end()}};
}

}  // namespace fauxboard::tools
