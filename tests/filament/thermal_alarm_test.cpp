#include <doctest/doctest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "emulator/filament/thermal.h"

namespace fauxboard::filament {
namespace {

struct Found {
    SimTime at;
    HeaterId heater;
    ThermalAlarm alarm;
    bool operator==(const Found&) const = default;
};

/// What is done to a machine at a time.
struct Doing {
    double at_s;
    void (*act)(Thermal&);
};

struct Course {
    const char* name;
    std::vector<Doing> doings;
    std::size_t alarms;  ///< at least so many are to be found
};

const std::vector<Course>& courses() {
    static const std::vector<Course> all{
        {"well", {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 210); }}}, 0},
        {"both at their most",
         {{1,
           [](Thermal& t) {
               t.set_target(HeaterId::nozzle, 250);
               t.set_target(HeaterId::bed, 100);
           }}},
         0},
        {"no power from the beginning",
         {{1, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.strength = 0}); }},
          {2, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }}},
         1},
        {"power lost when hot",
         {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }},
          {400.05, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.strength = 0}); }}},
         1},
        {"weak",
         {{1, [](Thermal& t) { t.set_target(HeaterId::bed, 60); }},
          {50, [](Thermal& t) { t.set_trouble(HeaterId::bed, {.strength = 0.1}); }}},
         1},
        {"sensor falls off while heating",
         {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }},
          {61.7, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.contact = 0}); }}},
         1},
        {"wire breaks, is mended, and breaks again",
         {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }},
          {30, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.open = true}); }},
          {40, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {}); }},
          {41, [](Thermal& t) { t.set_target(HeaterId::nozzle, 180); }},
          {90, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.open = true}); }}},
         2},
        {"wires touch, cold", {{5, [](Thermal& t) { t.set_trouble(HeaterId::bed, {.shorted = true}); }}}, 1},
        {"stuck on",
         {{1, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.stuck = 1}); }},
          {300, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {}); }}},
         1},
        {"put to other targets on the way",
         {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }},
          {11, [](Thermal& t) { t.set_target(HeaterId::nozzle, 240); }},
          {300, [](Thermal& t) { t.set_target(HeaterId::nozzle, 180); }},
          {500, [](Thermal& t) { t.set_target(HeaterId::nozzle, 0); }},
          {510, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }}},
         0},
        {"a cold room",
         {{1, [](Thermal& t) { t.set_ambient(-10); }},
          {2, [](Thermal& t) { t.set_target(HeaterId::bed, 60); }},
          {900, [](Thermal& t) { t.set_target(HeaterId::nozzle, 60); }}},
         1},
        {"held in hot air",
         {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }},
          {400, [](Thermal& t) { t.set_temperature(HeaterId::nozzle, 274); }},
          {500, [](Thermal& t) { t.set_temperature(HeaterId::nozzle, 290); }}},
         1},
        {"restarted",
         {{1, [](Thermal& t) { t.set_target(HeaterId::nozzle, 200); }},
          {100.1, [](Thermal& t) { t.power_on(from_seconds(100.1)); }},
          {101, [](Thermal& t) { t.set_trouble(HeaterId::nozzle, {.strength = 0}); }},
          {130, [](Thermal& t) { t.set_target(HeaterId::nozzle, 220); }}},
         1},
    };
    return all;
}

/// Goes through `course` and collects what take_alarm() gives, asked after each of the steps that
/// `next(thermal, now)` says.
template <class Next>
std::vector<Found> go_through(const Course& course, unsigned& steps, Next next,
                              const ThermalConfig& config = {}) {
    Thermal thermal(config, 7);
    thermal.power_on(SimTime{0});
    std::vector<Found> found;
    SimTime now{0};
    const auto go_to = [&](SimTime end) {
        while (true) {
            const SimTime step = next(thermal, now);
            if (step > end) {
                break;
            }
            now = step;
            ++steps;
            thermal.advance(now);
            while (const auto heater = thermal.take_alarm()) {
                found.push_back({now, *heater, thermal.alarm(*heater)});
            }
        }
        thermal.advance(end);
        now = end;
    };
    for (const Doing& doing : course.doings) {
        go_to(from_seconds(doing.at_s));
        doing.act(thermal);
    }
    go_to(now + from_seconds(3600));
    return found;
}

}  // namespace

TEST_CASE(
    "thermal: who looks only when an alarm may come finds each at the same measurement as who looks at all") {
    for (const Course& course : courses()) {
        CAPTURE(course.name);
        unsigned all = 0;
        unsigned few = 0;
        const std::vector<Found> watched =
            go_through(course, all, [](const Thermal&, SimTime now) { return now + SimTime{100'000}; });
        const std::vector<Found> planned = go_through(
            course, few, [](const Thermal& thermal, SimTime) { return thermal.next_alarm_check(); });
        CHECK(watched.size() >= course.alarms);
        CHECK((course.alarms != 0 || watched.empty()));
        CHECK(planned.size() == watched.size());
        for (std::size_t i = 0; i < std::min(planned.size(), watched.size()); ++i) {
            CAPTURE(i);
            CHECK(planned[i].heater == watched[i].heater);
            CHECK(planned[i].alarm == watched[i].alarm);
            // The one looks each 0.1 s, at the latest so long after the measurement.
            CHECK(watched[i].at - planned[i].at >= SimTime{0});
            CHECK(watched[i].at - planned[i].at < SimTime{100'000});
        }
    }
}

TEST_CASE("thermal: where any change counts, a heater that only cools is found when it has come to rest") {
    ThermalConfig config;
    config.nozzle.protection = {.watch_s = 18, .watch_rise_c = 1, .runaway_c = 10, .any_change = true};
    config.bed.protection = {.watch_s = 60, .watch_rise_c = 1, .runaway_c = 10, .any_change = true};
    for (const Course& course : courses()) {
        CAPTURE(course.name);
        unsigned steps = 0;
        const auto every = [](const Thermal&, SimTime now) { return now + SimTime{100'000}; };
        const auto planned = [](const Thermal& thermal, SimTime) { return thermal.next_alarm_check(); };
        const std::vector<Found> all = go_through(course, steps, every, config);
        const std::vector<Found> few = go_through(course, steps, planned, config);
        REQUIRE(few.size() == all.size());
        for (std::size_t i = 0; i < few.size(); ++i) {
            CHECK(few[i].alarm == all[i].alarm);
            CHECK(all[i].at - few[i].at < SimTime{100'000});
        }
        if (course.name == std::string_view("power lost when hot")) {
            REQUIRE(all.size() == 1);
            CHECK(all[0].at > from_seconds(400 + 120));
            CHECK(all[0].alarm == ThermalAlarm::no_rise);
        }
    }
}

TEST_CASE("thermal: a well heater is looked at now and then only") {
    unsigned looks = 0;
    const std::vector<Found> found = go_through(
        courses().front(), looks, [](const Thermal& thermal, SimTime) { return thermal.next_alarm_check(); });
    CHECK(found.empty());
    CHECK(looks > 10);
    CHECK(looks < 400);  // of 12 000 measurements
}

}  // namespace fauxboard::filament
