#include "emulator/machine/breakdowns.h"

#include <algorithm>

namespace fauxboard::machine {
namespace {

/// Whether a newer one takes the older one's place.
bool same_part(const BreakdownRequest& a, const BreakdownRequest& b) {
    if (a.info != b.info) {
        return false;
    }
    const auto& parameters = a.info->parameters;
    return parameters.empty() || parameters[0].unit != BreakdownUnit::choice || a.values[0] == b.values[0];
}

}  // namespace

const BreakdownInfo* find_breakdown(std::string_view name) {
    const auto all = breakdowns();
    const auto hit =
        std::find_if(all.begin(), all.end(), [&](const BreakdownInfo& info) { return info.name == name; });
    return hit == all.end() ? nullptr : &*hit;
}

BreakdownRequest default_request(const BreakdownInfo& info) {
    BreakdownRequest request;
    request.info = &info;
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
        request.values[i] = info.parameters[i].fallback;
    }
    return request;
}

std::string_view state_name(BreakdownState state) {
    switch (state) {
        case BreakdownState::waiting:
            return "waiting";
        case BreakdownState::active:
            return "active";
        case BreakdownState::over:
            break;
    }
    return "over";
}

unsigned Breakdowns::add(SimTime now, const BreakdownRequest& request) {
    if (list_.size() == most) {
        const auto old = std::find_if(list_.begin(), list_.end(),
                                      [](const Breakdown& b) { return b.state == BreakdownState::over; });
        if (old == list_.end()) {
            return 0;
        }
        list_.erase(old);
    }
    Breakdown breakdown;
    breakdown.number = ++last_;
    breakdown.request = request;
    breakdown.begin = std::max(now, request.begin.value_or(now));
    const SimTime length = request.length.value_or(request.info->length);
    breakdown.end = request.end ? *request.end : length == never ? never : breakdown.begin + length;
    list_.push_back(breakdown);
    refresh();
    return last_;
}

bool Breakdowns::remove(unsigned number) {
    const auto hit =
        std::find_if(list_.begin(), list_.end(), [&](const Breakdown& b) { return b.number == number; });
    if (hit == list_.end()) {
        return false;
    }
    stop(*hit);
    list_.erase(hit);
    refresh();
    return true;
}

std::size_t Breakdowns::remove(BreakdownId id) {
    const auto of_kind = [id](const Breakdown& b) { return b.request.info->id == id; };
    std::size_t count = 0;
    for (auto hit = list_.begin(); (hit = std::find_if(list_.begin(), list_.end(), of_kind)) != list_.end();
         ++count) {
        remove(hit->number);
    }
    return count;
}

void Breakdowns::clear() {
    for (Breakdown& breakdown : list_) {
        stop(breakdown);
    }
    list_.clear();
    refresh();
}

void Breakdowns::start(Breakdown& breakdown, SimTime now) {
    if (breakdown.end <= now) {
        breakdown.state = BreakdownState::over;  // its time is long past
        return;
    }
    for (Breakdown& other : list_) {
        if (other.state == BreakdownState::active && same_part(other.request, breakdown.request)) {
            other.state = BreakdownState::over;
        }
    }
    const BreakdownInfo& info = *breakdown.request.info;
    breakdown.state = info.end != nullptr ? BreakdownState::active : BreakdownState::over;
    info.begin(printer_, breakdown.request.values);
}

void Breakdowns::stop(Breakdown& breakdown) {
    if (breakdown.state == BreakdownState::active) {
        breakdown.state = BreakdownState::over;
        breakdown.request.info->end(printer_, breakdown.request.values);
    }
}

void Breakdowns::advance(SimTime now) {
    if (list_.empty()) {
        return;
    }
    for (Breakdown& breakdown : list_) {
        const auto gone = breakdown.request.info->gone;
        if (breakdown.state == BreakdownState::waiting && breakdown.begin <= now) {
            start(breakdown, now);
        } else if (breakdown.state == BreakdownState::active && gone != nullptr &&
                   gone(printer_, breakdown.request.values)) {
            breakdown.state = BreakdownState::over;
        } else if (breakdown.state == BreakdownState::active && breakdown.end <= now) {
            stop(breakdown);
        }
    }
    refresh();
}

void Breakdowns::refresh() {
    active_ = 0;
    next_ = never;
    for (const Breakdown& breakdown : list_) {
        if (breakdown.state == BreakdownState::waiting) {
            next_ = std::min(next_, breakdown.begin);
        } else if (breakdown.state == BreakdownState::active) {
            next_ = std::min(next_, breakdown.end);
            active_ |= 1U << static_cast<unsigned>(breakdown.request.info->id);
        }
    }
}

}  // namespace fauxboard::machine
