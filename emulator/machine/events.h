#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace fauxboard::machine {

struct Kind;

/// Something that happens to a machine by itself or as the result of an action. A profile's `events` section
/// says what the board sends when one is raised. The name is the contract.
struct EventInfo {
    std::string_view name;
    std::string_view help;
};

/// An event is its row in a table: that of all machines (event_rows.h), or that of a kind.
using EventId = const EventInfo*;

/// Every event, those of all machines first, then each kind's. Names are unique among all of them.
std::span<const EventId> events();
/// The event called `name`, of whatever kind; nothing when there is none.
std::optional<EventId> find_event(std::string_view name);

/// The events that a machine of the kind may raise.
std::vector<EventId> events_of(const Kind& kind);
bool has_event(const Kind& kind, EventId event);
/// The place of one of them in events_of().
std::size_t event_index(const Kind& kind, EventId event);

/// Events raised and not yet looked at, oldest first. Bounded: a full queue drops the newest and counts it,
/// since a profile that loops on its own events must not grow the process.
class EventQueue {
  public:
    void raise(EventId id) {
        if (size_ == ring_.size()) {
            ++dropped_;
            return;
        }
        ring_[(head_ + size_++) % ring_.size()] = id;
    }
    std::optional<EventId> take() {
        if (size_ == 0) {
            return std::nullopt;
        }
        const EventId id = ring_[head_];
        head_ = (head_ + 1) % ring_.size();
        --size_;
        return id;
    }
    bool empty() const { return size_ == 0; }
    void clear() { size_ = 0; }
    std::uint64_t dropped() const { return dropped_; }

  private:
    std::array<EventId, 64> ring_{};
    std::size_t head_ = 0;
    std::size_t size_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace fauxboard::machine
