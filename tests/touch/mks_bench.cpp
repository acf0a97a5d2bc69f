#include "tests/touch/mks_bench.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "emulator/behaviour/rule_compiler.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "tests/support/board_driver.h"
#include "tests/support/dlp_bench.h"

namespace fauxboard::testing {
namespace {

machine::Services services_of(MksWorld& world) {
    machine::Services out;
    out.udisk = &world.stick;
    out.eeprom_cells = &world.cells;
    return out;
}

}  // namespace

const OrderedStick::Entry* OrderedStick::find(std::string_view path) const {
    const auto hit = std::find_if(entries.begin(), entries.end(), [&](const Entry& one) {
        return one.path == path || one.path == std::string(path) + "/";
    });
    return hit == entries.end() ? nullptr : &*hit;
}

bool OrderedStick::list(std::string_view folder, std::vector<machine::CardEntry>& out) const {
    const std::string above = folder.empty() ? "" : std::string(folder) + "/";
    if (!above.empty() && find(folder) == nullptr) {
        return false;
    }
    for (const Entry& one : entries) {
        std::string name = one.path;
        if (!name.starts_with(above) || name == above) continue;
        name.erase(0, above.size());
        const bool is_folder = name.ends_with('/');
        if (is_folder) name.pop_back();
        if (name.find('/') != std::string::npos) continue;
        out.push_back({name, is_folder, one.bytes.size(), 0, {}, one.modified_s});
    }
    return true;
}

machine::Volume::Kind OrderedStick::look(std::string_view path, std::uint64_t& bytes) const {
    const Entry* one = find(path);
    if (one == nullptr) {
        return path.empty() ? Kind::folder : Kind::missing;
    }
    bytes = one->bytes.size();
    return one->path.ends_with('/') ? Kind::folder : Kind::file;
}

std::optional<std::size_t> OrderedStick::read(std::string_view path, std::uint64_t offset,
                                              std::span<char> out) const {
    const Entry* one = find(path);
    if (one == nullptr) {
        return std::nullopt;
    }
    if (offset >= one->bytes.size()) {
        return 0;
    }
    const std::size_t size = std::min<std::size_t>(out.size(), one->bytes.size() - offset);
    std::memcpy(out.data(), one->bytes.data() + offset, size);
    return size;
}

bool OrderedStick::remove(std::string_view path) {
    return std::erase_if(entries, [&](const Entry& one) { return one.path == path; }) != 0;
}

void KeptCells::store(std::size_t address, std::string_view data) {
    if (!bytes) bytes.emplace(2048, '\xFF');
    bytes->replace(address, data.size(), data);
}

MksBench::MksBench(MksWorld world, std::string_view profile)
    : MksWorld(std::move(world)),
      TouchBench(host::load_profile_by_name(profile),
                 host::load_own_screen(host::load_profile_by_name(profile)->screen), services_of(*this)) {
    act(R"({"clock.set": {"year": 2020, "month": 9, "day": 17, "hour": 10, "minute": 58}})");
}

void MksBench::power_cycle() {
    run_for(1);  // the EEPROM is written
    board.power_on(now);
    run_to_main();
}

void MksBench::act(const std::string& json) {
    const behaviour::Document document = behaviour::parse_document({"act.json", json});
    behaviour::Findings findings{document, {}};
    const std::map<std::string, std::size_t, std::less<>> frames;
    behaviour::RuleCompiler compiler(findings, {}, frames, *board.profile().machine);
    const auto calls = compiler.actions(document.root, "");
    REQUIRE(findings.problems.empty());
    for (const behaviour::ActionCall& call : calls) {
        REQUIRE(board.act(now, call) == "");
    }
}

void MksBench::open(const std::string& name) {
    REQUIRE(tap("Files") == "");
    REQUIRE(tap("Tile 1") == "");
    REQUIRE(title() == "FILE VIEW");
    REQUIRE(text_field("view.name") == name);
}

void MksBench::print(const std::string& name) {
    open(name);
    REQUIRE(tap("Print") == "");
    REQUIRE(box_text() ==
            "Make sure there is no printed model or debris left on the platform or in the vat.");
    REQUIRE(tap("OK") == "");
}

bool MksBench::enabled(std::string_view control) {
    const screen::Scene here = scene();
    const screen::SceneControl* found = here.find(control);
    REQUIRE(found != nullptr);
    return found->enabled;
}

std::string MksBench::label(std::string_view control) {
    const screen::Scene here = scene();
    const screen::SceneControl* found = here.find(control);
    REQUIRE(found != nullptr);
    return found->label;
}

std::string MksBench::box_text() {
    const screen::Scene here = scene();
    std::string out;
    for (const std::string& line : here.box ? here.box->lines : std::vector<std::string>{}) {
        out += (out.empty() ? "" : " ") + line;
    }
    return out;
}

std::optional<screen::Rect> MksBench::drawn(screen::Color color, int x, int y) {
    for (const screen::SceneItem& item : scene().items) {
        if (item.color == color && item.at.x == x && item.at.y == y) return item.at;
    }
    return std::nullopt;
}

std::string file_s1(std::uint32_t layers) {
    PanelPws wishes;
    wishes.layers = layers;
    std::string bytes = make_panel_pws(wishes);
    // The resin stands 52 bytes behind the mark of the header.
    const float resin_ml = 12.34F;
    std::memcpy(bytes.data() + bytes.find("HEADER") + 52, &resin_ml, sizeof resin_ml);
    return bytes;
}

std::string tall_file(std::uint32_t layers) {
    std::string bytes = file_s1(1);
    const std::size_t table = bytes.find("LAYERDEF");
    const auto put = [](std::string& to, std::size_t at, std::uint32_t value) {
        std::memcpy(to.data() + at, &value, sizeof value);
    };
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + table + 12, sizeof length);
    std::string longer = bytes.substr(table, 20);
    const std::string record = bytes.substr(table + 20, 32);
    put(longer, 12, length + (layers - 1) * 32);
    put(longer, 16, layers);
    for (std::uint32_t n = 0; n < layers; ++n) {
        longer += record;
    }
    put(bytes, 36, static_cast<std::uint32_t>(bytes.size()));  // where the file says its table is
    return bytes + longer;
}

}  // namespace fauxboard::testing
