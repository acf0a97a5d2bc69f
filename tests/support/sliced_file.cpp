#include "tests/support/sliced_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>

namespace fauxboard::testing {
namespace {

using Shape = SlicedFile::Shape;

/// Writes as slicers do: what did not change is left out, E is absolute and starts anew each layer.
class Writer {
  public:
    explicit Writer(const SlicedFile& wishes) : wishes_(wishes), state_(wishes.seed) {}

    std::string write() {
        begin();
        const int per_layer = std::max(wishes_.moves / std::max(wishes_.layers, 1), 1);
        for (layer_ = 0; layer_ < wishes_.layers; ++layer_) {
            begin_layer();
            const std::size_t enough = moves_ + static_cast<std::size_t>(per_layer);
            while (moves_ < enough) {
                fill(enough);
            }
        }
        finish();
        return std::move(text_);
    }

  private:
    double random(double from, double to) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return from + (to - from) * (static_cast<double>(state_ >> 11U) * 0x1.0p-53);
    }

    [[gnu::format(printf, 2, 3)]] void line(const char* format, ...) {
        std::array<char, 200> buffer;
        va_list args;
        va_start(args, format);
        const int size = std::vsnprintf(buffer.data(), buffer.size(), format, args);
        va_end(args);
        text_.append(buffer.data(), static_cast<std::size_t>(size));
        text_ += '\n';
    }

    void begin() {
        text_ += slicer_head(wishes_.slicer, facts_);
        if (wishes_.heating) {
            line("M190 S50");
            line("M109 S200");
        }
        if (wishes_.homing) {
            line("G28 ;home");
        }
        line("G21");
        line("G90");
        line("M82");
        line("M107");
    }

    void begin_layer() {
        const double z = 0.2 * (layer_ + 1);
        text_ += slicer_layer(wishes_.slicer, facts_, layer_, z);
        line("G92 E0");
        e_ = 0;
        line("G1 Z%.3f F1200", z);
        ++moves_;
        if (layer_ == 2) {
            line("M106 S255");
        }
        line("M117 Layer %d", layer_ + 1);
    }

    void travel(double x, double y) {
        line("G0 F7200 X%.3f Y%.3f", x, y);
        x_ = x;
        y_ = y;
        ++moves_;
    }

    void draw(double x, double y, double feed) {
        e_ += std::hypot(x - x_, y - y_) * 0.033;
        if (feed != feed_) {
            line("G1 F%.0f X%.3f Y%.3f E%.5f", feed, x, y, e_);
        } else {
            line("G1 X%.3f Y%.3f E%.5f", x, y, e_);
        }
        feed_ = feed;
        x_ = x;
        y_ = y;
        ++moves_;
    }

    void fill(std::size_t enough) {
        switch (wishes_.shape) {
            case Shape::infill:
                return infill(enough);
            case Shape::curves:
                return curves(enough);
            case Shape::towers:
                return towers(enough);
        }
    }

    void infill(std::size_t enough) {
        const double length = random(40, 110);
        const double x = random(60, 100);
        double y = random(60, 80);
        travel(x, y);
        feed_ = 0;
        for (int i = 0; i < 60 && moves_ < enough; ++i, y += 0.4) {
            draw(i % 2 == 0 ? x + length : x, y, 3600);
            draw(x_, y + 0.4, 3600);
        }
    }

    void curves(std::size_t enough) {
        const double radius = random(25, 45);
        const double waves = std::floor(random(5, 12));
        const auto at = [&](int i) {
            const double angle = 2 * std::numbers::pi * i / 400;
            const double r = radius + 4 * std::sin(waves * angle);
            return std::pair(160 + r * std::cos(angle), 160 + r * std::sin(angle));
        };
        travel(at(0).first, at(0).second);
        feed_ = 0;
        for (int i = 1; i <= 400 && moves_ < enough; ++i) {
            draw(at(i).first, at(i).second, random(0, 1) < 0.02 ? 2400 : 3000);
        }
    }

    void towers(std::size_t enough) {
        const double x = random(60, 260);
        const double y = random(60, 260);
        const double z = 0.2 * (layer_ + 1);
        line("G1 F1500 E%.5f", e_ - 2);
        line("G1 Z%.3f F1200", z + 0.4);
        travel(x + 3, y);
        line("G1 Z%.3f F1200", z);
        line("G1 F1500 E%.5f", e_);
        moves_ += 4;
        feed_ = 0;
        for (int i = 1; i <= 24 && moves_ < enough; ++i) {
            const double angle = 2 * std::numbers::pi * i / 24;
            draw(x + 3 * std::cos(angle), y + 3 * std::sin(angle), 1800);
        }
    }

    void finish() {
        line("M107");
        if (wishes_.heating) {
            line("M104 S0");
            line("M140 S0");
        }
        line("G91");
        line("G1 Z5 F1200");
        line("G90");
        line("M84");
        text_ += slicer_foot(wishes_.slicer, facts_);
    }

    const SlicedFile& wishes_;
    const SlicerFacts facts_{wishes_.layers, std::max(wishes_.moves / 600, 1), wishes_.whole};
    std::uint64_t state_;
    std::string text_;
    std::size_t moves_ = 0;
    int layer_ = 0;
    double x_ = 0, y_ = 0, e_ = 0, feed_ = 0;
};

}  // namespace

std::string make_sliced_file(const SlicedFile& wishes) {
    return Writer(wishes).write();
}

bool MemoryDisk::list(std::string_view folder, std::vector<machine::CardEntry>& out) const {
    if (!folder.empty()) {
        return false;
    }
    for (const auto& [name, content] : files_) {
        out.push_back({name, false, content.size()});
    }
    for (const auto& [name, made] : made_) {
        out.push_back({name, false, made.bytes});
    }
    return true;
}

machine::Volume::Kind MemoryDisk::look(std::string_view path, std::uint64_t& bytes) const {
    if (const auto file = files_.find(path); file != files_.end()) {
        bytes = file->second.size();
        return Kind::file;
    }
    if (const auto made = made_.find(path); made != made_.end()) {
        bytes = made->second.bytes;
        return Kind::file;
    }
    const std::string below = std::string(path) + "/";
    const auto inner = files_.lower_bound(below);
    const bool folder = path.empty() || (inner != files_.end() && inner->first.starts_with(below));
    return folder ? Kind::folder : Kind::missing;
}

std::optional<std::size_t> MemoryDisk::read(std::string_view path, std::uint64_t offset,
                                            std::span<char> out) const {
    std::uint64_t bytes = 0;
    if (failing_ || look(path, bytes) != Kind::file) {
        return std::nullopt;
    }
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), offset < bytes ? bytes - offset : 0));
    if (const auto file = files_.find(path); file != files_.end()) {
        file->second.copy(out.data(), count, std::min<std::size_t>(offset, file->second.size()));
    } else if (count != 0) {
        made_.find(path)->second.maker(offset, out.first(count));
    }
    bytes_read += count;
    return count;
}

std::uint64_t MemoryDisk::used() const {
    std::uint64_t bytes = 0;
    for (const auto& [name, content] : files_) {
        bytes += content.size();
    }
    return bytes;
}

bool MemoryDisk::create(std::string_view path) {
    if (failing_ || room_ == 0) {
        return false;
    }
    files_[std::string(path)].clear();
    return true;
}

bool MemoryDisk::append(std::string_view path, std::uint64_t offset, std::string_view bytes) {
    const auto file = files_.find(path);
    if (failing_ || file == files_.end() || file->second.size() != offset || used() + bytes.size() > room_) {
        return false;
    }
    file->second += bytes;
    return true;
}

bool MemoryDisk::rename(std::string_view from, std::string_view to) {
    const auto file = files_.find(from);
    if (failing_ || room_ == 0 || file == files_.end()) {
        return false;
    }
    std::string content = std::move(file->second);
    files_.erase(file);
    files_[std::string(to)] = std::move(content);
    return true;
}

bool MemoryDisk::remove(std::string_view path) {
    const std::string name(path);
    return files_.erase(name) + made_.erase(name) != 0;
}

}  // namespace fauxboard::testing
