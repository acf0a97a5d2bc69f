#include "tests/kinds/beacon/beacon.h"

#include <algorithm>
#include <array>
#include <utility>

#include "emulator/machine/event_rows.h"
#include "emulator/machine/fault_row.h"

namespace fauxboard::beacon {
namespace {

constexpr auto own_events = std::to_array<machine::EventInfo>({
    {"beacon.blinked", "the beacon has blinked once more"},
});

consteval machine::EventId event(std::string_view name) {
    return machine::event_in(name, own_events, machine::common_events);
}

constexpr std::array faults{
    machine::fault_row<Beacon>(
        "bulb_dead", "the bulb is burnt: the beacon believes that it shines", {}, "", {}, machine::never,
        [](Beacon& beacon, const machine::FaultValues&) { beacon.bulb_dead = true; },
        [](Beacon& beacon, const machine::FaultValues&) { beacon.bulb_dead = false; }, nullptr),
};

std::span<const machine::FaultInfo> own_faults() {
    return faults;
}

std::unique_ptr<machine::Machine> make(std::shared_ptr<const machine::MachineConfig> config,
                                       const machine::Services& services, std::uint64_t seed) {
    return std::make_unique<Beacon>(std::static_pointer_cast<const Config>(std::move(config)), services,
                                    seed);
}

}  // namespace

constinit const machine::Kind own_kind{"beacon", "a beacon that blinks", own_events, own_faults, make};

Beacon::Beacon(std::shared_ptr<const Config> shared, const machine::Services& services, std::uint64_t seed)
    : Machine(own_kind, std::move(shared), services, seed, host) {}

void Beacon::switch_on(bool on) {
    on_ = on;
    next_blink_ = on ? now() + machine::from_seconds(config().period_s) : machine::never;
}

void Beacon::power_on_parts(SimTime /*now*/) {
    switch_on(false);
    brightness_percent = 50;
    job_end_ = machine::never;
}

void Beacon::run_parts(SimTime now) {
    if (next_blink_ <= now) {
        blinks += bulb_dead ? 0 : 1;
        next_blink_ += machine::from_seconds(config().period_s);
        events.raise(event("beacon.blinked"));
    }
    if (job_end_ <= now) {
        job_end_ = machine::never;
        finish_job();
    }
}

machine::SimTime Beacon::next_of_parts() const {
    return std::min(next_blink_, job_end_);
}

void Beacon::hang_parts(bool powered) {
    if (!powered) {
        switch_on(false);
    }
}

void Beacon::job_starts() {
    switch_on(true);
    job_end_ = now() + std::chrono::seconds(job.file_bytes());
}

void Beacon::job_pauses(bool /*park*/) {
    switch_on(false);
    job.pause(now());
    events.raise(event("job.paused"));
}

}  // namespace fauxboard::beacon
