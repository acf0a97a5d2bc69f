#pragma once

#include <cstdint>
#include <memory>

#include "emulator/machine/machine.h"
#include "tests/kinds/beacon/config.h"

namespace fauxboard::beacon {

extern const machine::Kind own_kind;

/// Blinks while it is on. A job is a second of light for each byte of its file.
class Beacon final : public machine::Machine {
  public:
    static const machine::Kind& kind_row() { return own_kind; }

    Beacon(std::shared_ptr<const Config> shared, const machine::Services& services, std::uint64_t seed);

    const Config& config() const { return static_cast<const Config&>(Machine::config()); }

    void switch_on(bool on);
    bool on() const { return on_; }

    machine::HostSide host{events};
    double brightness_percent = 50;  ///< kept in the EEPROM
    std::uint64_t blinks = 0;
    bool bulb_dead = false;

    void seek_job(double /*byte*/) override {}

  private:
    using SimTime = machine::SimTime;
    void power_on_parts(SimTime now) override;
    void run_parts(SimTime now) override;
    SimTime next_of_parts() const override;
    bool restless_parts() const override { return on_; }
    void hang_parts(bool powered) override;
    void job_starts() override;
    void job_pauses(bool park) override;
    void job_goes_on() override { switch_on(true); }
    void job_stops() override { switch_on(false); }
    void job_ends() override { switch_on(false); }
    void all_off(bool /*had_job*/) override { switch_on(false); }

    bool on_ = false;
    SimTime next_blink_ = machine::never;
    SimTime job_end_ = machine::never;
};

}  // namespace fauxboard::beacon
