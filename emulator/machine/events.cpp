#include "emulator/machine/events.h"

#include <algorithm>
#include <functional>

#include "emulator/machine/event_rows.h"
#include "emulator/machine/kind.h"

namespace fauxboard::machine {
namespace {

void append(std::vector<EventId>& out, std::span<const EventInfo> table) {
    for (const EventInfo& row : table) {
        out.push_back(&row);
    }
}

bool is_in(std::span<const EventInfo> table, EventId event) {
    const std::less<> before;
    return !before(event, table.data()) && before(event, table.data() + table.size());
}

}  // namespace

std::span<const EventId> events() {
    static const std::vector<EventId> all = [] {
        std::vector<EventId> rows;
        append(rows, common_events);
        for (const Kind* kind : kinds()) {
            append(rows, kind->events);
        }
        return rows;
    }();
    return all;
}

std::optional<EventId> find_event(std::string_view name) {
    const auto all = events();
    const auto hit = std::find_if(all.begin(), all.end(), [&](EventId event) { return event->name == name; });
    return hit == all.end() ? std::nullopt : std::optional{*hit};
}

std::vector<EventId> events_of(const Kind& kind) {
    std::vector<EventId> rows;
    append(rows, common_events);
    append(rows, kind.events);
    return rows;
}

bool has_event(const Kind& kind, EventId event) {
    return is_in(common_events, event) || is_in(kind.events, event);
}

std::size_t event_index(const Kind& kind, EventId event) {
    return is_in(common_events, event)
               ? static_cast<std::size_t>(event - common_events.data())
               : common_events.size() + static_cast<std::size_t>(event - kind.events.data());
}

}  // namespace fauxboard::machine
