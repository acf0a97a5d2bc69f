#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/fault/dice.h"
#include "emulator/machine/services.h"

namespace fauxboard::world {

/// An EEPROM in memory that may refuse to be written. What it acknowledged is there after any power cut.
class Eeprom final : public machine::EepromStore {
  public:
    std::optional<std::string> load() override { return kept_; }
    bool save(std::string_view image) override {
        if (!fails) {
            kept_ = image;
        }
        refused_ = refused_ || fails;
        return !fails;
    }
    void power_on() { refused_ = false; }
    /// Something was not saved since the board was switched on.
    bool refused() const { return refused_; }
    const std::optional<std::string>& kept() const { return kept_; }
    bool fails = false;

  private:
    std::optional<std::string> kept_;
    bool refused_ = false;
};

/// The cells of an EEPROM chip in memory: each is written when it is told.
class EepromCells final : public machine::EepromCells {
  public:
    explicit EepromCells(std::size_t size) : bytes_(size, '\xFF') {}
    std::optional<std::string> load() override { return bytes_; }
    void store(std::size_t address, std::string_view bytes) override {
        bytes_.replace(std::min(address, bytes_.size()), bytes.size(), bytes);
    }

  private:
    std::string bytes_;
};

/// The place of a job in memory, with the last ones that were kept. At a power cut the newest may not have
/// got there; the one before it has, as host::JobPlaceFile promises.
class JobPlace final : public machine::JobPlaceStore {
  public:
    std::optional<std::string> load() override { return now_; }
    void keep(std::string_view place) override {
        put(std::string(place));
        if (on_keep) {
            on_keep();
        }
    }
    void drop() override { put(std::nullopt); }

    void power_cut(fault::Dice& dice) {
        if (dice.below(3) == 0) {
            now_ = before_;
        }
        before_ = now_;
    }
    std::function<void()> on_keep;  ///< a board may reach many places between two moments that are looked at

  private:
    void put(std::optional<std::string> place) {
        before_ = std::move(now_);
        now_ = std::move(place);
    }
    std::optional<std::string> now_;
    std::optional<std::string> before_;
};

}  // namespace fauxboard::world
