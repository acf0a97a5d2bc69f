#include "emulator/dlp/acfg.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

using namespace fauxboard::dlp;
using nlohmann::json;

namespace {

/// Code points of Latin-1, which JSON holds as UTF-8, back to bytes.
std::string bytes_of(const std::string& latin1) {
    std::string out;
    for (std::size_t i = 0; i < latin1.size(); ++i) {
        const auto byte = static_cast<unsigned char>(latin1[i]);
        out += byte < 0x80
                   ? latin1[i]
                   : static_cast<char>((byte & 0x03) << 6 | (static_cast<unsigned char>(latin1[++i]) & 0x3F));
    }
    return out;
}

std::map<std::string, double> values_of(const Settings& settings, Firmware firmware) {
    std::map<std::string, double> values;
    for (const Parameter& parameter : parameters()) {
        if (parameter.since <= firmware) {
            values[std::string(parameter.value_name)] = parameter.get(settings);
        }
    }
    return values;
}

json load() {
    std::ifstream file(FAUXBOARD_SOURCE_DIR "/tests/vectors/mks-dlp-acfg.json");
    REQUIRE(file);
    return json::parse(file);
}

std::map<std::string, double> numbers(const json& node) {
    std::map<std::string, double> values;
    for (const auto& [name, value] : node.items()) {
        values[name] = std::strtod(value.get<std::string>().c_str(), nullptr);
    }
    return values;
}

}  // namespace

TEST_CASE("settings files: every vector") {
    const json file = load();
    for (const json& vector : file["vectors"]) {
        INFO(vector["name"].get<std::string>());
        Settings settings;
        const AcfgReport report =
            read_acfg(bytes_of(vector["input"].get<std::string>()), settings, Firmware::v001);
        CHECK(to_string(report.result) == vector["result"].get<std::string>());
        CHECK(report.line == (vector["line"].is_null() ? 0 : vector["line"].get<unsigned>()));
        auto expected = numbers(file["defaults"]);
        for (const auto& [name, value] : numbers(vector["changed"])) {
            REQUIRE(expected.contains(name));
            expected[name] = value;
        }
        const auto got = values_of(settings, Firmware::v001);
        REQUIRE(got.size() == expected.size());
        for (const auto& entry : expected) {
            const std::string& name = entry.first;
            const double value = entry.second;
            INFO(name);
            // Measures are floats on the board.
            CHECK((got.at(name) == value || static_cast<float>(got.at(name)) == static_cast<float>(value)));
        }
    }
}

TEST_CASE("settings files: read in pieces, they are the same") {
    const json file = load();
    REQUIRE_FALSE(file.at("vectors").empty());
    for (const json& vector : file.at("vectors")) {
        const std::string text = bytes_of(vector["input"].get<std::string>());
        Settings whole;
        Settings pieces;
        const AcfgReport report = read_acfg(text, whole, Firmware::v001);
        std::size_t at = 0;
        const AcfgReport again = read_acfg(
            [&](char* out, std::size_t) {
                return at < text.size() ? (*out = text[at++], std::size_t{1}) : std::size_t{0};
            },
            pieces, Firmware::v001);
        CHECK(again.result == report.result);
        CHECK(again.line == report.line);
        CHECK(pieces == whole);
    }
}

TEST_CASE("settings files: what was written, what is in force, which lines were too long") {
    Settings settings;
    const AcfgReport report =
        read_acfg("[ZMotor]\nfeedrate = 400\n#" + std::string(600, 'x') + "\nsteps_per_mm = 3200 # fine\n",
                  settings, Firmware::v001);
    CHECK(report.result == AcfgResult::invalid_value);
    CHECK(report.line == 4);
    REQUIRE(report.taken.size() == 1);
    CHECK(report.taken[0].parameter->value_name == "feedrate");
    CHECK(report.taken[0].written == "400");
    CHECK(report.taken[0].kept_in_bounds);
    CHECK(report.cut_lines == std::vector<unsigned>{3});
    CHECK(settings.motor.feedrate == 40);
    CHECK(box_text(report.result) == "Parameter value is invalid");
}

TEST_CASE("settings files: one without end is read no further than any settings file goes") {
    std::size_t given = 0;
    Settings settings;
    const AcfgReport report = read_acfg(
        [&](char* out, std::size_t room) {
            std::fill_n(out, room, '\n');
            given += room;
            return room;
        },
        settings, Firmware::v001);
    CHECK(report.too_large);
    CHECK(report.result == AcfgResult::invalid_value);
    CHECK(report.line == acfg_most_bytes + 1);
    CHECK(given < 2 * acfg_most_bytes);
    std::string most(acfg_most_bytes - 1, '\n');
    CHECK(read_acfg(most, settings, Firmware::v001).result == AcfgResult::ok);
}

TEST_CASE("settings files of 0.08: more names, other bounds") {
    Settings settings = default_settings(Firmware::v008);
    const AcfgReport report = read_acfg(
        "[ZMotor]\nacceleration=400\nfeedrate=90\n[General]\ngui_language = 3\nuse_external_clock=1\n"
        "[Printing]\nlift_on_pause=25.5\nlift_on_completion=0\nmb_fan_mode=7\nexposure_decrease_steps=20\n",
        settings, Firmware::v008);
    CHECK(report.result == AcfgResult::ok);
    CHECK(settings.motor.acceleration == 100);
    CHECK(settings.motor.feedrate == 90);
    CHECK(settings.general.language == 1);
    CHECK(settings.general.external_clock == 1);
    CHECK(settings.general.pause_lift_mm == 25.5F);
    CHECK(settings.general.end_lift_mm == 0.1F);
    CHECK(settings.general.fan_mode == 3);
    CHECK(settings.general.decrease_steps == 20);
}

TEST_CASE("settings files of 0.08: the file that 0.01 refuses on line 176 is taken whole") {
    const json file = load();
    const json& vectors = file.at("vectors");
    const auto hit = std::find_if(vectors.begin(), vectors.end(), [](const json& vector) {
        return vector.at("name").get<std::string>().starts_with("a whole file, as boards of 0.08");
    });
    REQUIRE(hit != vectors.end());
    Settings settings = default_settings(Firmware::v008);
    const AcfgReport report =
        read_acfg(bytes_of(hit->at("input").get<std::string>()), settings, Firmware::v008);
    CHECK(report.result == AcfgResult::ok);
    CHECK(report.taken.size() == 29);
    CHECK(settings.motor.max_pos_mm == 150);
    CHECK(settings.motor.acceleration == 2);
    CHECK(settings.general.screensaver_ms == 600'000);
    CHECK(settings.general.external_clock == 1);
    CHECK(settings.general.calibrate_lift_mm == 30);
    CHECK(settings.general.fan_mode == 2);
    CHECK(settings.general.decrease_steps == 15);
}
