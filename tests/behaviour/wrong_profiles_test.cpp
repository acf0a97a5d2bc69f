// Profiles that are wrong in many ways: each gets a sentence that says where, what was found, what was
// expected, and what was probably meant.

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/support/small_profile.h"

using namespace fauxboard::behaviour;
using fauxboard::testing::small_profile;
using std::string;

namespace {

struct Wrong {
    const char* json;   ///< put on top of the small base
    const char* place;  ///< file, line and pointer
    std::vector<string> words;
};

const std::vector<Wrong>& wrong_profiles() {
    static const std::vector<Wrong> all{
        // Names that are not known, and the nearest that is.
        {R"({ "frames": { "L2": "L2 T0:{heaters.nozle.printed:.1f}" } })",
         "small.json:1: /frames/L2: ",
         {"unknown field \"heaters.nozle.printed\"", "did you mean \"heaters.nozzle.printed\"?"}},
        {R"({ "requests": {
                "M1": { "do": "motion.hom" } } })",
         "small.json:2: /requests/M1/do: ",
         {"unknown action \"motion.hom\"", "did you mean \"motion.home\"?"}},
        {R"({ "requests": { "M1": {
                "send": "L11" } } })",
         "small.json:2: /requests/M1/send: ",
         {"unknown frame \"L11\"", "`frames`", "did you mean \"L1\"?"}},
        {R"({ "events": {
                "motion.homd": { "send": "L1" } } })",
         "small.json:2: /events/motion.homd: ",
         {"unknown key \"motion.homd\"", "did you mean \"motion.homed\"?"}},
        {R"({ "machine": { "motion": { "procedures": { "p": [ { "zero": "x" },
                { "raise": "motion.home" } ] } } } })",
         "small.json:2: /machine/motion/procedures/p/1/raise: ",
         {"unknown event \"motion.home\"", "did you mean \"motion.homed\"?"}},
        {R"({ "requests": { "M1": { "do": { "motion.run": { "procedure": "parc" } } } } })",
         "small.json:1: /requests/M1/do/motion.run/procedure: ",
         {"unknown motion procedure \"parc\"", "did you mean \"park\"?"}},
        {R"({ "requests": { "M1": { "do": { "set": { "addons.sond": 1 } } } } })",
         "small.json:1: /requests/M1/do/set/addons.sond: ",
         {"unknown field \"addons.sond\"", "did you mean \"addons.sound\"?"}},
        {R"({ "requests": { "M1": { "when": { "job.activ": true } } } })",
         "small.json:1: /requests/M1/when/job.activ: ",
         {"unknown field \"job.activ\"", "did you mean \"job.active\"?"}},
        {R"({ "requests": { "M1": { "do": { "add": { "var.cuont": 1 } } } } })",
         "small.json:1: /requests/M1/do/add/var.cuont: ",
         {"unknown variable \"cuont\"", "`variables`", "did you mean \"count\"?"}},
        {R"({ "shedule": {} })",
         "small.json:1: /shedule: ",
         {"unknown key \"shedule\"", "did you mean \"schedule\"?"}},
        {R"({ "machine": { "thermal": { "nozzle": {
                "plant": { "sensor_lag": 5 } } } } })",
         "small.json:2: /machine/thermal/nozzle/plant/sensor_lag: ",
         {"unknown key \"sensor_lag\"", "did you mean \"sensor_lag_s\"?"}},
        {R"({ "schedule": { "slots": [ null,
                { "send": "L1", "only_with": "L2" } ] } })",
         "small.json:2: /schedule/slots/1/only_with: ",
         {"unknown frame \"L2\""}},
        {R"({ "schedule": { "slots": [ { "send": "L1", "when_changed": [ "position.y",
                "postion.x" ] } ] } })",
         "small.json:2: /schedule/slots/0/when_changed/1: ",
         {"found the text \"postion.x\"", "numeric field", "did you mean \"position.x\"?"}},

        // Values of the wrong kind or size.
        {R"({ "line": { "baud": "fast" } })",
         "small.json:1: /line/baud: ",
         {"found the text \"fast\"", "expected a whole number from 300 to 4000000"}},
        {R"({ "line": {
                "baud": 12 } })",
         "small.json:2: /line/baud: ",
         {"found 12", "expected a whole number from 300"}},
        {R"({ "line": { "baud": 9600.5 } })", "small.json:1: /line/baud: ", {"found 9600.5", "whole number"}},
        {R"({ "line": { "checksum": "require" } })",
         "small.json:1: /line/checksum: ",
         {"found the text \"require\"", "expected one of required, if_present, ignored",
          "did you mean \"required\"?"}},
        {R"({ "transmit": { "tick_ms": null } , "boot": [ "L1", 5 ] })",
         "small.json:1: /boot/1: ",
         {"found 5", "expected the name of a frame"}},
        {R"({ "transmit": [ 50 ] })", "small.json:1: /transmit: ", {"found an array", "expected an object"}},
        {R"({ "frames": { "L2": 5 } })",
         "small.json:1: /frames/L2: ",
         {"found 5", "expected a text, the line"}},
        {R"({ "frames": { "L2": { "style": "fraimed", "line": "x" } } })",
         "small.json:1: /frames/L2/style: ",
         {"found the text \"fraimed\"", "framed, bare, star_only, unfinished", "did you mean \"framed\"?"}},
        {R"({ "frames": { "L2": { "style": "bare" } } })",
         "small.json:1: /frames/L2: ",
         {"expected either \"line\" or \"lines\""}},
        {R"({ "frames": { "L2": { "lines": [] } } })",
         "small.json:1: /frames/L2/lines: ",
         {"found an array", "expected a list of 1 to 200 lines"}},
        {R"({ "frames": { "L2": { "lines": [ { "for_each": "card.things", "line": "x" } ] } } })",
         "small.json:1: /frames/L2/lines/0/for_each: ",
         {"found the text \"card.things\"", "card.entries"}},
        {R"({ "machine": { "motion": { "volume_mm": [ 200, 200 ] } } })",
         "small.json:1: /machine/motion/volume_mm: ",
         {"an array of 2", "expected 3 numbers"}},
        {R"({ "machine": { "motion": { "volume_mm": [ 200,
                -3, 200 ] } } })",
         "small.json:2: /machine/motion/volume_mm/1: ",
         {"found -3", "expected a number from 1 to 5000"}},
        {R"({ "machine": { "thermal": { "t1": { "points": [ [ 0, 1 ], [ 20, 3 ],
                [ 10, 2 ] ] } } } })",
         "small.json:2: /machine/thermal/t1/points/2: ",
         {"must not fall"}},
        {R"({ "machine": { "card": { "present": "yes" } } })",
         "small.json:1: /machine/card/present: ",
         {"found the text \"yes\"", "expected true or false"}},
        {R"({ "machine": { "card": { "entries": [ { "file": "a/b" } ] } } })",
         "small.json:1: /machine/card/entries/0: ",
         {"a name without slashes"}},
        {R"({ "identity": { "model": "Modell \u20ac" } })",
         "small.json:1: /identity/model: ",
         {"cannot go on the wire", "U+00FF"}},
        {R"({ "variables": { "v": { "value": 3, "min": 5, "max": 1 } } })",
         "small.json:1: /variables/v: ",
         {"min is above max"}},
        {R"({ "variables": { "v": { "value": 20, "min": 0, "max": 10 } } })",
         "small.json:1: /variables/v/value: ",
         {"found 20", "expected a number from 0 to 10"}},

        // Rules that make no sense.
        {R"({ "frames": { "L2": "L2 {position.x}" } })",
         "small.json:1: /frames/L2: ",
         {"{position.x} is a number and needs a format", "{position.x:.2f}"}},
        {R"({ "frames": { "L2": "L2 {position.x:.3f" } })",
         "small.json:1: /frames/L2: ",
         {"a brace without its partner"}},
        {R"({ "frames": { "L2": "L2 {position.x:3f}" } })",
         "small.json:1: /frames/L2: ",
         {"unknown format \"3f\"",
          "expected .0f to .6f (+ before it for a sign), d, x, time, s, .1s to .512s, lower or upper"}},
        {R"({ "frames": { "L2": "\u20ac" } })", "small.json:1: /frames/L2: ", {"not one byte on the wire"}},
        {R"({ "frames": { "L2": "a\nb" } })", "small.json:1: /frames/L2: ", {"control character"}},
        {R"({ "requests": { "M1": { "do": { "set": { "motion.homed": true } } } } })",
         "small.json:1: /requests/M1/do/set/motion.homed: ",
         {"can be read but not set"}},
        {R"({ "requests": { "M1": { "do": { "set": { "screen.firmware": 5 } } } } })",
         "small.json:1: /requests/M1/do/set/screen.firmware: ",
         {"found 5", "is a text"}},
        {R"({ "requests": { "M1": { "do": { "add": { "screen.firmware": "x" } } } } })",
         "small.json:1: /requests/M1/do/add/screen.firmware: ",
         {"only numbers can be added to"}},
        {R"({ "requests": { "M1": { "do": { "heater.target": { "heater": "bed" } } } } })",
         "small.json:1: /requests/M1/do/heater.target: ",
         {"the key \"c\" is missing"}},
        {R"({ "requests": { "M1": { "do": { "heater.target": { "heater": 5, "c": 1 } } } } })",
         "small.json:1: /requests/M1/do/heater.target/heater: ",
         {"found 5", "expected a text"}},
        {R"({ "requests": { "M1": { "do": 7 } } })",
         "small.json:1: /requests/M1/do: ",
         {"found 7", "expected an action: its name, or"}},
        {R"({ "requests": { "M1": { "when": [ true ] } } })",
         "small.json:1: /requests/M1/when: ",
         {"found an array", "expected an object of conditions"}},
        {R"({ "requests": { "M1": { "when": { "S": { "between": [ 1, 2 ] } } } } })",
         "small.json:1: /requests/M1/when/S/between: ",
         {"unknown key \"between\""}},
        {R"({ "requests": { "M1": { "when": { "screen.firmware": 5 } } } })",
         "small.json:1: /requests/M1/when/screen.firmware: ",
         {"found 5", "is a text"}},
        {R"({ "requests": { "M1": { "when": { "S": { "min": 300, "max": 250 } } } } })",
         "small.json:1: /requests/M1/when/S: ",
         {"min 300 is above max 250", "never holds"}},
        {R"({ "requests": { "M1": [ { "send": "L1" }, { "when": { "S": 1 }, "send": "L1" } ] } })",
         "small.json:1: /requests/M1/1: ",
         {"never reached", "/requests/M1/0 holds always"}},
        {R"({ "requests": { "M1": [ { "when": { "S": 1 }, "send": "L1" }, { "when": { "P": 2, "S": 1 }, "send": "L1" } ] } })",
         "small.json:1: /requests/M1/1: ",
         {"never reached", "/requests/M1/0 holds whenever this one does"}},
        {R"({ "requests": { "M1": { "when": { "S": { "in": [] } } } } })",
         "small.json:1: /requests/M1/when/S/in: ",
         {"an empty list", "never holds"}},
        {R"({ "requests": { "M1": { "when": { "heaters.nozzle.target": { "min": 2000 } } } } })",
         "small.json:1: /requests/M1/when/heaters.nozzle.target: ",
         {"found 2000", "from 0 to 1000", "never holds"}},
        {R"({ "requests": { "M1": { "do": { "heater.target": { "heater": "chamber", "c": 20 } } } } })",
         "small.json:1: /requests/M1/do/heater.target/heater: ",
         {"unknown heater \"chamber\"", "expected nozzle or bed"}},
        {R"({ "requests": { "M1": { "do": { "fault.set": { "fault": "jamm" } } } } })",
         "small.json:1: /requests/M1/do/fault.set/fault: ",
         {"unknown fault of the printer \"jamm\"", "did you mean \"jam\"?"}},
        {R"({ "requests": { "M1": { "do": { "fan.pwm": { "fan": 7, "value": 9 } } } } })",
         "small.json:1: /requests/M1/do/fan.pwm/fan: ",
         {"found 7", "0 part cooling, 2 second fan"}},
        {R"({ "requests": { "M1": { "wehn": {} } } })",
         "small.json:1: /requests/M1/wehn: ",
         {"unknown key \"wehn\"", "did you mean \"when\"?"}},
        {R"({ "requests": { "M1": { "send": { "frame": "L1", "times": 0 } } } })",
         "small.json:1: /requests/M1/send/times: ",
         {"found 0", "from 1 to 20"}},
        {R"({ "requests": { "M 1": {} } })", "small.json:1: /requests/M 1: ", {"is no code (M290)"}},
        {R"({ "boot": [ { "frame": "L1", "when": { "S": 1 } } ] })",
         "small.json:1: /boot/0/when/S: ",
         {"parameter \"S\"", "only where a request is answered"}},
        {R"({ "machine": { "motion": { "procedures": { "p": [ { "zero": "x", "home": "x" } ] } } } })",
         "small.json:1: /machine/motion/procedures/p/0: ",
         {"2 verbs", "exactly one of zero, home, to"}},
        {R"({ "machine": { "motion": { "procedures": { "p": [ { "home": "xq" } ] } } } })",
         "small.json:1: /machine/motion/procedures/p/0/home: ",
         {"found the text \"xq\"", "letters out of x, y and z"}},
        {R"({ "schedule": { "slots": [ { "every_rounds": 2 } ] } })",
         "small.json:1: /schedule/slots/0: ",
         {"the key \"send\" is missing"}},
        {R"({ "protocol": "klipper" })",
         "small.json:1: /protocol: ",
         {"found the text \"klipper\"", "expected one of smartto"}},
        {R"({ "protocol": null, "line": {} })", "small.json:1: ", {"the key \"protocol\" is missing"}},
        {R"({ "frames": null, "boot": [] })", "small.json:1: ", {"the key \"frames\" is missing"}},
    };
    return all;
}

std::vector<Problem> problems_of(const char* json) {
    try {
        small_profile(json);
    } catch (const ProfileError& error) {
        return error.problems();
    }
    return {};
}

}  // namespace

TEST_CASE("wrong profiles: each mistake has one sentence, with its place, its finding and what was meant") {
    std::set<string> sentences;
    for (const Wrong& wrong : wrong_profiles()) {
        CAPTURE(wrong.json);
        const auto problems = problems_of(wrong.json);
        CHECK(problems.size() == 1);
        if (problems.empty()) {
            continue;
        }
        const string sentence = problems.front().sentence();
        CAPTURE(sentence);
        CHECK(sentence.starts_with(wrong.place));
        for (const string& word : wrong.words) {
            CAPTURE(word);
            CHECK(sentence.find(word) != string::npos);
        }
        CHECK(sentence.find('\n') == string::npos);
        sentences.insert(sentence);
    }
    CHECK(sentences.size() == wrong_profiles().size());
    CHECK(sentences.size() >= 20);
}

TEST_CASE("wrong profiles: all mistakes are told in one go") {
    const auto problems = problems_of(R"({
        "line": { "baud": 1 },
        "frames": { "L2": "{x}", "L3": "{y}" },
        "requests": { "M1": { "send": "L99" } }
    })");
    REQUIRE(problems.size() == 4);
    CHECK(problems[0].line == 2);
    CHECK(problems[1].line == 3);
    CHECK(problems[3].line == 4);
}

TEST_CASE("wrong profiles: a mistake in the base is told with the base's name and line") {
    try {
        load_profile({"top.json", R"({ "name": "top", "extends": "base" })"},
                     fauxboard::testing::finder_in({{"base",
                                                     "{ \"protocol\": \"smartto\",\n \"frames\": {\n"
                                                     "  \"L1\": \"{nothing}\" } }"}}));
        FAIL("accepted");
    } catch (const ProfileError& error) {
        REQUIRE(error.problems().size() == 1);
        CHECK(error.problems()[0].sentence().starts_with("base:3: /frames/L1: unknown field"));
    }
}

TEST_CASE("wrong profiles: the small base itself is right, and so is nothing on top of it") {
    CHECK(problems_of("{}").empty());
    CHECK(small_profile()->frames.size() == 1);
}
