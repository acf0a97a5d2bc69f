#pragma once

// The MKS DLP board on a bench: a stick in memory, EEPROM cells in memory, and everything it raised.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emulator/dlp/mks_board.h"

namespace fauxboard::testing {

/// A stick in memory. Names with '/' are in folders.
class MemoryStick final : public dlp::Stick {
  public:
    bool present() const override { return in; }
    bool list(const std::string& folder, std::vector<dlp::StickEntry>& out) const override;
    std::optional<dlp::StickEntry> look(const std::string& path) const override;
    std::unique_ptr<sliced::ByteSource> open(const std::string& path) const override;
    bool remove(const std::string& path) override;

    /// In the order of the folder's entries; a folder is a name that ends with '/'.
    std::vector<std::pair<std::string, std::string>> files;
    std::int64_t modified_s = 1'599'620'160;  ///< 9 Sep 2020, 02:56
    bool in = true;
    bool read_errors = false;
};

/// EEPROM cells in memory; counts what is written.
class MemoryCells final : public machine::EepromCells {
  public:
    std::optional<std::string> load() override { return bytes; }
    void store(std::size_t address, std::string_view data) override;
    std::optional<std::string> bytes;
    std::size_t writes = 0;
};

/// How a made-up print is to be: rectangles of light, of the panel's size, as a .pws.
struct PanelPws {
    std::uint32_t layers = 100;
    float layer_mm = 0.05F;
    float exposure_s = 7;
    float bottom_exposure_s = 40;
    std::uint32_t bottom_layers = 5;
    float light_off_s = 0.5F;
    float lift_mm = 5;
    float lift_mm_s = 2;
    float drop_mm_s = 4;
    std::uint32_t antialiasing = 1;
};
std::string make_panel_pws(const PanelPws& wishes);
/// Whether picture `level` of layer `n` (from 0) has the pixel lit.
bool panel_pws_lit(std::uint32_t n, std::uint32_t level, std::uint32_t x, std::uint32_t y);

/// The board itself, in virtual time.
class DlpBench : private dlp::Listener {
  public:
    struct Raised {
        dlp::Event event;
        dlp::SimTime time;
    };

    explicit DlpBench(dlp::BoardConfig config = {}, MemoryStick files = {});

    /// On to `now`, from event to event; `each` sees every moment at which something happens.
    void run_until(dlp::SimTime time);
    void run(double seconds) { run_until(now + dlp::from_seconds(seconds)); }
    /// Until `event` comes, at most so long. False when it does not.
    bool run_to(dlp::Event event, double within_s = 100'000);
    std::size_t count(dlp::Event event) const;

    MemoryStick stick;
    MemoryCells cells;
    std::vector<Raised> raised;
    std::vector<std::string> notes;
    std::function<void(dlp::Event event)> each_event;
    std::function<void()> each_step;
    dlp::SimTime now{0};
    dlp::MksBoard board;

  private:
    void raise(dlp::Event event) override;
    void note(const std::string& text) override { notes.push_back(text); }
};

}  // namespace fauxboard::testing
