#include "emulator/world/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "emulator/behaviour/action_words.h"
#include "emulator/behaviour/fields.h"
#include "emulator/machine/host_side.h"
#include "emulator/world/peers.h"
#include "emulator/world/steps.h"
#include "protocol/framing.h"
#include "protocol/host_line.h"

namespace fauxboard::world {
namespace {

using board::Channel;

constexpr std::size_t most_places = 4096;

bool is_acknowledgement(std::string_view line) {
    return line.starts_with("ok") && (line.size() == 2 || line[2] == ' ');
}

unsigned checksum(std::string_view text) {
    unsigned sum = 0;
    for (const char c : text) {
        sum ^= static_cast<unsigned char>(c);
    }
    return sum;
}

}  // namespace

World::World(const Cast& cast, std::uint64_t seed, board::Observer* listener)
    : cast_(cast), seed_(seed), listener_(listener), eeprom_cells_(cast.profile->machine->eeprom_bytes) {
    for (const auto& [path, content] : cast.files) {
        disk_.put(path, content);
    }
    if (cast.screen) {
        screen_.emplace(cast.screen);
        screen_->power_on(SimTime{0});
    }
    job_place_.on_keep = [this] { note_place(); };
    make_board();
}

World::~World() = default;

void World::make_board() {
    machine::Services services;
    services.sd = &disk_;
    services.eeprom = &eeprom_;
    services.eeprom_cells = &eeprom_cells_;
    services.job_place = &job_place_;
    board::Options options;
    options.seed = seed_;
    options.observer = this;
    board_ = std::make_unique<board::Board>(cast_.profile, services, options);
    board_->connect(Channel::host, true);
    if (cast_.scenario) {
        scene_.emplace(cast_.scenario);
    }
    eeprom_.power_on();
    ledger_.lines_heard = ledger_.lines_said = 0;
    ledger_.harmed = ledger_.job_over = false;
    ledger_.before = now_;
    board_->power_on(now_);
    ledger_.eeprom_at_first = board_->machine().eeprom_image.text();
    take_output();
}

// What the board is told of.
// -----------------------------------------------------------------------------------------------

void World::on_received(SimTime now, Channel channel, std::string_view line, board::Verdict verdict) {
    if (listener_ != nullptr) {
        listener_->on_received(now, channel, line, verdict);
    }
    if (scene_) {
        scene_->observer().on_received(now, channel, line, verdict);
    }
    ++ledger_.lines_heard;
    ++requests_;
    note(line);
    if (line.find("M24") != std::string_view::npos || line.find("M26") != std::string_view::npos) {
        new_job();  // with an S it is told to go on elsewhere, once it is carried out
        told_to_jump_ = now;
    }
    const behaviour::LineConfig& main_line = cast_.profile->line;
    if (channel == Channel::main && verdict == board::Verdict::accepted && main_line.codes.empty() &&
        main_line.framing == behaviour::Framing::frames &&
        protocol::unframe(line, main_line.checksum).fault != protocol::FrameFault::none) {
        ++ledger_.damaged_taken;
    }
    if (channel == Channel::host) {
        first_verdict_ = first_verdict_.value_or(verdict);
    }
    std::array<char, protocol::max_line_bytes> room;
    const std::string_view kept = protocol::read_host_line(line, room, protocol::max_line_bytes);
    const bool blank = kept.find_first_not_of(" \t\r") == std::string_view::npos;
    const bool answers = cast_.probes[static_cast<std::size_t>(Channel::host)].has_value();
    if (channel == Channel::host && answers && verdict == board::Verdict::accepted && !blank) {
        ++ledger_.commands_taken;
    }
}

void World::on_sent(SimTime now, Channel channel, std::string_view line) {
    if (listener_ != nullptr) {
        listener_->on_sent(now, channel, line);
    }
    if (scene_) {
        scene_->observer().on_sent(now, channel, line);
    }
    ++ledger_.lines_said;
    if (channel != Channel::host || !cast_.probes[static_cast<std::size_t>(Channel::host)]) {
        return;
    }
    if (line.starts_with("Resend:")) {
        ledger_.ok_of_resend = true;
    } else if (is_acknowledgement(line) && !std::exchange(ledger_.ok_of_resend, false)) {
        ++ledger_.commands_acknowledged;
    }
}

void World::on_notice(SimTime now, board::Level level, std::string_view text) {
    if (listener_ != nullptr) {
        listener_->on_notice(now, level, text);
    }
    note(text);
}

std::int64_t World::owed() const {
    const std::uint64_t settled = ledger_.commands_acknowledged + commands_without_ok(board_->machine());
    return static_cast<std::int64_t>(ledger_.commands_taken) - static_cast<std::int64_t>(settled);
}

/// Also when a command or a rule restarts it.
void World::on_power_on(SimTime) {
    remark("the board is switched on");
    ledger_.commands_taken = ledger_.commands_acknowledged = 0;
    ledger_.ok_of_resend = false;
    line_number_ = 0;
    new_job();
}

void World::on_event(SimTime now, machine::EventId event) {
    if (scene_) {
        scene_->observer().on_event(now, event);
    }
    if (event->name == "job.started" || event->name == "job.stopped" || event->name == "job.replaced" ||
        event->name == "file.selected") {
        new_job();
    } else if (event->name == "job.paused") {
        ledger_.paused = true;
    }
    if (event->name == "job.finished" || event->name == "job.stopped" || event->name == "job.replaced") {
        ledger_.job_over = true;
    } else if (event->name == "job.started") {
        ledger_.job_over = false;
    }
    ledger_.prints.see(event, board_->machine());
}

/// Where the job under way is executed: a place at which it may be taken up again.
void World::note_place() {
    const machine::Machine& machine = board_->machine();
    const auto byte = machine.job.active() ? number_of(machine, "job.executed_byte") : std::nullopt;
    if (byte) {
        ledger_.job_executed = static_cast<std::uint64_t>(*byte);
        ledger_.places[machine.job.path()].insert(static_cast<std::uint64_t>(*byte));
    }
}

void World::note(std::string_view bytes) {
    for (const char c : bytes) {
        digest_ = (digest_ ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    }
    digest_ = (digest_ ^ static_cast<std::uint64_t>(now_.count())) * 0x100000001B3U;
}

// Invariants.
// -----------------------------------------------------------------------------------------------

void World::look(Moment moment, Channel channel, std::string_view output) {
    const View view{*board_, ledger_, disk_, eeprom_, screen_ ? &*screen_ : nullptr, channel, output};
    for (const Invariant& each : invariants()) {
        if (each.moment != moment) {
            continue;
        }
        if (const std::string found = each.broken(view); !found.empty()) {
            throw Broken(fmt::format("{}: {} ({})", each.name, found, each.promise));
        }
    }
}

void World::after_step() {
    if (told_to_jump_) {
        new_job();
        if (now_ > *told_to_jump_ + std::chrono::seconds(10) && owed() <= 0) {
            told_to_jump_.reset();
        }
    }
    ledger_.most_bytes_read = std::max(ledger_.most_bytes_read, disk_.take_bytes_read());
    ledger_.now = now_;
    look(Moment::step);
    const machine::Machine& machine = board_->machine();
    ledger_.before = board_->time();
    ledger_.job_byte = machine.job.byte();
    ledger_.job_seen = ledger_.job_number;
    ledger_.paused = false;
    ledger_.harmed = ledger_.harmed || !machine.faults.list().empty();
    ledger_.most_bytes_read = 0;
    ledger_.stops_at_one_moment = 0;
}

// Time and lines.
// -----------------------------------------------------------------------------------------------

void World::take_output() {
    for (const Channel channel : {Channel::main, Channel::host}) {
        const std::string_view output = board_->output(channel);
        if (output.empty()) {
            continue;
        }
        look(Moment::output, channel, output);
        note(output);
        if (channel == asked_) {
            heard_ += output;
        }
        if (channel == Channel::main && screen_) {
            screen_->receive(now_, output);
        }
    }
    board_->clear_output();
    board_->take_datagrams([this](std::uint64_t, std::string_view bytes) {
        note(bytes);
        if (asked_ == Channel::network) {
            heard_ += bytes;
        }
    });
    note_place();
}

/// Lets the board and the screen come to that moment, each at its own ones.
void World::run_to(SimTime time) {
    SimTime last = now_;
    while (true) {
        const SimTime due = board_->advance(std::min(time, now_));
        take_output();
        ledger_.most_bytes_read = std::max(ledger_.most_bytes_read, disk_.take_bytes_read());
        if (due <= now_) {
            if (++ledger_.stops_at_one_moment > 100'000) {
                look(Moment::step);
            }
            continue;
        }
        SimTime next = std::min(due, time);
        if (scene_) {
            if (scene_->is_due(now_)) {
                scene_->advance(now_, *board_, screen_ ? &*screen_ : nullptr);
                new_job();  // it may have been sought in
                take_output();
                continue;
            }
            next = std::min(next, scene_->due());
        }
        if (screen_) {
            const SimTime screen_due = screen_->advance(now_);
            if (!screen_->output().empty()) {
                const std::string said(screen_->output());
                screen_->clear_output();
                board_->receive(now_, said, Channel::main);
                take_output();
                continue;
            }
            next = std::min(next, std::max(screen_due, now_ + SimTime{1}));
        }
        if (now_ >= time) {
            return;
        }
        now_ = std::max(next, now_);
        if (now_ != last) {
            ledger_.stops_at_one_moment = 0;
            last = now_;
        }
    }
}

void World::pass(SimTime time) {
    run_to(now_ + time);
}

void World::say(Channel channel, std::string_view bytes) {
    if (!bytes.empty()) {
        board_->receive(now_, bytes, channel);
        take_output();
        run_to(now_);
    }
}

bool World::command(std::string_view body) {
    const std::int64_t number = ++line_number_;  // a reset meanwhile begins anew
    const std::string line = fmt::format("N{} {}", number, body);
    first_verdict_.reset();
    say(Channel::host, fmt::format("{}*{}\n", line, checksum(line)));
    // One that was not taken is not counted; what is too long, or has line ends in it, is several, and the
    // number stands in the first. Not that of whichever line spoke last.
    const std::int64_t last = board_->machine().host_side().lines[machine::HostSide::usb_port].last;
    const bool taken = first_verdict_ == board::Verdict::accepted;
    ledger_.lost_counted += !taken && last == number ? 1U : 0U;
    line_number_ = last;
    return taken;
}

void World::datagram(std::uint64_t peer, std::string_view bytes) {
    ++requests_;
    board_->receive_datagram(now_, peer, bytes);
    take_output();
    run_to(now_);
}

std::string World::told(std::uint64_t peer, std::string_view bytes) {
    asked_ = Channel::network;
    heard_.clear();
    datagram(peer, bytes);
    return std::exchange(heard_, {});
}

void World::is_saved(const std::string& path, std::string_view content) {
    const std::string* const there = disk_.content(path);
    if (there == nullptr || *there != content) {
        ledger_.not_saved = path;
    }
}

void World::tinker(const std::function<void(machine::Machine&)>& use) {
    board_->tinker(now_, use);
    take_output();
    run_to(now_);
}

void World::user_continues() {
    tinker([this](machine::Machine& machine) {
        machine.user_continues();
        ledger_.unheard = ledger_.unheard || machine.job.waits_for_user;
    });
}

void World::remark(const std::string& text) {
    if (listener_ != nullptr) {
        listener_->on_notice(now_, board::Level::info, text);
    }
}

void World::act(std::string_view words) {
    try {
        const auto calls = behaviour::parse_action_words(words, *cast_.profile);
        remark(fmt::format("wished: {}", words));
        for (const behaviour::ActionCall& call : calls) {
            board_->act(now_, call);
        }
    } catch (const behaviour::ActionWordsError&) {
        return;  // not of this machine
    }
    take_output();
    run_to(now_);
}

void World::touch(fault::Dice& dice) {
    if (screen_ && screen_->ready() && !screen_->page().buttons.empty()) {
        const auto& buttons = screen_->page().buttons;
        const auto [button, choice, value] = draw(dice, buttons.size(), 4, 300);
        screen_->touch(buttons[button], choice, static_cast<double>(value), now_);
        run_to(now_);
    }
}

// Power.
// -----------------------------------------------------------------------------------------------

void World::reset() {
    board_->power_on(now_);
    take_output();
}

void World::power_cut(fault::Dice& dice) {
    disk_.power_cut(dice);
    job_place_.power_cut(dice);
    for (auto& [path, places] : ledger_.places) {
        if (places.size() > most_places) {
            places.erase(places.begin());
        }
    }
    past_ += now_;
    now_ = SimTime{0};
    told_to_jump_.reset();
    if (screen_) {
        screen_.emplace(cast_.screen);
        screen_->power_on(now_);
    }
    make_board();
    look(Moment::power_cut);
}

void World::reload() {
    board_->reload(cast_.profile);
    take_output();
    run_to(now_);
}

// The course of a world.
// -----------------------------------------------------------------------------------------------

void World::step(std::uint64_t number) {
    fault::Dice dice(seed_, number, 0);
    do_step(*this, dice);
    after_step();
}

}  // namespace fauxboard::world
