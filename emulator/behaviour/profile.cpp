#include "emulator/behaviour/profile.h"

namespace fauxboard::behaviour {

const std::vector<Rule>* Profile::find(const RequestTable& table, const protocol::Command& command) {
    if (command.letter != 0) {
        const auto hit = table.codes.find(code_key(command.letter, command.number));
        return hit == table.codes.end() ? nullptr : &hit->second;
    }
    const auto hit = table.words.find(command.word);
    return hit == table.words.end() ? nullptr : &hit->second;
}

}  // namespace fauxboard::behaviour
