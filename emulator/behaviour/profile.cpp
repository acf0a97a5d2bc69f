#include "emulator/behaviour/profile.h"

#include <algorithm>

namespace fauxboard::behaviour {

std::vector<Rule>& CodeTable::operator[](std::uint32_t key) {
    const auto known =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
    if (known != entries_.end()) {
        return known->rules;
    }
    entries_.push_back({key, {}});
    if (slots_.size() < 2 * entries_.size()) {
        slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), no_entry);
        for (std::size_t i = 0; i + 1 < entries_.size(); ++i) {
            enter(i);
        }
    }
    enter(entries_.size() - 1);
    return entries_.back().rules;
}

void CodeTable::enter(std::size_t index) {
    std::size_t at = place(entries_[index].key);
    while (slots_[at] != no_entry) {
        at = (at + 1) & (slots_.size() - 1);
    }
    slots_[at] = static_cast<std::uint32_t>(index);
}

const std::vector<Rule>* Profile::find(const RequestTable& table, const protocol::Command& command) {
    if (command.letter != 0) {
        const std::vector<Rule>* rules = table.codes.find(code_key(command.letter, command.number));
        return rules != nullptr ? rules : table.any();
    }
    const auto hit = table.words.find(command.word);
    return hit == table.words.end() ? table.any() : &hit->second;
}

const std::vector<Rule>* Profile::RequestTable::any() const {
    const auto hit = words.find(any_request);
    return hit == words.end() ? nullptr : &hit->second;
}

}  // namespace fauxboard::behaviour
