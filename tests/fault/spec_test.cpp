#include <doctest/doctest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "emulator/fault/kind.h"
#include "emulator/fault/printer_fault.h"
#include "tests/fault/helpers.h"

using namespace fauxboard;
using namespace fauxboard::fault;

namespace {

std::string error_of(auto&& parse) {
    try {
        parse();
    } catch (const FaultSpecError& error) {
        return error.what();
    }
    return "no error";
}

std::string text_error(std::string_view text) {
    return error_of([&] { fault_from_text(text); });
}

std::string json_error(std::string_view text) {
    return error_of([&] { fault_from_json(Json::parse(text)); });
}

}  // namespace

TEST_CASE("text and JSON say the same") {
    const FaultSpec spec = fault_from_text("garble:to_screen,probability=0.01,seed=7,bits=1");
    CHECK(spec.kind->name == "garble");
    CHECK(spec.direction == Direction::to_screen);
    CHECK(spec.trigger.probability == 0.01);
    CHECK(spec.seed == 7);
    CHECK(spec.values.count(0) == 1);
    CHECK(spec == fault_from_json(Json::parse(
                      R"({"kind":"garble","direction":"to_screen","probability":0.01,"seed":7,"bits":1})")));
    CHECK(spec == fault_from_json(Json("garble:to_screen,probability=0.01,seed=7,bits=1")));
    CHECK(spec == fault_from_text(" garble : bits = 1, seed=7, direction=to_screen, probability=0.01"));
}

TEST_CASE("what is not given has its default") {
    const FaultSpec spec = fault_from_text("delay");
    CHECK(spec.direction == Direction::both);
    CHECK(spec.seed == 1);
    CHECK(spec.trigger == Trigger{});
    CHECK(spec.values.time(0) == ms(200));
    CHECK(spec.values.time(1) == ms(0));
    CHECK(fault_to_text(spec) == "delay");
    CHECK(fault_to_json(spec) == Json{{"kind", "delay"}});
}

TEST_CASE("units of times and rates") {
    CHECK(fault_from_text("delay:time=1.5s").values.time(0) == ms(1500));
    CHECK(fault_from_text("delay:time=250us").values.time(0) == SimTime{250});
    CHECK(fault_from_text("delay:time=1min").values.time(0) == ms(60'000));
    CHECK(fault_from_text("drop:from=2h").trigger.from == ms(7'200'000));
    CHECK(fault_from_text("slow:rate=9600baud").values.number(0) == 960);
    CHECK(fault_from_text("slow:rate=1.2kB/s").values.number(0) == 1200);
}

TEST_CASE("fifteen wrong specs, fifteen sentences") {
    const std::array<std::pair<std::string_view, std::string_view>, 15> wrong{{
        {"garbel:to_screen",
         "fault \"garbel:to_screen\": unknown kind \"garbel\"; expected one of drop, garble, duplicate, "
         "delay, slow, "
         "cut, merge, nul_burst, stray_ok, wrong_checksum, silence, disconnect, or a fault of the printer "
         "(see "
         "`describe "
         "faults`); did you mean \"garble\"?"},
        {"",
         "fault: found no kind; expected one of drop, garble, duplicate, delay, slow, cut, merge, nul_burst, "
         "stray_ok, "
         "wrong_checksum, silence, disconnect, or a fault of the printer (see `describe faults`)"},
        {"garble:bit=1",
         "fault \"garble:bit=1\": unknown attribute \"bit\"; garble takes bits, bytes, direction, "
         "line, probability, every, "
         "after, count, from, until, for, at, seed; did you mean \"bits\"?"},
        {"drop:to_scren",
         "fault \"drop:to_scren\": found \"to_scren\"; expected name=value or a direction, one of to_screen, "
         "to_board, "
         "both; did you mean \"to_screen\"?"},
        {"drop:probability=1.5",
         "fault \"drop:probability=1.5\": probability: found \"1.5\"; expected a number from 0 to 1"},
        {"drop:every=0",
         "fault \"drop:every=0\": every: found \"0\"; expected a whole number from 1 to 1000000000"},
        {"garble:bits=1.5",
         "fault \"garble:bits=1.5\": bits: found \"1.5\"; expected a whole number from 0 to 64"},
        {"delay:time=200",
         "fault \"delay:time=200\": time: found \"200\"; expected a time from 0s to 60s with its unit, such "
         "as "
         "\"200ms\""},
        {"slow:rate=9600",
         "fault \"slow:rate=9600\": rate: found \"9600\"; expected a rate from 1B/s to 10000000B/s with its "
         "unit, such "
         "as \"960B/s\""},
        {"cut:line_end=lots",
         "fault \"cut:line_end=lots\": line_end: found \"lots\"; expected one of kept, lost; did you mean "
         "\"lost\"?"},
        {"drop:every=2,every=3", "fault \"drop:every=2,every=3\": every is given twice; expected it once"},
        {"drop:every=2,",
         "fault \"drop:every=2,\": found nothing between two commas; expected name=value or a direction"},
        {"drop:at=1s,every=2",
         "fault \"drop:at=1s,every=2\": found at and every together; expected only one of them: at says when "
         "it acts, "
         "once"},
        {"drop:from=2s,until=1500ms",
         "fault \"drop:from=2s,until=1500ms\": until: found 1500ms; expected a time after from, 2s"},
        {"silence:from=10s,until=12s",
         "fault \"silence:from=10s,until=12s\": found until without probability, every or after; expected "
         "\"for\", how "
         "long it lasts: then silence comes once, by time alone"},
    }};
    for (const auto& [text, sentence] : wrong) {
        CHECK(text_error(text) == sentence);
    }
}

TEST_CASE("wrong JSON") {
    CHECK(json_error("7") == "fault: found 7; expected an object such as {\"kind\":\"drop\"}, or a text");
    CHECK(json_error(R"({"seed":7})").starts_with("fault: found no kind; expected one of drop"));
    CHECK(json_error(R"({"kind":7})") == "fault: kind: found 7; expected a text");
    CHECK(json_error(R"({"kind":"dropp"})").ends_with("did you mean \"drop\"?"));
    CHECK(json_error(R"({"kind":"drop","every":"2"})") ==
          "fault \"drop\": every: found \"2\"; expected a whole number from 1 to 1000000000");
    CHECK(
        json_error(R"({"kind":"delay","time":200})") ==
        "fault \"delay\": time: found 200; expected a time from 0s to 60s with its unit, such as \"200ms\"");
    CHECK(json_error(R"({"kind":"drop","direction":["both"]})") ==
          "fault \"drop\": direction: found an array; expected one of to_screen, to_board, both");
    CHECK(json_error(R"({"kind":"drop","until":"5s","for":"1s"})") ==
          "fault \"drop\": found until and for together; expected only one of them: both say when it ends");
}

TEST_CASE("all that is wrong is told at once") {
    CHECK_THROWS_AS(fault_from_text("drop:x=1,every=0,nonsense"), FaultSpecError);
    try {
        fault_from_text("drop:x=1,every=0,nonsense");
    } catch (const FaultSpecError& error) {
        CHECK(error.problems().size() == 3);
    }
}

TEST_CASE("numbers that are none, and too long texts, are refused") {
    for (const char* value : {"nan", "inf", "-1", "1e3", "0x1", "", " ", "1 2", "99999999999999999999999"}) {
        CHECK(text_error(std::string("drop:every=") + value).find("expected a whole number") !=
              std::string::npos);
        CHECK(text_error(std::string("delay:time=") + value + "ms").find("expected a time") !=
              std::string::npos);
    }
    CHECK(text_error(std::string(100'000, 'x')).size() < 400);
}

TEST_CASE("every attribute of every kind survives both forms, at both bounds and at its default") {
    for (const Kind* kind : kinds()) {
        CHECK(kind->attributes.size() <= Values::most);
        CHECK((kind->edit != nullptr) + (kind->pace != nullptr) + (kind->interrupt != nullptr) == 1);
        std::vector<Attribute> all(kind->attributes.begin(), kind->attributes.end());
        for (const CommonAttribute& common : common_attributes()) {
            if (takes_common(*kind, common.name)) {
                all.push_back(common);
            }
        }
        for (const Attribute& attribute : all) {
            CHECK(attribute.help.size() > 10);
            CHECK(attribute.min <= attribute.fallback.value_or(attribute.min));
            CHECK(attribute.max >= attribute.fallback.value_or(attribute.max));
            for (const double value :
                 {attribute.min, attribute.max, attribute.fallback.value_or(attribute.max)}) {
                std::string text = std::string(kind->name) + ":" + std::string(attribute.name) + "=" +
                                   attribute_text(attribute, value);
                if (kind->interrupt != nullptr && (attribute.name == "until" || attribute.name == "count")) {
                    text += ",every=2";
                }
                const FaultSpec spec = fault_from_text(text);
                CHECK(fault_from_text(fault_to_text(spec)) == spec);
                CHECK(fault_from_json(fault_to_json(spec)) == spec);
            }
        }
    }
}

TEST_CASE("faults of the printer are spelled alike: both forms, at both bounds and at the default") {
    CHECK(printer_kinds().size() == machine::fault_rows().size());
    for (const Kind* kind : printer_kinds()) {
        const std::string name(kind->name);
        CAPTURE(name);
        CHECK(find_kind(name) == kind);
        CHECK(kind->printer != nullptr);
        CHECK(kind->help.size() > 20);
        std::vector<Attribute> all(kind->attributes.begin(), kind->attributes.end());
        for (const CommonAttribute& common : common_attributes()) {
            if (takes_common(*kind, common.name)) {
                all.push_back(common);
            }
        }
        CHECK(all.size() == kind->attributes.size() + 4);
        for (const Attribute& attribute : all) {
            CHECK(attribute.min < attribute.max);
            CHECK(attribute.min <= attribute.fallback.value_or(attribute.min));
            CHECK(attribute.max >= attribute.fallback.value_or(attribute.max));
            for (const double value : {attribute.min, attribute.max}) {
                const FaultSpec spec = fault_from_text(name + ":" + std::string(attribute.name) + "=" +
                                                       attribute_text(attribute, value));
                CHECK(fault_from_text(fault_to_text(spec)) == spec);
                CHECK(fault_from_json(fault_to_json(spec)) == spec);
            }
        }
    }
    const machine::FaultRequest request =
        to_request(fault_from_text("too_hot:heater=bed,power=40,at=60s,for=1min"));
    CHECK(request.info == machine::find_fault("too_hot"));
    CHECK(request.values == machine::FaultValues{1, 40});
    CHECK(request.begin == ms(60'000));
    CHECK(request.length == ms(60'000));
    CHECK_FALSE(request.end);
    CHECK(fault_from_text("cold_extrusion:below=250C").values.number(0) == 250);
}

TEST_CASE("wrong faults of the printer: sentences that say what to do, and no line takes one") {
    const auto has = [](std::string_view text, std::string_view part) {
        return text_error(text).find(part) != std::string::npos;
    };
    CHECK(has("jamm", "did you mean \"jam\"?"));
    CHECK(has("filament-out", "did you mean \"filament_out\"?"));
    CHECK(has("jam:probability=0.5",
              "unknown attribute \"probability\"; jam takes lost, from, until, for, at"));
    CHECK(has("jam:to_screen", "found \"to_screen\"; expected name=value"));
    CHECK(has("jam:lost=101", "expected a number from 1 to 100"));
    CHECK(has("heater_dead:heater=bedd", "did you mean \"bed\"?"));
    CHECK(has("pid_question:target=200", "a temperature from 30C to 300C, such as \"200C\""));
    CHECK(has("jam:at=60", "with its unit"));
    CHECK(has("jam:at=60s,from=50s", "found at and from together"));
    CHECK(has("jam:until=60s,for=50s", "found until and for together"));
    CHECK(has("jam:at=60s,until=50s", "expected a time after at, 60s"));
    Faults line;
    CHECK_THROWS_AS(line.add(ms(0), fault_from_text("jam")), FaultSpecError);
    CHECK(line.empty());
}

TEST_CASE("the reference names every kind and attribute") {
    const Json reference = describe_kinds();
    CHECK(reference["kinds"].size() == 12);
    CHECK(reference["common"].size() == 11);
    CHECK(
        reference["kinds"][3] ==
        Json::parse(
            R"({"name":"delay","help":"the line comes later; what is behind it waits, so that order is kept",
            "attributes":[
            {"name":"time","type":"time","default":"200ms","min":"0s","max":"60s",
             "help":"how much later the line comes, from its arrival"},
            {"name":"jitter","type":"time","default":"0s","min":"0s","max":"60s",
             "help":"a random time up to this comes on top"}]})"));
}
