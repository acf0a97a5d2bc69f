// The schema of profiles against the profiles, and against the loader: both must know the same keys.

#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"
#include "tests/tools/helpers.h"
#include "tools/check_files.h"

using namespace fauxboard;
using nlohmann::json;
using tests::read_file;

namespace {

const std::filesystem::path profiles = FAUXBOARD_SOURCE_DIR "/profiles";

const json& schema() {
    static const json parsed = json::parse(read_file(profiles / "schemas/profile.schema.json"));
    return parsed;
}

std::string by_schema(const json& document) {
    std::string out;
    for (const tools::SchemaError& error : tools::check_schema(schema(), document)) {
        out += error.pointer + ": " + error.message + "\n";
    }
    return out;
}

std::string by_loader(const json& document) {
    try {
        behaviour::load_profile({(profiles / "test.json").string(), document.dump()}, host::profile_finder());
    } catch (const behaviour::ProfileError& error) {
        return error.what();
    }
    return "";
}

/// A small profile that has one of everything, so that each level of the schema is there to be tried.
json everything() {
    return json::parse(R"({
        "$schema": "schemas/profile.schema.json", "comment": "", "name": "test", "title": "t", "protocol": "smartto",
        "extends": "smartto-base", "screen": "mks-dlp",
        "line": { "none": false, "optional": true, "baud": 9600, "checksum": "ignored", "queue_lines": 8, "peer": "host", "unfinished_ms": 20,
                  "framed": false, "ring_bytes": 200, "line_bytes": 95, "comment_from": ";", "codes": "GMT" },
        "transmit": { "tick_ms": 20, "first_ms": 5, "queue_codes": 29, "burst_bytes": 1000, "piece_bytes": 400 },
        "identity": { "device_name": "a", "model": "b", "serial_number": "\u00ff", "firmware": "d", "volume": "e", "hardware": "f" },
        "variables": { "v": { "value": 1, "min": 0, "max": 2, "help": "h", "stored": true } },
        "defaults": { "addons.sound": true, "settings.steps.x": 81, "var.v": 2 },
        "machine": {
            "kind": "resin", "udisk_port": true, "board_fan_percent": 40, "manual_level_start_mm": 5, "part_fan_least_pwm": 50,
            "board_fan": { "idle_percent": 70, "busy_percent": 100, "nozzle_c": 50, "bed_c": 35, "starts_s": 2 },
            "job": { "finished_s": 5, "ends_idle": true, "pause_at_once": true, "cut_off_is_paused": true, "resume_homes_first": true },
            "thermal": {
                "period_ms": 100, "warm_up_measurements": 0, "printed": "true",
                "nozzle": {
                    "plant": { "heating_k_per_s": 1, "exchange_a_per_s": 0, "exchange_b_per_s": 0, "loss_behind_per_s": 0, "noise_c": 0, "loss_on_per_s": 0, "loss_off_per_s": 0,
                               "sensor_lag_s": 1, "dead_time_s": 1, "ambient_c": 20, "counts_per_c": 4, "first_reading_offset_c": 0 },
                    "pid": { "kp": 1, "ki": 1, "kd": 1, "k1": 0.5, "range_c": 5, "off_below_c": 5, "max_output": 255 },
                    "max_target_c": 260, "clamps": false, "done_within_c": 2,
                    "protection": { "min_c": 5, "max_c": 300, "open_reads_c": -15, "shorted_reads_c": 400, "watch_s": 20, "watch_rise_c": 2,
                                    "runaway_s": 40, "runaway_c": 4, "any_change": true } },
                "bed": { "max_target_c": 90 },
                "t1": { "noise_c": 0, "noise_wander_s": 0, "counts_per_c": 5, "points": [ [0, 0], [100, 50] ] },
                "t2": { "noise_c": 0 } },
            "motion": {
                "volume_mm": [100, 100, 100], "power_on_position_mm": [1, 2, 3], "homing_feed_mm_s": 10, "homing_bump_s": 1,
                "planner_blocks": 4, "default_feed_mm_s": 10, "probe_trigger_mm": 1, "probe_offset_mm": [0, 0], "probe_spread_mm": 0.01, "idle_off_s": 60,
                "bed_mesh_mm": { "front": [0, 0, 0], "middle": [0, 0, 0], "back": [0, 0, 0] },
                "procedures": { "p": [
                    { "zero": "xy" }, { "home": "z", "together": true, "bump_s": 1 }, { "to": { "x": 1, "y": 1, "z": 1, "e": 1 }, "feed_mm_s": 5, "seconds": 1 }, { "by": { "x": 1 } },
                    { "probe": "measure", "point": 8 }, { "homed": "xyz" }, { "wait_s": 1 }, { "lose_rounds": 1 }, { "raise": "motion.homed" } ], "park": null } },
            "filament": { "piece_s": 1, "piece_commit_s": 0.1, "feed_mm_s": 2, "min_extrude_c": 150, "detector_mm": 5 },
            "extrusion": { "guarded": true, "longest_mm": 200 },
            "heating": { "report_s": 1, "residency_s": 10, "hysteresis_c": 3 },
            "host": { "busy_s": 2, "drops_repeated": true, "emergency_parser": true, "first_star_ends": false, "judges_unnumbered": true,
                      "line_chars": 95, "numbers_uploads": true },
            "dlp": {
                "firmware": "0.08", "fpga_version": 2, "lists_ctb": true,
                "clock": { "year": 2024, "month": 2, "day": 29, "hour": 1, "minute": 2, "second": 3 },
                "platform": { "travel_mm": 190, "start_mm": 100, "overtravel_mm": 1 },
                "quirks": { "display_not_counted": true, "end_goes_down": true, "ignore_read_errors": true, "last_line_unchecked": true,
                            "light_zero_stays_on": true, "pause_on_bad_lines": true, "reset_without_command": true, "short_homing_search": true,
                            "slow_homing_to_one": true, "speed_times_60": true, "stop_homing_keeps_print": true } },
            "resin": { "travel_mm": 100, "power_on_mm": 10, "homing_bounce_mm": 2, "pause_lift_mm": 5, "pause_from_s": 1, "pause_to_s": 2,
                       "stick_visible_s": 1, "stir_cycles": 3,
                       "status": { "temp": 1, "other": 2, "mem": 3, "communication": 4, "indicator": 5, "driver": 6, "printer": 7, "lcd": 8 } },
            "card": { "newest_first": true, "folders": false, "only": [ "GCO" ], "name_bytes": 40, "by_list": true, "name_ends": [ ".gco" ], "rescan_s": 1, "way_back": false, "ignore_case": true, "present": true, "max_listed": 10,
                      "found_s": 1, "long_names": true, "short_names": true,
                      "entries": [ { "file": "a", "lines": ["G28"] },
                                   { "file": "b.ctb", "sample": { "layers": 2, "exposure_s": 1, "layer_height_mm": 0.1, "lift_mm": 5, "lift_mm_min": 60,
                                                                  "width": 16, "height": 16 } },
                                   { "folder": "b", "entries": [] } ] } },
        "frames": {
            "plain": "L99 {position.x:.2f}",
            "block": { "chunk": true },
            "full": { "cell": "c", "style": "bare", "end": "lf", "line": "L98", "then": [ "heaters.reported", { "set": { "var.v": 1 } } ] },
            "list": { "lines": [ "L97", { "for_each": "card.entries", "when": { "entry.folder": false }, "line": "{entry.name}" },
                                    { "frame": "plain", "prefix": "<", "suffix": ">" } ] } },
        "boot": [ "plain", { "frame": "full", "times": 2, "now": true, "when": { "card.usable": true } } ],
        "schedule": { "slot_ms": 100, "first_slot_ms": 10, "frozen_while": { "heating.waiting": true }, "slots": [
            { "send": "plain", "every_rounds": 2, "first_round": 1, "when": { "position.x": { "min": 1 } },
              "when_changed": [ "position.x" ], "or_changed": [ "position.y" ], "now": true, "starts_told": true, "only_with": "full" }, null ] },
        "requests": {
            "M9000": { "until_done": true, "when": { "S": { "min": 0, "max": 3, "not": 2, "in": [ 0, 1 ], "present": true }, "arg": { "starts_with": "S" }, "FW:": "x", "P?": 1, "var.v": 1 },
                       "do": { "heater.target": { "heater": "bed", "c": "{S|0}" }, "add": { "settings.steps.x": 1 } }, "send": "plain", "after": "plain" },
            "hello": [ { "when": { "S": 1 } }, { "do": "motors.enable" } ], "M105": null },
        "host_requests": { "M9001": { "at_once": true, "send": [ "plain" ] } },
        "events": { "motion.homed": { "do": [ "motors.disable" ], "send": { "frame": "plain" } } }
    })");
}

using Visit = std::function<void(json& object, const std::string& pointer)>;

/// Every object of a document, with its place.
void each_object(json& node, const std::string& pointer, const Visit& visit) {
    if (node.is_object()) {
        visit(node, pointer);
        for (auto& [key, value] : node.items()) {
            each_object(value, pointer + "/" + key, visit);
        }
    } else if (node.is_array()) {
        for (std::size_t i = 0; i < node.size(); ++i) {
            each_object(node[i], pointer + "/" + std::to_string(i), visit);
        }
    }
}

/// Objects whose keys are names that the profile's author chooses.
bool free_names(const std::string& pointer) {
    return pointer == "/frames" || pointer == "/variables" || pointer == "/requests" ||
           pointer == "/host_requests" || pointer == "/machine/motion/procedures";
}

}  // namespace

TEST_CASE("schema: every profile of the project fits, as written and with all that it extends") {
    std::size_t seen = 0;
    for (const auto& item : std::filesystem::directory_iterator(profiles)) {
        if (item.path().extension() != ".json") {
            continue;
        }
        ++seen;
        CAPTURE(item.path().string());
        const std::string text = read_file(item.path());
        CHECK(by_schema(json::parse(text)) == "");
        const auto whole = behaviour::load_document({item.path().string(), text}, host::profile_finder());
        json resolved = json::parse(whole.root.dump());
        CHECK(by_schema(resolved) == "");
        resolved.erase("extends");
        CHECK(by_schema(resolved) == "");  // complete: it needs no base any more
    }
    CHECK(seen >= 5);
}

TEST_CASE("schema: what it allows the loader takes, everything at once") {
    CHECK(by_schema(everything()) == "");
    CHECK(by_loader(everything()) == "");
}

TEST_CASE("schema: an unknown key is refused by schema and loader, at every level") {
    const json good = everything();
    std::vector<std::string> places;
    json walked = good;
    each_object(walked, "", [&](json&, const std::string& pointer) {
        if (!free_names(pointer)) {
            places.push_back(pointer);
        }
    });
    CHECK(places.size() > 45);
    for (const std::string& place : places) {
        CAPTURE(place);
        json bad = good;
        bad[json::json_pointer(place)]["zzz_unknown"] = 1;
        CHECK(by_schema(bad) != "");
        CHECK(by_loader(bad).find("zzz_unknown") != std::string::npos);
    }
}

TEST_CASE("schema: every key that it names is tried above, so that the loader was asked about it") {
    // Keys of the document by the definition that describes them are not told apart: a key is known by its
    // name.
    json document = everything();
    std::vector<std::string> used;
    each_object(document, "", [&](json& object, const std::string&) {
        for (const auto& [key, value] : object.items()) {
            used.push_back(key);
        }
    });
    const auto tried = [&](const std::string& key) {
        return std::find(used.begin(), used.end(), key) != used.end();
    };
    json copy = schema();
    // These are made from the tables that the loader itself reads; the describe tests compare them.
    for (const char* generated : {"action", "assignments", "conditions", "events"}) {
        copy["definitions"].erase(generated);
    }
    std::size_t keys = 0;
    each_object(copy, "", [&](json& object, const std::string& pointer) {
        if (!pointer.ends_with("/properties")) {
            return;
        }
        for (const auto& [key, value] : object.items()) {
            ++keys;
            CAPTURE(pointer);
            const auto& shown_key = key;
            CAPTURE(shown_key);
            CHECK(tried(key));
            const bool described =
                value.contains("description") || value.contains("$ref") || value.contains("allOf");
            CHECK(described);
        }
    });
    CHECK(keys > 120);
}

TEST_CASE("schema: bounds are those of the loader") {
    const std::vector<std::pair<std::string, json>> wrong{
        {"/line/baud", 299},
        {"/line/baud", 4000001},
        {"/line/queue_lines", 0},
        {"/line/checksum", "sometimes"},
        {"/line/peer", std::string(17, 'x')},
        {"/line/unfinished_ms", -1},
        {"/transmit/tick_ms", 0.05},
        {"/identity/model", std::string(65, 'x')},
        {"/machine/board_fan_percent", 101},
        {"/machine/thermal/period_ms", 9},
        {"/machine/thermal/printed", "wrong"},
        {"/machine/thermal/nozzle/plant/sensor_lag_s", 0},
        {"/machine/thermal/nozzle/pid/k1", 1.5},
        {"/machine/thermal/nozzle/plant/counts_per_c", 1.5},
        {"/machine/thermal/t1/points", json::array()},
        {"/machine/motion/volume_mm", json::array({1, 2})},
        {"/machine/motion/planner_blocks", 65},
        {"/machine/motion/procedures/p/0/zero", "xq"},
        {"/machine/motion/procedures/p/4/probe", "guess"},
        {"/machine/card/max_listed", 1001},
        {"/machine/card/entries/0/file", "a/b"},
        {"/frames/full/style", "fancy"},
        {"/frames/list/lines", json::array()},
        {"/boot/1/times", 21},
        {"/schedule/slot_ms", 0.5},
        {"/schedule/slots/0/every_rounds", 0},
        {"/requests/M9000/when/S", json::array({1})},
        {"/requests/M9000/do/heater.target/c", json::object()},
        {"/events/motion.homed/do/0", 7},
    };
    for (const auto& [place, value] : wrong) {
        const auto& shown_place = place;
        CAPTURE(shown_place);
        const std::string shown_value = value.dump();
        CAPTURE(shown_value);
        json bad = everything();
        bad[json::json_pointer(place)] = value;
        CHECK(by_schema(bad) != "");
        CHECK(by_loader(bad) != "");
    }
}
