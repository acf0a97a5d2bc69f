#include "emulator/dlp/printer.h"

#include <algorithm>
#include <utility>

#include "emulator/dlp/event_rows.h"
#include "emulator/machine/disk_source.h"

namespace fauxboard::dlp {
namespace {

using machine::CardEntry;
using machine::Volume;

/// A file whose stick may have trouble.
class StickSource final : public sliced::ByteSource {
  public:
    StickSource(const Volume& volume, std::string path, const bool& read_errors)
        : source_(volume, std::move(path)), read_errors_(read_errors) {}
    std::uint64_t size() const override { return source_.size(); }
    std::size_t read(std::uint64_t offset, std::span<char> out) const override {
        return read_errors_ ? 0 : source_.read(offset, out);
    }

  private:
    machine::DiskSource source_;
    const bool& read_errors_;
};

static_assert(own_events.size() == static_cast<std::size_t>(Event::touch_not_calibrated) + 1,
              "each of the board's events has its row");

}  // namespace

Printer::Printer(std::shared_ptr<const Config> config, const machine::Services& services, std::uint64_t seed)
    : Machine(kind_row(), config, services, seed, host),
      config_(std::move(config)),
      board(config_->board, *this, services.eeprom_cells, seed, *this) {}

void Printer::power_on_parts(SimTime now) {
    last_note.clear();
    board.power_on(now);
}

void Printer::run_parts(SimTime now) {
    if (cut_share_ && board.eeprom.when(*cut_share_) <= now) {
        cut_share_.reset();
        board.eeprom.advance(now);
        machine::FaultRequest request = machine::default_request(*machine::find_fault("brown_out"));
        request.begin = now;
        faults.add(now, request);
        return;
    }
    board.advance(now);
}

SimTime Printer::next_of_parts() const {
    return std::min(board.next_event(), cut_share_ ? board.eeprom.when(*cut_share_) : never);
}

bool Printer::restless_parts() const {
    return board.print.state() != PrintState::idle || board.lamp.on();
}

/// Without the supply all is off; else lamp and panel stay as they are, and the motor stands.
void Printer::hang_parts(bool powered) {
    powered ? board.platform.stop(now()) : board.cut_power(now());
}

void Printer::all_off(bool /*had_job*/) {
    board.print.stop(now());
    board.platform.stop(now());
    board.lamp.off(now());
}

void Printer::insert_card(int disk) {
    Machine::insert_card(disk);
    board.stick_changed();
}

void Printer::remove_card(int disk) {
    Machine::remove_card(disk);
    board.stick_changed();
}

bool Printer::list(const std::string& folder, std::vector<StickEntry>& out) const {
    const Volume* const stick = volume();
    std::vector<CardEntry> entries;
    const std::string path = folder.substr(0, folder.empty() ? 0 : folder.size() - 1);
    if (stick == nullptr || read_errors || !stick->list(path, entries)) {
        return false;
    }
    // A folder of a computer has no order of its own.
    std::sort(entries.begin(), entries.end(),
              [](const CardEntry& a, const CardEntry& b) { return a.name < b.name; });
    for (CardEntry& entry : entries) {
        out.push_back({std::move(entry.name), entry.folder, entry.bytes, entry.modified_s});
    }
    return true;
}

std::optional<StickEntry> Printer::look(const std::string& path) const {
    const Volume* const stick = volume();
    std::uint64_t bytes = 0;
    if (stick == nullptr || stick->look(path, bytes) != Volume::Kind::file) {
        return std::nullopt;
    }
    return StickEntry{path, false, bytes, 0};
}

std::unique_ptr<sliced::ByteSource> Printer::open(const std::string& path) const {
    return look(path) ? std::make_unique<StickSource>(*volume(), path, read_errors) : nullptr;
}

bool Printer::remove(const std::string& path) {
    Volume* const stick = storage.writable(disk());
    return stick != nullptr && stick->remove(path);
}

void Printer::raise(Event event) {
    events.raise(&own_events[static_cast<std::size_t>(event)]);
}

}  // namespace fauxboard::dlp
