#include "emulator/machine/faults.h"

#include <algorithm>

#include "emulator/machine/kind.h"
#include "emulator/machine/machine.h"

namespace fauxboard::machine {
namespace {

/// Whether a newer one takes the older one's place.
bool same_part(const FaultRequest& a, const FaultRequest& b) {
    if (a.info != b.info) {
        return false;
    }
    const auto& parameters = a.info->parameters;
    return parameters.empty() || parameters[0].unit != FaultUnit::choice || a.values[0] == b.values[0];
}

}  // namespace

std::span<const FaultInfo* const> fault_rows() {
    static const std::vector<const FaultInfo*> all = [] {
        std::vector<const FaultInfo*> rows;
        const auto append = [&](std::span<const FaultInfo> table) {
            for (const FaultInfo& row : table) {
                rows.push_back(&row);
            }
        };
        append(common_faults());
        for (const Kind* kind : kinds()) {
            append(kind->faults());
        }
        return rows;
    }();
    return all;
}

const FaultInfo* find_fault(std::string_view name) {
    const auto all = fault_rows();
    const auto hit =
        std::find_if(all.begin(), all.end(), [&](const FaultInfo* info) { return info->name == name; });
    return hit == all.end() ? nullptr : *hit;
}

bool has_fault(const Kind& kind, const FaultInfo& info) {
    const auto in = [&](std::span<const FaultInfo> table) {
        return std::any_of(table.begin(), table.end(), [&](const FaultInfo& row) { return &row == &info; });
    };
    return in(common_faults()) || in(kind.faults());
}

FaultRequest default_request(const FaultInfo& info) {
    FaultRequest request;
    request.info = &info;
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
        request.values[i] = info.parameters[i].fallback;
    }
    return request;
}

std::string_view state_name(FaultState state) {
    switch (state) {
        case FaultState::waiting:
            return "waiting";
        case FaultState::active:
            return "active";
        case FaultState::over:
            break;
    }
    return "over";
}

unsigned Faults::add(SimTime now, const FaultRequest& request) {
    if (!has_fault(machine_.kind(), *request.info)) {
        return 0;
    }
    if (list_.size() == most) {
        const auto old = std::find_if(list_.begin(), list_.end(),
                                      [](const Fault& b) { return b.state == FaultState::over; });
        if (old == list_.end()) {
            return 0;
        }
        list_.erase(old);
    }
    Fault fault;
    fault.number = ++last_;
    fault.request = request;
    fault.begin = std::max(now, request.begin.value_or(now));
    const SimTime length = request.length.value_or(request.info->length);
    fault.end = request.end ? *request.end : length == never ? never : fault.begin + length;
    list_.push_back(fault);
    refresh();
    return last_;
}

std::string Faults::refusal(const FaultInfo& info) const {
    return has_fault(machine_.kind(), info)
               ? "the printer has " + std::to_string(most) +
                     " faults, which is the most; take some away first"
               : "a machine of the kind " + std::string(machine_.kind().name) + " has no part that " +
                     std::string(info.name) + " could break";
}

bool Faults::remove(unsigned number) {
    const auto hit =
        std::find_if(list_.begin(), list_.end(), [&](const Fault& b) { return b.number == number; });
    if (hit == list_.end()) {
        return false;
    }
    stop(*hit);
    list_.erase(hit);
    refresh();
    return true;
}

bool Faults::active(const FaultInfo& info) const {
    return std::any_of(list_.begin(), list_.end(), [&](const Fault& each) {
        return each.state == FaultState::active && each.request.info == &info;
    });
}

std::size_t Faults::remove(const FaultInfo& info) {
    const auto of_sort = [&](const Fault& each) { return each.request.info == &info; };
    std::size_t count = 0;
    for (auto hit = list_.begin(); (hit = std::find_if(list_.begin(), list_.end(), of_sort)) != list_.end();
         ++count) {
        remove(hit->number);
    }
    return count;
}

void Faults::clear() {
    for (Fault& fault : list_) {
        stop(fault);
    }
    list_.clear();
    refresh();
}

void Faults::start(Fault& fault, SimTime now) {
    if (fault.end <= now) {
        fault.state = FaultState::over;  // its time is long past
        return;
    }
    for (Fault& other : list_) {
        if (other.state == FaultState::active && same_part(other.request, fault.request)) {
            other.state = FaultState::over;
        }
    }
    const FaultInfo& info = *fault.request.info;
    fault.state = info.end != nullptr ? FaultState::active : FaultState::over;
    info.begin(machine_, fault.request.values);
}

void Faults::stop(Fault& fault) {
    if (fault.state == FaultState::active) {
        fault.state = FaultState::over;
        fault.request.info->end(machine_, fault.request.values);
    }
}

void Faults::advance(SimTime now) {
    if (list_.empty()) {
        return;
    }
    for (Fault& fault : list_) {
        const auto gone = fault.request.info->gone;
        if (fault.state == FaultState::waiting && fault.begin <= now) {
            start(fault, now);
        } else if (fault.state == FaultState::active && gone != nullptr &&
                   gone(machine_, fault.request.values)) {
            fault.state = FaultState::over;
        } else if (fault.state == FaultState::active && fault.end <= now) {
            stop(fault);
        }
    }
    refresh();
}

void Faults::refresh() {
    next_ = never;
    for (const Fault& fault : list_) {
        if (fault.state == FaultState::waiting) {
            next_ = std::min(next_, fault.begin);
        } else if (fault.state == FaultState::active) {
            next_ = std::min(next_, fault.end);
        }
    }
}

}  // namespace fauxboard::machine
