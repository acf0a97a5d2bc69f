#include "emulator/host/fault_watch.h"

#include <fmt/format.h>

#include "emulator/fault/printer_fault.h"
#include "emulator/fault/spec.h"

namespace fauxboard::host {

void FaultWatch::see(const std::string& id, const std::string& words, const char* begins) {
    const auto [hit, is_new] = known_.try_emplace(id, Known{fmt::format("fault {},", words)});
    hit->second.seen = true;
    if (is_new) {
        say_(fmt::format("{} {}", hit->second.words, begins));
    }
}

void FaultWatch::look() {
    const auto broken = board_.machine().faults.list();
    const auto spoiling = lines_.list();
    if (looking_ || (broken.empty() && spoiling.empty() && known_.empty())) {
        return;
    }
    looking_ = true;
    for (auto& [id, known] : known_) {
        known.seen = false;
    }
    for (const fault::FaultStatus& status : spoiling) {
        const std::string id = std::to_string(status.id);
        see(id, id + ", " + fault::fault_to_text(status.spec), "is on the line");
    }
    for (const machine::Fault& fault : broken) {
        if (fault.state == machine::FaultState::active) {
            see(fault::printer_fault_id(fault.number), fault::printer_fault_words(fault), "begins");
        }
    }
    for (auto each = known_.begin(); each != known_.end();) {
        if (each->second.seen) {
            ++each;
        } else {
            say_(each->second.words + (each->first.starts_with('p') ? " is over" : " is off the line"));
            each = known_.erase(each);
        }
    }
    looking_ = false;
    if (wake_) {
        wake_(board_.machine().faults.next_event());
    }
}

}  // namespace fauxboard::host
