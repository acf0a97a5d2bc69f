#include <array>

#include "emulator/behaviour/action_rows.h"
#include "emulator/behaviour/field_rows.h"
#include "emulator/behaviour/kind.h"
#include "tests/kinds/beacon/beacon.h"

namespace fauxboard::beacon {
namespace {

using behaviour::ActionContext;
using behaviour::ActionInfo;
using behaviour::ArgInfo;
using behaviour::Args;
using behaviour::own;
using enum behaviour::FieldType;

constexpr behaviour::FieldRows<Beacon> row;

constexpr std::array field_table{
    row.shown("beacon.on", boolean, "", "the beacon is switched on", [](const Beacon& l) { return l.on(); }),
    row.shown("beacon.blinks", integer, "", "how often it has shone",
              [](const Beacon& l) { return l.blinks; }),
    row.stored("beacon.brightness", number, "%", 1, 100, "how brightly", FAUXBOARD_PLACE(brightness_percent)),
};

void switch_beacon(Beacon& beacon, ActionContext&, Args a) {
    beacon.switch_on(behaviour::flag(a[0]));
}

constexpr std::array switch_args{ArgInfo{"on", behaviour::ArgType::boolean, true, "on or off"}};
constexpr std::array action_table{
    ActionInfo{"beacon.switch", "", "switches the beacon", switch_args, own<switch_beacon>},
};

std::span<const behaviour::Field> fields() {
    return field_table;
}
std::span<const ActionInfo> actions() {
    return action_table;
}
std::shared_ptr<machine::MachineConfig> make_config() {
    return std::make_shared<Config>();
}
void load(behaviour::ObjectReader& reader, behaviour::Findings&, machine::MachineConfig& config) {
    reader.number("beacon_period_s", static_cast<Config&>(config).period_s, 0.01, 60);
}

}  // namespace

extern constinit const behaviour::KindRow kind_row{own_kind, fields, actions, make_config, load};

}  // namespace fauxboard::beacon
