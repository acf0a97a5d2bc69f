// The EEPROM image: one "path value" a line.

#include "emulator/behaviour/eeprom.h"

#include <doctest/doctest.h>

#include <string>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/kind.h"
#include "tests/support/printers.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::behaviour;
using std::string;

namespace {

/// A machine of a kind.
struct Bench {
    std::shared_ptr<const Profile> profile;
    std::unique_ptr<machine::Machine> made{profile->kind->make(profile->machine, {}, 1)};
    machine::Machine& machine{*made};

    explicit Bench(std::string_view kind = "filament") : profile(fauxboard::testing::bare_profile(kind)) {
        machine.power_on(machine::SimTime{0});
    }
};

/// Every stored field gets another value than the one it has.
void change_everything(machine::Machine& machine) {
    double part = 0.1;
    for (const Field& field : fields()) {
        if (field.stored && field.type != FieldType::text && !field.get(machine).none()) {
            part = part > 0.9 ? 0.1 : part + 0.07;
            const bool flag = field.type == FieldType::boolean;
            const double value =
                flag ? 1 - field.get(machine).number : field.min + (field.max - field.min) * part;
            set_field(machine, field, Value::of(value));
        }
    }
}

}  // namespace

TEST_CASE("EEPROM image: every stored field comes back exactly as it was") {
    for (const KindRow* kind : kinds()) {
        CAPTURE(kind->machine.name);
        Bench changed(kind->machine.name);
        change_everything(changed.machine);
        const string image = make_image(changed.machine);
        Bench fresh(kind->machine.name);
        const auto own = kind->fields();
        const bool keeps =
            std::any_of(own.begin(), own.end(), [](const Field& field) { return field.stored; });
        CHECK((make_image(fresh.machine) != image) == keeps);  // one kind has a chip of its own instead
        apply_image(fresh.machine, image, {});
        CHECK(make_image(fresh.machine) == image);
        for (const Field& field : kind->fields()) {
            if (field.stored) {
                CAPTURE(field.path);
                CHECK(field.get(fresh.machine) == field.get(changed.machine));
                CHECK(("\n" + image).find("\n" + string(field.path) + " ") != string::npos);
            }
        }
    }
}

TEST_CASE("EEPROM image: numbers that decimals cannot hold exactly survive too") {
    Bench bench;
    const Field& field = *find_field("settings.steps.x");
    for (const double value : {0.1, 1.0 / 3, 80.123456789012345, 99999.99999999999}) {
        set_field(bench.machine, field, Value::of(value));
        const string image = make_image(bench.machine);
        set_field(bench.machine, field, Value::of(1.0));
        apply_image(bench.machine, image, {});
        CHECK(field.get(bench.machine).number == value);
    }
}

TEST_CASE("EEPROM image: saving one group leaves the others, and lines of others, as they are") {
    Bench bench;
    bench.machine.eeprom_image = "from.the.future 42\nsettings.steps.x 81\naddons.sound 0\nweird\n";
    change_everything(bench.machine);
    CHECK(save_fields(bench.machine, "addons."));
    const auto text = [&]() -> const string& { return bench.machine.eeprom_image.text(); };
    CHECK(text().find("from.the.future 42\n") != string::npos);
    CHECK(text().find("settings.steps.x 81\n") != string::npos);
    CHECK(text().find("addons.sound 1\n") != string::npos);
    CHECK(text().find("addons.sound 0\n") == string::npos);
    CHECK(text().find("settings.steps.y") == string::npos);
    CHECK(save_fields(bench.machine, {}));
    CHECK(text().find("from.the.future 42\n") != string::npos);
    CHECK(text().find("settings.steps.x 81\n") == string::npos);
    const string once = text();
    CHECK(save_fields(bench.machine, {}));
    CHECK(text() == once);  // saving twice does not grow it
}

TEST_CASE("EEPROM image: loading one group takes only that") {
    Bench bench;
    bench.machine.eeprom_image = "settings.steps.x 81\nsettings.jerk.x 9\naddons.sound 1\n";
    load_fields(bench.machine, "settings.steps.");
    CHECK(fauxboard::testing::filament_printer(bench.machine).settings.steps_per_mm[0] == 81);
    CHECK(fauxboard::testing::filament_printer(bench.machine).settings.jerk_mm_s[0] == 7);
    CHECK_FALSE(fauxboard::testing::filament_printer(bench.machine).addons.sound);
}

TEST_CASE("EEPROM image: what cannot be read is passed over") {
    Bench bench;
    const string before = make_image(bench.machine);
    for (const string image :
         {"", "\n\n\n", "settings.steps.x", "settings.steps.x ", " 5", "settings.steps.x abc",
          "settings.steps.x 5x", "settings.steps.x 0x10", "settings.steps.x nan", "settings.steps.x inf",
          "settings.steps.x  5", "motion.homed 1", "no.such 5", "settings.steps.x\t5"}) {
        CAPTURE(image);
        apply_image(bench.machine, image, {});
        CHECK(make_image(bench.machine) == before);
    }
    apply_image(bench.machine, string("\0\xff\r\n", 4) + string(100000, 'x'), {});
    CHECK(make_image(bench.machine) == before);
}
