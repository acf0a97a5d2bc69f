#include "emulator/machine/machine.h"

#include <algorithm>
#include <utility>

#include "emulator/machine/event_rows.h"

namespace fauxboard::machine {
namespace {

/// After power-on the board looks for the card in its main loop, not before: the recorded boot without a card
/// tells of it between the first real temperatures (0.85 s) and the first L21 (1.75 s).
constexpr SimTime card_check_delay{1'200'000};
/// After so long without a word the USB side counts as left alone.
constexpr SimTime host_patience{10'000'000};

}  // namespace

Machine::Machine(const Kind& kind, std::shared_ptr<const MachineConfig> config, const Services& services,
                 std::uint64_t seed, HostSide& host_side)
    : kind_(kind),
      config_(std::move(config)),
      services_(services),
      host_side_(host_side),
      random_state_(seed ^ 0x9E3779B97F4A7C15ULL) {
    if (services_.sd == nullptr && config_->card.present) {
        built_in_.emplace(config_->card.entries);
    }
    storage.configure(config_->card);
    put_in(0);
    if (config_->udisk_port) {
        put_in(1);
    }
    events.clear();
}

void Machine::power_on(SimTime now) {
    now_ = now;
    storage.choose(0);
    transfer.power_on();
    job.power_on();
    host_side_.power_on();
    wifi = Wifi{};
    loop = MainLoop{};
    refusing = hung_ = reset_ = dying_ = false;
    commands.begun = nullptr;
    user_until_ = never;
    host_heard_.reset();
    power_on_parts(now);
    events.clear();
    const double found_s = config_->card.found_s;
    card_check_ = found_s > 0          ? now + from_seconds(found_s)
                  : !storage.usable(0) ? now + card_check_delay
                                       : never;
    const SimTime rescan = from_seconds(config_->card.rescan_s);
    card_rescan_ = rescan > SimTime{0} && storage.usable(0) ? now + rescan : never;
    card_news_ = storage.usable(0);
    timer_ = never;
}

void Machine::advance(SimTime now) {
    // Events must come in their order, so time moves from one to the next.
    for (SimTime next = next_event(); next <= now; next = next_event()) {
        now_ = next;
        let_pass(next);
        faults.advance(next);
        if (hung_) {
            continue;
        }
        look_after_card(next);
        if (timer_ <= next) {
            timer_ = never;
            events.raise(event("timer.over"));
        }
        if (user_until_ <= next) {
            user_continues();
        }
        run_parts(next);
    }
    pass(now);
}

void Machine::pass(SimTime now) {
    let_pass(now);
    now_ = now;
    faults.advance(now);  // what somebody has seen to is over
}

SimTime Machine::next_event() const {
    const SimTime fault = faults.next_event();
    return hung_ ? fault : earliest(next_of_parts(), card_check_, card_rescan_, timer_, user_until_, fault);
}

void Machine::look_after_card(SimTime now) {
    if (card_check_ <= now) {
        card_check_ = never;
        events.raise(storage.usable(0) ? event("card.found") : event("card.missing"));
    }
    if (card_rescan_ <= now) {
        card_rescan_ = never;
        card_news_ = storage.usable(0);
    }
}

bool Machine::restless() const {
    return !hung_ && (job.status() == JobStatus::printing || restless_parts());
}

void Machine::insert_card(int disk) {
    if (disk == 0 || config_->udisk_port) {
        put_in(disk);
    }
}

void Machine::put_in(int disk) {
    Volume* volume = disk == 1 ? services_.udisk : services_.sd;
    if (volume == nullptr && disk == 0 && built_in_) {
        volume = &*built_in_;
    }
    const bool was_there = storage.usable(disk);
    storage.attach(disk, volume);
    if (storage.usable(disk) && !was_there) {
        card_news_ = true;
        events.raise(event("card.inserted"));
    }
}

void Machine::remove_card(int disk) {
    const bool was_there = storage.usable(disk);
    storage.attach(disk, nullptr);
    if (was_there) {
        card_news_ = true;
        events.raise(event("card.removed"));
    }
}

void Machine::fail_card(int disk) {
    const bool was_there = storage.usable(disk);
    if (storage.state(disk) != DiskState::removed) {
        storage.set_state(disk, DiskState::failed);
    }
    if (was_there) {
        events.raise(event("card.failed"));
    }
}

int Machine::disk_code() const {
    const int sd = static_cast<int>(storage.state(0));
    return config_->udisk_port ? sd + 16 * static_cast<int>(storage.state(1)) : sd;
}

const std::vector<CardEntry>& Machine::listing() {
    const Volume* const fixed = storage.fixed_volume();
    if (fixed == nullptr || fixed != listed_ || storage.folder() != listed_folder_) {
        storage.listing(listing_, config_->card.max_listed);
        listed_ = fixed;
        listed_folder_ = storage.folder();
    }
    return listing_;
}

const std::vector<CardEntry>& Machine::files() {
    constexpr std::size_t most_files = 4096;
    storage.files(files_, most_files);
    return files_;
}

void Machine::kill() {
    emergency_stop();
    dying_ = true;
    events.raise(event("board.killed"));
}

void Machine::die_if_told() {
    if (std::exchange(dying_, false)) {
        hang(false);
    }
}

void Machine::hang(bool powered) {
    hung_ = true;
    hang_parts(powered);
}

bool Machine::take_reset() {
    return std::exchange(reset_, false);
}

bool Machine::host_active() const {
    return host_heard_ && now_ - *host_heard_ <= host_patience;
}

double Machine::random() {
    // splitmix64
    std::uint64_t z = random_state_ += 0x9E3779B97F4A7C15ULL;
    z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ z >> 27U) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ z >> 31U) >> 11U) * 0x1.0p-53;
}

}  // namespace fauxboard::machine
