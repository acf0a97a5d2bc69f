#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>

#include "emulator/dlp/eeprom_layout.h"
#include "emulator/dlp/time.h"
#include "emulator/machine/services.h"

namespace fauxboard::dlp {

/// The chip on its bus: a byte takes 10 ms to write, and a power cut leaves those behind it as they were.
class EepromChip {
  public:
    static constexpr SimTime byte_time = ms(10);

    /// `cells` may be null: then the chip forgets with the program.
    explicit EepromChip(machine::EepromCells* cells) : cells_(cells) {
        bytes_.fill(0xFF);
        if (cells != nullptr) {
            const auto kept = cells->load();
            if (kept && kept->size() == bytes_.size()) {
                std::copy(kept->begin(), kept->end(), bytes_.begin());
            }
        }
    }

    const EepromBytes& bytes() const { return bytes_; }
    /// Writes behind what is being written already.
    void write(std::uint16_t address, std::span<const std::uint8_t> bytes, SimTime now) {
        if (pending_.empty()) {
            next_due_ = now + byte_time;
            queued_ = 0;
        }
        queued_ += bytes.size();
        for (const std::uint8_t byte : bytes) {
            pending_.emplace_back(address++, byte);
        }
    }
    bool writing() const { return !pending_.empty(); }
    /// When so much (0 to 1) of what is being written is written.
    SimTime when(double share) const {
        const auto bytes = static_cast<std::int64_t>(share * static_cast<double>(queued_));
        const auto done = static_cast<std::int64_t>(queued_ - pending_.size());
        return writing() ? next_due_ + byte_time * (bytes - done - 1) : never;
    }
    /// When all is written.
    SimTime next_event() const {
        return writing() ? next_due_ + byte_time * static_cast<std::int64_t>(pending_.size() - 1) : never;
    }
    void advance(SimTime now) {
        while (writing() && next_due_ <= now) {
            const auto [address, byte] = pending_.front();
            pending_.pop_front();
            next_due_ += byte_time;
            bytes_[address % eeprom_bytes] = byte;
            if (cells_ != nullptr) {
                const char cell = static_cast<char>(byte);
                cells_->store(address, {&cell, 1});
            }
        }
    }
    /// The byte under way and those behind it never come.
    void cut() { pending_.clear(); }

  private:
    machine::EepromCells* cells_;
    EepromBytes bytes_{};
    std::deque<std::pair<std::uint16_t, std::uint8_t>> pending_;
    std::size_t queued_ = 0;  ///< bytes of the writing under way, written ones included
    SimTime next_due_{0};
};

}  // namespace fauxboard::dlp
