#include "tests/support/dlp_bench.h"

#include <algorithm>

#include "tests/support/marked_file.h"

namespace fauxboard::testing {
namespace {

class StickSource final : public sliced::ByteSource {
  public:
    StickSource(const MemoryStick& stick, std::string path) : stick_(stick), path_(std::move(path)) {}
    std::uint64_t size() const override { return text() == nullptr ? 0 : text()->size(); }
    std::size_t read(std::uint64_t offset, std::span<char> out) const override {
        const std::string* const bytes = text();
        if (bytes == nullptr || stick_.read_errors || offset >= bytes->size()) {
            return 0;
        }
        return bytes->copy(out.data(), out.size(), static_cast<std::size_t>(offset));
    }

  private:
    const std::string* text() const {
        for (const auto& [name, bytes] : stick_.files) {
            if (name == path_ && stick_.in) {
                return &bytes;
            }
        }
        return nullptr;
    }
    const MemoryStick& stick_;
    std::string path_;
};

/// A rectangle of light, a little further right and down with each layer, smaller with each level.
struct Rectangle {
    std::uint32_t left, right, top, bottom;
};
Rectangle rectangle(std::uint32_t n, std::uint32_t level) {
    return {200 + n + 3 * level, 1200 - level, 300 + n % 50 + 2 * level, 2000};
}

void add_runs(std::string& data, bool lit, std::uint64_t pixels) {
    constexpr std::uint64_t longest = 125;
    while (pixels > 0) {
        const std::uint64_t run = std::min(pixels, longest);
        data += static_cast<char>((lit ? 0x80U : 0U) | static_cast<unsigned>(run));
        pixels -= run;
    }
}

std::string encode(std::uint32_t n, std::uint32_t level) {
    const Rectangle r = rectangle(n, level);
    std::string data;
    std::uint64_t dark = std::uint64_t{r.top} * dlp::panel_columns + r.left;
    for (std::uint32_t y = r.top; y < r.bottom; ++y) {
        add_runs(data, false, dark);
        add_runs(data, true, r.right - r.left);
        dark = dlp::panel_columns - r.right + r.left;
    }
    const std::uint64_t last = std::uint64_t{r.bottom - 1} * dlp::panel_columns + r.right;
    add_runs(data, false, std::uint64_t{dlp::panel_columns} * dlp::panel_lines - last);
    return data;
}

}  // namespace

bool MemoryStick::list(const std::string& folder, std::vector<dlp::StickEntry>& out) const {
    bool found = folder.empty();
    for (const auto& [name, bytes] : files) {
        found = found || name.starts_with(folder);
        if (!name.starts_with(folder) || name.size() == folder.size()) {
            continue;
        }
        const std::string rest = name.substr(folder.size());
        const std::size_t slash = rest.find('/');
        if (slash == std::string::npos) {
            out.push_back({rest, false, bytes.size(), modified_s});
        } else if (slash + 1 == rest.size()) {
            out.push_back({rest.substr(0, slash), true, 0, modified_s});
        }
    }
    return found && in;
}

std::optional<dlp::StickEntry> MemoryStick::look(const std::string& path) const {
    for (const auto& [name, bytes] : files) {
        if (name == path && in) {
            return dlp::StickEntry{name, false, bytes.size(), modified_s};
        }
    }
    return std::nullopt;
}

std::unique_ptr<sliced::ByteSource> MemoryStick::open(const std::string& path) const {
    return look(path) ? std::make_unique<StickSource>(*this, path) : nullptr;
}

bool MemoryStick::remove(const std::string& path) {
    return in && std::erase_if(files, [&](const auto& file) { return file.first == path; }) != 0;
}

void MemoryCells::store(std::size_t address, std::string_view data) {
    if (!bytes) {
        bytes.emplace(dlp::eeprom_bytes, '\xFF');
    }
    bytes->replace(address, data.size(), data);
    writes += data.size();
}

bool panel_pws_lit(std::uint32_t n, std::uint32_t level, std::uint32_t x, std::uint32_t y) {
    const Rectangle r = rectangle(n, level);
    return x >= r.left && x < r.right && y >= r.top && y < r.bottom;
}

std::string make_panel_pws(const PanelPws& wishes) {
    // A small file of the same form, whose pictures are then the panel's.
    ResinFile form;
    form.layers = wishes.layers;
    form.level_sets = wishes.antialiasing;
    form.width = dlp::panel_columns;
    form.height = 1;
    form.picture = [](std::uint32_t, std::uint32_t, std::uint32_t) { return std::uint8_t{0}; };
    form.bottom_layers = wishes.bottom_layers;
    form.layer_height_mm = wishes.layer_mm;
    form.exposure_s = wishes.exposure_s;
    form.bottom_exposure_s = wishes.bottom_exposure_s;
    form.light_off_s = wishes.light_off_s;
    form.lift_mm = wishes.lift_mm;
    form.lift_mm_min = wishes.lift_mm_s * 60;
    form.retract_mm_min = wishes.drop_mm_s * 60;
    MadePws made = make_pws(form);
    made.bytes.resize(made.data_begins[0]);
    poke(made.bytes, made.info + 64, dlp::panel_lines);
    for (std::uint32_t n = 0; n < wishes.layers; ++n) {
        std::string data;
        for (std::uint32_t level = 0; level < wishes.antialiasing; ++level) {
            data += encode(n, level);
        }
        poke(made.bytes, made.table + 20 + 32 * n, static_cast<std::uint32_t>(made.bytes.size()));
        poke(made.bytes, made.table + 24 + 32 * n, static_cast<std::uint32_t>(data.size()));
        made.bytes += data;
    }
    return made.bytes;
}

DlpBench::DlpBench(dlp::BoardConfig config, MemoryStick made)
    : stick(std::move(made)), board(config, stick, &cells, 1, *this) {
    board.power_on(now);
}

void DlpBench::raise(dlp::Event event) {
    raised.push_back({event, now});
    if (each_event) {
        each_event(event);
    }
}

void DlpBench::run_until(dlp::SimTime time) {
    while (board.next_event() <= time) {
        now = board.next_event();
        board.advance(now);
        if (each_step) {
            each_step();
        }
    }
    now = time;
    board.advance(now);
}

bool DlpBench::run_to(dlp::Event event, double within_s) {
    const dlp::SimTime end = now + dlp::from_seconds(within_s);
    const std::size_t before = count(event);
    while (count(event) == before) {
        const dlp::SimTime next = board.next_event();
        if (next > end) {
            run_until(end);
            return false;
        }
        run_until(next);
    }
    return true;
}

std::size_t DlpBench::count(dlp::Event event) const {
    return static_cast<std::size_t>(std::count_if(raised.begin(), raised.end(),
                                                  [event](const Raised& one) { return one.event == event; }));
}

}  // namespace fauxboard::testing
