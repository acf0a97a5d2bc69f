#include "tests/support/chitu.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "emulator/behaviour/wire_text.h"

namespace fauxboard::testing {
namespace {

using nlohmann::json;

constexpr std::pair<const char*, std::uint64_t> others[] = {{"_d300p_carriage_tensioner_sla.ctb", 51793495},
                                                            {"_Diamond_Tray_sla.ctb", 13482731},
                                                            {"_mars_psd_V9angled_sla.ctb", 41483585}};
constexpr const char* text_file = "TEST.TXT";

std::string wire(const json& text) {
    const auto bytes = behaviour::to_wire(text.get<std::string>());
    if (!bytes) {
        throw std::runtime_error("not Latin-1: " + text.dump());
    }
    return *bytes;
}

std::string line(const json& text) {
    std::string bytes = wire(text);
    return bytes.ends_with('\r') || bytes.ends_with('\n') ? bytes : bytes + "\r\n";
}

std::string lines(const json& list) {
    std::string out;
    for (const json& item : list) {
        out += line(item);
    }
    return out;
}

ChituVector read_vector(const json& node) {
    ChituVector out;
    out.name = node.at("name").get<std::string>();
    out.stick = node.value("stick", true);
    for (const json& item : node.value("prepare", json::array())) {
        out.prepare.push_back({line(item.at("send")), item.value("wait_s", 0.01)});
    }
    out.send = line(node.at("send"));
    const json& reply = node.at("reply");
    out.reply = reply.is_array() ? lines(reply) : wire(reply);
    out.after_s = node.value("after_s", 0.0);
    const json state = node.value("state", json::object());
    for (const auto& [path, value] : state.items()) {
        value.is_string() ? void(out.texts[path] = wire(value)) : void(out.state[path] = value.get<double>());
    }
    const json files = node.value("files", json::object());
    for (const auto& [path, content] : files.items()) {
        for (const json& item : content) {
            out.files[path] += wire(item) + "\n";
        }
    }
    return out;
}

}  // namespace

ChituVectors load_chitu_vectors(std::string_view name) {
    std::ifstream in(FAUXBOARD_SOURCE_DIR "/tests/vectors/" + std::string(name) + ".json");
    const json root = json::parse(in);
    ChituVectors out;
    out.profile = root.at("profile").get<std::string>();
    for (const json& node : root.at("vectors")) {
        out.vectors.push_back(read_vector(node));
    }
    return out;
}

ResinFile seed_wishes() {
    ResinFile wishes;
    wishes.layers = 6;
    wishes.bottom_layers = 2;
    wishes.exposure_s = 8;
    wishes.bottom_exposure_s = 20;
    return wishes;
}

const MadeResinFile& seed_content() {
    static const MadeResinFile made = make_resin_file(seed_wishes());
    return made;
}

void make_seed_stick(const std::string& folder) {
    const auto make = [&](const std::string& name, std::string_view content, std::uint64_t bytes) {
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        std::ofstream(path, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
        std::filesystem::resize_file(path, bytes);
    };
    for (const auto& [name, bytes] : others) {
        make(name, {}, bytes);
    }
    make(seed_file, seed_content().bytes, seed_file_bytes);
    make(text_file, "a text\n", 7);
    std::filesystem::create_directory(std::filesystem::path(folder) / "System Volume Information");
}

void put_seed_stick(MemoryDisk& disk) {
    disk.set_room(1U << 20U);
    for (const auto& [name, bytes] : others) {
        disk.put(name, bytes,
                 [](std::uint64_t, std::span<char> out) { std::fill(out.begin(), out.end(), '\0'); });
    }
    disk.put(seed_file, seed_file_bytes, [](std::uint64_t offset, std::span<char> out) {
        std::fill(out.begin(), out.end(), '\0');
        const std::string& head = seed_content().bytes;
        if (offset < head.size()) {
            head.copy(out.data(), out.size(), static_cast<std::size_t>(offset));
        }
    });
    disk.put(text_file, "a text\n");
}

}  // namespace fauxboard::testing
