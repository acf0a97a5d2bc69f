#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace fauxboard::machine {

/// Things that happen to the machine by itself or as the result of an action. A profile's `events` section
/// says what the board sends when one is raised. Order and number are private; the names in `events()` are
/// the contract.
enum class EventId : std::uint8_t {
    motion_homed,
    motion_axis_homed,
    motion_homing_failed,
    motion_bed_probed,
    motion_probed,
    motion_parked,
    babystep_changed,
    leveling_probe_alarm,
    heating_wait_started,
    heating_wait_report,
    heating_wait_done,
    heating_pid_question,
    heater_nozzle_abnormal,
    heater_bed_abnormal,
    filament_piece,
    filament_stopped,
    filament_too_cold,
    filament_inserted,
    filament_removed,
    filament_out,
    card_inserted,
    card_removed,
    card_missing,
    card_failed,
    file_selected,
    file_missing,
    file_unreadable,
    job_started,
    job_pausing,
    job_paused,
    job_resumed,
    job_stopped,
    job_finished,
    job_closed,
    job_refused,
    job_file_lost,
    job_file_unreadable,
    job_message,
    job_waits_for_user,
    host_done,
    host_busy,
    host_unknown,
    host_wrong_number,
    host_wrong_checksum,
    host_no_checksum,
    host_no_number,
    host_write_failed,
    power_lost,
    job_layer_done,
    board_reboot_due,
    transfer_piece,
    count_  // not an event
};

inline constexpr std::size_t event_count = static_cast<std::size_t>(EventId::count_);

struct EventInfo {
    EventId id;
    std::string_view name;
    std::string_view help;
};

/// Every event, in the order of EventId.
std::span<const EventInfo> events();

/// The event called `name`, or nothing.
std::optional<EventId> find_event(std::string_view name);

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
