#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/filament/names.h"

namespace fauxboard::filament {

/// Streams the lines of a file on a disk, a fixed piece at a time: how long the file is makes no difference
/// to memory, nor to how soon the first line is there.
class GcodeReader {
  public:
    /// Read from the disk at a time. A real board reads sectors of 512 bytes; ours costs a look-up each time.
    static constexpr std::size_t piece_bytes = 16 * 1024;
    /// The rest of a longer line is passed over, as a real board does (which has room for 96 bytes).
    static constexpr std::size_t max_line_bytes = 1024;
    /// So much of it is passed over in one call.
    static constexpr std::uint64_t passed_over_at_once = piece_bytes;

    enum class Result : std::uint8_t {
        line,
        passing_over,  ///< within a line that is far too long; there may be more of it: go on later
        end,           ///< nothing behind the last line
        failed,        ///< the file is gone or cannot be read (any more); trying again later is allowed
    };

    /// Begins at byte `from`; in the middle of a line, behind that line. `volume` is used until close().
    void open(const Volume& volume, std::string path, std::uint64_t from = 0);
    void close();
    bool is_open() const { return volume_ != nullptr; }

    /// The next line, without its end (CR, LF or both). It is good until the next call. What one call reads
    /// is bounded, however long a line of the file may be.
    Result next(std::string_view& line);

    /// Where the line after the last one begins; before the first one, where it was opened.
    std::uint64_t byte() const { return std::max(from_, base_ + at_); }
    std::uint64_t lines_cut() const { return lines_cut_; }

  private:
    bool fill();
    Result take(std::size_t size, std::size_t ending, std::string_view& line);

    const Volume* volume_ = nullptr;
    std::string path_;
    std::vector<char> buffer_;
    std::uint64_t from_ = 0;
    std::uint64_t base_ = 0;  ///< of the buffer's first byte
    std::size_t at_ = 0;      ///< of the next line in the buffer
    std::size_t size_ = 0;    ///< bytes in the buffer
    bool at_end_ = false;     ///< nothing in the file behind the buffer
    bool skipping_ = false;   ///< in a line of which enough was given, or none is wanted
    std::uint64_t lines_cut_ = 0;
};

}  // namespace fauxboard::filament
