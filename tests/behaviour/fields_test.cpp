// The table of fields: every row of it.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/kind.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::behaviour;
using std::string;

namespace {

/// A machine of a kind: the program that has all of its fields.
struct Bench {
    std::shared_ptr<const Profile> profile;
    std::unique_ptr<machine::Machine> made{profile->kind->make(profile->machine, {}, 1)};
    machine::Machine& machine{*made};

    explicit Bench(std::string_view kind = "filament")
        : profile(fauxboard::testing::bare_profile(
              kind, kind == "dlp" ? R"(, "dlp": { "firmware": "0.08" })" : "")) {
        machine.power_on(machine::SimTime{0});
    }
    double number(std::string_view path) { return find_field(path)->get(machine).number; }
};

/// What a number field shows after `wanted` was set: integers round, booleans are 0 or 1.
double shown(const Field& field, double wanted) {
    return field.type == FieldType::integer   ? static_cast<double>(std::lround(wanted))
           : field.type == FieldType::boolean ? (wanted != 0 ? 1 : 0)
                                              : wanted;
}

/// The machine has limits of its own that are narrower than the field's bounds: those of its profile, the
/// days of a month, a direction that is never 0, what a newer program bounds. The tests of each say what it
/// keeps.
bool clamped_by_machine(const Field& field) {
    static const std::set<std::string_view> paths{"clock.day", "setup.home_direction", "setup.acceleration",
                                                  "setup.travel_acceleration", "setup.travel_feedrate"};
    return (field.path.ends_with(".target") && field.path.starts_with("heaters.")) ||
           paths.contains(field.path);
}

struct FieldOfKind {
    const Field& field;
    std::string_view kind;
};

/// Every field, with a kind of machine that has it. (Those of all machines: with the first kind.)
std::vector<FieldOfKind> fields_and_kinds() {
    std::vector<FieldOfKind> all;
    for (const Field& field : fields()) {
        std::string_view owner = kinds().front()->machine.name;
        for (const KindRow* kind : kinds()) {
            const auto own = kind->fields();
            const bool has = std::any_of(own.begin(), own.end(),
                                         [&](const Field& each) { return each.path == field.path; });
            owner = has ? kind->machine.name : owner;
        }
        all.push_back({field, owner});
    }
    return all;
}

}  // namespace

TEST_CASE("fields: those of a kind are nothing on a machine of another one, and cannot be set there") {
    for (const KindRow* kind : kinds()) {
        for (const KindRow* other : kinds()) {
            Bench bench(other->machine.name);
            for (const Field& field : kind->fields()) {
                CAPTURE(field.path);
                CHECK(field.get(bench.machine).none() == (kind != other));
                if (kind != other && field.type != FieldType::text) {
                    CHECK(set_field(bench.machine, field, Value::of(field.min)) == SetResult::refused);
                }
            }
        }
    }
}

TEST_CASE("fields: paths are unique, well formed, and found by their name") {
    std::set<std::string_view> paths;
    for (const Field& field : fields()) {
        CAPTURE(field.path);
        CHECK(paths.insert(field.path).second);
        CHECK(find_field(field.path) == &field);
        CHECK(field.path.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.") == string::npos);
        CHECK(field.path.find('.') != string::npos);
        CHECK_FALSE(field.help.empty());
        CHECK_FALSE(type_name(field.type).empty());
        CHECK(nearest_field(field.path) == field.path);
    }
    CHECK(paths.size() > 100);
    CHECK(find_field("no.such") == nullptr);
}

TEST_CASE("fields: what is stored can be set, and bounds are in order") {
    for (const Field& field : fields()) {
        CAPTURE(field.path);
        if (field.stored) {
            const bool settable = field.set != nullptr;
            CHECK(settable);
        }
        if (field.set != nullptr) {
            CHECK(field.min < field.max);
        }
        if (field.type == FieldType::boolean && field.set != nullptr) {
            CHECK(field.min == 0);
            CHECK(field.max == 1);
        }
    }
}

TEST_CASE("fields: every value has the kind its type says, from the first moment on") {
    for (const FieldOfKind& each : fields_and_kinds()) {
        const Field& field = each.field;
        const std::string_view kind = each.kind;
        CAPTURE(field.path);
        Bench bench(kind);
        const Value value = field.get(bench.machine);
        CHECK(value.is_text() == (field.type == FieldType::text));
        if (value.is_number()) {
            CHECK(std::isfinite(value.number));
        }
        if (field.type == FieldType::integer || field.type == FieldType::boolean) {
            CHECK(value.number == std::floor(value.number));
        }
    }
}

TEST_CASE("fields: every settable number keeps what lies within its bounds and clamps what does not") {
    for (const FieldOfKind& each : fields_and_kinds()) {
        const Field& field = each.field;
        const std::string_view kind = each.kind;
        if (field.set == nullptr || field.type == FieldType::text || clamped_by_machine(field)) {
            continue;
        }
        CAPTURE(field.path);
        const double middle = field.min + (field.max - field.min) * 0.37;
        for (const double wanted : {field.min, middle, field.max}) {
            Bench bench(kind);
            CHECK(set_field(bench.machine, field, Value::of(wanted)) == SetResult::done);
            CHECK(field.get(bench.machine).number == doctest::Approx(shown(field, wanted)));
        }
        for (const auto& [wanted, kept] :
             {std::pair{field.min - 1, field.min}, std::pair{field.max + 1, field.max},
              std::pair{-1e300, field.min}, std::pair{1e300, field.max}}) {
            Bench bench(kind);
            CHECK(set_field(bench.machine, field, Value::of(wanted)) == SetResult::clamped);
            CHECK(field.get(bench.machine).number == doctest::Approx(shown(field, kept)));
        }
    }
}

TEST_CASE("fields: a date has the days of its month, and a direction is up or down") {
    Bench bench("dlp");
    const auto set = [&](std::string_view path, double value) {
        const SetResult result = set_field(bench.machine, *find_field(path), Value::of(value));
        const double kept = bench.number(path);
        CHECK(result == (std::abs(kept - std::round(value)) < 0.5 ? SetResult::done : SetResult::clamped));
        return kept;
    };
    set("clock.year", 2024);
    set("clock.month", 2);
    CHECK(set("clock.day", 28.6) == 29);
    CHECK(set("clock.day", 31) == 29);
    CHECK(set("clock.month", 3) == 3);
    CHECK(set("clock.day", 31) == 31);
    CHECK(set("clock.month", 4) == 4);
    CHECK(bench.number("clock.day") == 30);
    CHECK(set("setup.home_direction", 1) == 1);
    CHECK(set("setup.home_direction", 0) == -1);
    CHECK(set("setup.acceleration", 1e6) == 100);
}

TEST_CASE("fields: a number field refuses what is no number, and keeps its value") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const FieldOfKind& each : fields_and_kinds()) {
        const Field& field = each.field;
        const std::string_view kind = each.kind;
        if (field.set == nullptr || field.type == FieldType::text) {
            continue;
        }
        CAPTURE(field.path);
        Bench bench(kind);
        const Value before = field.get(bench.machine);
        for (const Value& wrong : {Value::of(std::nan("")), Value::of(infinity), Value::of(-infinity),
                                   Value::of(std::string_view{"5"}), Value{}}) {
            CHECK(set_field(bench.machine, field, wrong) == SetResult::refused);
            CHECK(field.get(bench.machine) == before);
        }
    }
}

TEST_CASE("fields: every settable text keeps what fits and cuts what does not") {
    int texts = 0;
    for (const FieldOfKind& each : fields_and_kinds()) {
        const Field& field = each.field;
        const std::string_view kind = each.kind;
        if (field.set == nullptr || field.type != FieldType::text) {
            continue;
        }
        ++texts;
        CAPTURE(field.path);
        Bench bench(kind);
        const auto room = static_cast<std::size_t>(field.max);
        const string fits(room, 'a');
        CHECK(set_field(bench.machine, field, Value::of(std::string_view{fits})) == SetResult::done);
        CHECK(field.get(bench.machine).text == fits);
        const string longer(room + 1, 'b');
        CHECK(set_field(bench.machine, field, Value::of(std::string_view{longer})) == SetResult::clamped);
        CHECK(field.get(bench.machine).text == string(room, 'b'));
        CHECK(set_field(bench.machine, field, Value::of(std::string_view{""})) == SetResult::done);
        CHECK(field.get(bench.machine).text.empty());
        CHECK(set_field(bench.machine, field, Value::of(5.0)) == SetResult::refused);
    }
    CHECK(texts >= 5);
}

TEST_CASE("fields: what can only be read refuses every value") {
    Bench bench;
    for (const Field& field : fields()) {
        if (field.set == nullptr) {
            CAPTURE(field.path);
            CHECK(set_field(bench.machine, field, Value::of(1.0)) == SetResult::refused);
            CHECK(set_field(bench.machine, field, Value::of(std::string_view{"x"})) == SetResult::refused);
        }
    }
}

TEST_CASE("fields: a heater's target is kept below the machine's own limit") {
    Bench bench;
    set_field(bench.machine, *find_field("heaters.nozzle.target"), Value::of(900.0));
    CHECK(bench.number("heaters.nozzle.target") == 250);
    CHECK(bench.number("heaters.nozzle.on") == 1);
    set_field(bench.machine, *find_field("heaters.nozzle.target"), Value::of(0.0));
    CHECK(bench.number("heaters.nozzle.on") == 0);
}

TEST_CASE("fields: the stepper fields speak of the driver selected") {
    Bench bench;
    const auto set = [&](const char* path, double value) {
        set_field(bench.machine, *find_field(path), Value::of(value));
    };
    set("stepper.microsteps", 32);
    set("stepper.selected", 2);
    CHECK(bench.number("stepper.microsteps") == 16);
    set("stepper.microsteps", 64);
    set("stepper.selected", 0);
    CHECK(bench.number("stepper.microsteps") == 32);
}
