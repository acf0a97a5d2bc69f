#include "emulator/behaviour/kind.h"
#include "emulator/dlp/kind.h"
#include "emulator/dlp/profile/tables.h"

namespace fauxboard::dlp {
namespace {

std::shared_ptr<machine::MachineConfig> make_config() {
    return std::make_shared<Config>();
}

void load(behaviour::ObjectReader& reader, behaviour::Findings& findings, machine::MachineConfig& config) {
    load_config(reader, findings, static_cast<Config&>(config));
}

}  // namespace

extern constinit const behaviour::KindRow kind_row{own_kind, fields, actions, make_config,
                                                   load,     lists,  pictures};

}  // namespace fauxboard::dlp
