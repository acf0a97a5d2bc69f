#include "tools/check_acfg.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"
#include "emulator/host/text_file.h"

namespace fauxboard::tools {
namespace {

using dlp::AcfgResult;
using dlp::AcfgValue;
using dlp::Parameter;
using nlohmann::ordered_json;

constexpr auto firmware = dlp::Firmware::v001;

/// As short as the board's 32 bits allow: 0.7, not 0.699999988.
std::string number_text(double value) {
    return std::abs(value) < 1e7 ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
}

/// JSON knows no infinity, but the board does (1e40).
ordered_json number_json(double value) {
    if (!std::isfinite(value)) {
        return number_text(value);
    }
    if (value == std::floor(value)) {
        return static_cast<std::int64_t>(std::clamp(value, -9e18, 9e18));
    }
    return std::strtod(number_text(value).c_str(), nullptr);
}

ordered_json values_json(const dlp::Settings& live) {
    ordered_json values = ordered_json::object();
    for (const Parameter& parameter : dlp::parameters()) {
        if (parameter.since <= firmware) {
            values[std::string(parameter.value_name)] = number_json(parameter.get(live));
        }
    }
    return values;
}

std::string value_text(const AcfgValue& value, const dlp::Settings& live) {
    return fmt::format("  line {:<4} {} = {}{}{}\n", value.line, value.parameter->value_name,
                       number_text(value.parameter->get(live)),
                       value.parameter->unit.empty() ? "" : " " + std::string(value.parameter->unit),
                       value.kept_in_bounds ? fmt::format("   (kept within its bounds; the file says {})",
                                                          behaviour::as_ascii(value.written))
                                            : "");
}

}  // namespace

bool is_acfg(const std::string& file) {
    return file.ends_with(".acfg");
}

std::optional<CheckedAcfg> check_acfg(const std::string& file, std::string& trouble) {
    const host::FileText read = host::read_text_file(file);
    if (!read.text) {
        trouble = read.trouble.empty() ? "there is no such file" : read.trouble;
        return std::nullopt;
    }
    CheckedAcfg checked{file, {}, dlp::default_settings(firmware)};
    checked.report = dlp::read_acfg(*read.text, checked.live, firmware);
    return checked;
}

ordered_json acfg_json(const CheckedAcfg& checked) {
    const dlp::AcfgReport& report = checked.report;
    ordered_json clamped = ordered_json::array();
    for (const AcfgValue& value : report.taken) {
        if (value.kept_in_bounds) {
            clamped.push_back({{"line", value.line},
                               {"name", value.parameter->value_name},
                               {"written", behaviour::as_ascii(value.written)}});
        }
    }
    const bool ok = report.result == AcfgResult::ok;
    return {{"file", checked.file},
            {"result", dlp::to_string(report.result)},
            {"line", ok ? ordered_json(nullptr) : ordered_json(report.line)},
            {"box", ok ? ordered_json(nullptr) : ordered_json(dlp::box_text(report.result))},
            {"saved", ok},
            {"values", values_json(checked.live)},
            {"clamped", std::move(clamped)},
            {"lines_too_long", report.cut_lines}};
}

std::string acfg_text(const CheckedAcfg& checked) {
    const dlp::AcfgReport& report = checked.report;
    const bool ok = report.result == AcfgResult::ok;
    std::string text =
        ok ? checked.file + ": ok; the board shows \"Settings loaded success.\"\n"
           : fmt::format("{}:{}: the board shows \"Error in settings file / on line {} : / {}\"\n",
                         checked.file, report.line, report.line, dlp::box_text(report.result));
    if (report.too_large) {
        text += fmt::format("it is larger than {} bytes, which no settings file is: not read any further\n",
                            dlp::acfg_most_bytes);
    }
    for (const unsigned line : report.cut_lines) {
        text += fmt::format("line {} is longer than {} bytes: the board takes it for two, and counts on\n",
                            line, dlp::acfg_line_bytes - 1);
    }
    if (report.taken.empty()) {
        return text + "Nothing is set.\n";
    }
    text += ok ? "Live and saved:\n" : "Live until power-off, not saved:\n";
    for (const AcfgValue& value : report.taken) {
        text += value_text(value, checked.live);
    }
    return text;
}

}  // namespace fauxboard::tools
