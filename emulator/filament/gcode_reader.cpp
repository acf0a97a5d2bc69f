#include "emulator/filament/gcode_reader.h"
#include "emulator/filament/names.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace fauxboard::filament {

void GcodeReader::open(const Volume& volume, std::string path, std::uint64_t from) {
    volume_ = &volume;
    path_ = std::move(path);
    buffer_.resize(piece_bytes);
    // From the byte before: if it is a line's end, the place is the beginning of a line.
    from_ = from;
    base_ = from == 0 ? 0 : from - 1;
    at_ = size_ = 0;
    at_end_ = false;
    skipping_ = from != 0;
    lines_cut_ = 0;
}

void GcodeReader::close() {
    *this = GcodeReader{};
}

/// Moves what is left to the front and reads behind it. False when the disk fails.
bool GcodeReader::fill() {
    std::memmove(buffer_.data(), buffer_.data() + at_, size_ - at_);
    base_ += at_;
    size_ -= at_;
    at_ = 0;
    const auto got = volume_->read(path_, base_ + size_, std::span<char>(buffer_).subspan(size_));
    if (!got) {
        return false;
    }
    at_end_ = *got == 0;
    size_ += std::min(*got, buffer_.size() - size_);
    return true;
}

/// Gives `size` bytes as the line and goes on behind its `ending`.
GcodeReader::Result GcodeReader::take(std::size_t size, std::size_t ending, std::string_view& line) {
    line = {buffer_.data() + at_, std::min(size, max_line_bytes)};
    lines_cut_ += size > max_line_bytes ? 1 : 0;
    at_ += size + ending;
    return Result::line;
}

GcodeReader::Result GcodeReader::next(std::string_view& line) {
    if (volume_ == nullptr) {
        return Result::end;
    }
    const std::uint64_t enough = base_ + at_ + passed_over_at_once;
    while (true) {
        const char* const start = buffer_.data() + at_;
        const std::size_t left = size_ - at_;
        const auto* const feed =
            left == 0 ? nullptr : static_cast<const char*>(std::memchr(start, '\n', left));
        const std::size_t size = feed == nullptr ? left : static_cast<std::size_t>(feed - start);
        const auto* const cr = size == 0 ? nullptr : static_cast<const char*>(std::memchr(start, '\r', size));
        // A CR that ends what was read may be half of a CR LF: more is read first.
        const bool whole = feed != nullptr || (cr != nullptr && cr + 1 != start + left);
        if (whole || (at_end_ && left != 0)) {
            std::size_t length = size;
            std::size_t ending = feed != nullptr ? 1 : 0;
            if (cr != nullptr) {
                length = static_cast<std::size_t>(cr - start);
                ending = cr + 1 == feed ? 2 : 1;
            }
            if (!std::exchange(skipping_, false)) {
                return take(length, ending, line);
            }
            at_ += length + ending;
            continue;
        }
        if (at_end_) {
            return Result::end;
        }
        if (left == buffer_.size()) {
            // A line longer than a piece: its beginning is given once, the rest is passed over.
            if (!std::exchange(skipping_, true)) {
                return take(left, 0, line);
            }
            at_ = size_;
            if (base_ + at_ >= enough) {
                return Result::passing_over;
            }
        }
        if (!fill()) {
            return Result::failed;
        }
    }
}

}  // namespace fauxboard::filament
