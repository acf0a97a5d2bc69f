#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/machine/storage.h"
#include "tests/touch/bench.h"

namespace fauxboard::testing {

/// A stick in memory that lists its entries in the order in which they were put there, folders among files.
class OrderedStick final : public machine::Volume {
  public:
    struct Entry {
        std::string path;  ///< a folder's ends with '/'
        std::string bytes;
        std::int64_t modified_s = 0;
    };

    bool list(std::string_view folder, std::vector<machine::CardEntry>& out) const override;
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;
    bool remove(std::string_view path) override;

    std::vector<Entry> entries;

  private:
    const Entry* find(std::string_view path) const;
};

/// The cells of an EEPROM in memory.
class KeptCells final : public machine::EepromCells {
  public:
    std::optional<std::string> load() override { return bytes; }
    void store(std::size_t address, std::string_view data) override;
    std::optional<std::string> bytes;
};

struct MksWorld {
    OrderedStick stick;
    KeptCells cells;
};

/// The shipped MKS DLP board with its shipped screen, the stick in, its clock at 17 Sep 2020 10:58.
class MksBench : public MksWorld, public TouchBench {
  public:
    explicit MksBench(MksWorld world = {}, std::string_view profile = "mks-dlp");

    /// Cuts the power and gives it back; on to the main page.
    void power_cycle();
    void run_to_main() { run_for(10); }
    /// Does an action of the machine.
    void act(const std::string& json);
    /// The file is put on the stick and opened, from the main page.
    void open(const std::string& name);
    /// "OK" to all questions until it prints.
    void print(const std::string& name);
    /// Of the control called so.
    bool enabled(std::string_view control);
    std::string title() { return scene().title; }
    std::string label(std::string_view control);
    /// The box's text, its lines joined by a blank; "" without a box.
    std::string box_text();
    /// What is drawn in that colour at that place; nothing when nothing is.
    std::optional<screen::Rect> drawn(screen::Color color, int x, int y);
};

/// The file that the checks speak of: 100 layers of 0.05 mm, 7 s, bottom 40 s x 5.
std::string file_s1(std::uint32_t layers = 100);
/// The same with so many layers that are all one picture: small, however many.
std::string tall_file(std::uint32_t layers);

}  // namespace fauxboard::testing
