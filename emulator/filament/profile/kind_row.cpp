#include "emulator/behaviour/kind.h"
#include "emulator/filament/kind.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

/// The tables one after the other.
template <class Row>
std::vector<Row> joined(std::initializer_list<std::span<const Row>> tables) {
    std::vector<Row> rows;
    for (const auto table : tables) {
        rows.insert(rows.end(), table.begin(), table.end());
    }
    return rows;
}

std::span<const behaviour::Field> all_fields() {
    static const auto table = joined<behaviour::Field>(
        {machine_fields(), settings_fields(), device_fields(), fault_fields(), host_fields()});
    return table;
}

std::span<const behaviour::ActionInfo> all_actions() {
    static const auto table = joined<behaviour::ActionInfo>({machine_actions(), device_actions()});
    return table;
}

std::shared_ptr<machine::MachineConfig> make_config() {
    return std::make_shared<Config>();
}

void load(behaviour::ObjectReader& reader, behaviour::Findings& findings, machine::MachineConfig& config) {
    load_config(reader, findings, static_cast<Config&>(config));
}

}  // namespace

extern constinit const behaviour::KindRow kind_row{own_kind, all_fields, all_actions, make_config, load};

}  // namespace fauxboard::filament
