#include "emulator/panel/assets.h"

namespace fauxboard::panel {

const Asset* find_asset(std::string_view name) {
    for (const Asset& asset : assets()) {
        if (asset.name == name) {
            return &asset;
        }
    }
    return nullptr;
}

}  // namespace fauxboard::panel
