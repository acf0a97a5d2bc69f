#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "emulator/machine/storage.h"
#include "tests/support/slicer_text.h"

namespace fauxboard::testing {

/// How a made-up sliced file is to be.
struct SlicedFile {
    using Slicer = testing::Slicer;
    /// What its layers are made of.
    enum class Shape : std::uint8_t {
        infill,  ///< long straight lines to and fro
        curves,  ///< a wavy outline of segments of half a millimetre
        towers,  ///< many small circles, with retraction and a hop between them
    };
    Slicer slicer = Slicer::cura;
    Shape shape = Shape::infill;
    int moves = 60'000;  ///< G0 and G1 within the layers, about
    int layers = 200;
    std::uint64_t seed = 1;
    bool heating = false;  ///< M190 and M109 before, M104 S0 and M140 S0 after
    bool homing = false;   ///< G28 before
    bool whole = false;    ///< with all that the slicer writes around the moves
};

/// The file's text: the same for the same wishes.
std::string make_sliced_file(const SlicedFile& wishes);

/// A disk whose files are in memory, or made while they are read.
class MemoryDisk final : public machine::Volume {
  public:
    /// Fills `out` with the bytes from `offset` on.
    using Maker = std::function<void(std::uint64_t offset, std::span<char> out)>;

    void put(const std::string& path, std::string content) { files_[path] = std::move(content); }
    void put(const std::string& path, std::uint64_t bytes, Maker maker) {
        made_[path] = {bytes, std::move(maker)};
    }
    void set_failing(bool failing) { failing_ = failing; }
    /// Writing works as long as all files that were put have no more bytes than this together.
    void set_room(std::uint64_t bytes) { room_ = bytes; }
    /// What stands in a file that was put or written; null when there is none.
    const std::string* content(std::string_view path) const {
        const auto found = files_.find(path);
        return found == files_.end() ? nullptr : &found->second;
    }
    mutable std::uint64_t bytes_read = 0;

    bool list(std::string_view folder, std::vector<machine::CardEntry>& out) const override;
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;
    bool create(std::string_view path) override;
    bool append(std::string_view path, std::uint64_t offset, std::string_view bytes) override;
    bool rename(std::string_view from, std::string_view to) override;
    bool remove(std::string_view path) override;  ///< always, for tests that take a file away

  private:
    std::uint64_t used() const;
    struct Made {
        std::uint64_t bytes = 0;
        Maker maker;
    };
    std::map<std::string, std::string, std::less<>> files_;
    std::map<std::string, Made, std::less<>> made_;
    bool failing_ = false;
    std::uint64_t room_ = 0;  ///< write-protected unless told otherwise
};

}  // namespace fauxboard::testing
