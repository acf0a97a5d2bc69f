#include "emulator/behaviour/machine_loader.h"
#include "emulator/sliced/sample.h"

#include <algorithm>

namespace fauxboard::behaviour {
namespace {

constexpr std::size_t max_card_entries = 4096;

/// A made-up file that a resin printer can print.
void load_sample(const Json& node, const std::string& pointer, Findings& findings, std::string& content) {
    constexpr unsigned most_layers = 200;
    sliced::Sample sample;
    ObjectReader reader(node, pointer, findings);
    const auto measure = [&reader](std::string_view key, float& out, double max) {
        double value = static_cast<double>(out);
        reader.number(key, value, 0, max);
        out = static_cast<float>(value);
    };
    reader.unsigned_integer("layers", sample.layers, 1, most_layers);
    measure("exposure_s", sample.exposure_s, 86'400);
    measure("layer_height_mm", sample.layer_height_mm, 1);
    measure("lift_mm", sample.lift_mm, 100);
    measure("lift_mm_min", sample.lift_mm_min, 6000);
    reader.unsigned_integer("width", sample.width, 16, 4096);
    reader.unsigned_integer("height", sample.height, 16, 4096);
    reader.finish();
    content = sliced::make_sample(sample);
}

void load_entries(const Json& node, const std::string& pointer, Findings& findings,
                  std::vector<machine::BuiltInEntry>& out, std::size_t& count);

void load_entry(const Json& node, const std::string& pointer, Findings& findings,
                std::vector<machine::BuiltInEntry>& out, std::size_t& count) {
    machine::BuiltInEntry entry;
    ObjectReader reader(node, pointer, findings);
    entry.folder = reader.has("folder");
    reader.wire_text(entry.folder ? "folder" : "file", entry.name, 255);
    const bool bad = entry.name.empty() || entry.name.find('/') != std::string::npos;
    if (node.is_object() && bad) {
        findings.add(pointer, "expected \"file\" or \"folder\" with a name without slashes");
    }
    if (const Json* entries = reader.get("entries")) {
        load_entries(*entries, reader.pointer("entries"), findings, entry.entries, count);
    }
    if (const Json* sample = reader.get("sample")) {
        load_sample(*sample, reader.pointer("sample"), findings, entry.content);
    }
    if (const Json* lines = reader.get("lines")) {
        for (const Json& line : *lines) {
            if (!line.is_string()) {
                findings.add(reader.pointer("lines"), "expected the file's lines as texts");
                break;
            }
            entry.content += line.get_ref<const std::string&>() + "\n";
        }
    }
    reader.finish();
    out.push_back(std::move(entry));
}

void load_entries(const Json& node, const std::string& pointer, Findings& findings,
                  std::vector<machine::BuiltInEntry>& out, std::size_t& count) {
    count += node.size();
    if (!node.is_array() || count > max_card_entries) {
        findings.add(pointer, found(node) + "; expected a list of files and folders, at most 4096 in all");
        return;
    }
    for (std::size_t i = 0; i < node.size(); ++i) {
        load_entry(node[i], pointer + "/" + std::to_string(i), findings, out, count);
    }
}

void load_words(ObjectReader& reader, std::string_view key, Findings& findings,
                std::vector<std::string>& out) {
    const Json* words = reader.get(key);
    if (words == nullptr) {
        return;
    }
    if (!words->is_array() || words->size() > 16 ||
        !std::all_of(words->begin(), words->end(), [](const Json& word) { return word.is_string(); })) {
        findings.add(reader.pointer(key), found(*words) + "; expected a list of at most 16 texts");
        return;
    }
    out = words->get<std::vector<std::string>>();
}

}  // namespace

void load_card(const Json& node, const std::string& pointer, Findings& findings, machine::CardConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.boolean("present", out.present);
    reader.unsigned_integer("max_listed", out.max_listed, 1, 1000);
    reader.boolean("way_back", out.way_back);
    reader.boolean("ignore_case", out.ignore_case);
    reader.boolean("newest_first", out.newest_first);
    reader.boolean("folders", out.folders);
    load_words(reader, "only", findings, out.only);
    reader.unsigned_integer("name_bytes", out.name_bytes, 1, 255);
    reader.boolean("by_list", out.by_list);
    load_words(reader, "name_ends", findings, out.name_ends);
    reader.number("rescan_s", out.rescan_s, 0, 600);
    reader.boolean("short_names", out.short_names);
    reader.boolean("long_names", out.long_names);
    reader.number("found_s", out.found_s, 0, 60);
    if (const Json* entries = reader.get("entries")) {
        std::size_t count = 0;
        out.entries.clear();
        load_entries(*entries, reader.pointer("entries"), findings, out.entries, count);
    }
    reader.finish();
}

void load_host(const Json& node, const std::string& pointer, Findings& findings, machine::HostConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("busy_s", out.busy_s, 0, 3600);
    reader.unsigned_integer("queue_lines", out.queue_lines, 1, 1024);
    reader.unsigned_integer("line_chars", out.line_chars, 16, 511);
    reader.boolean("drops_repeated", out.drops_repeated);
    reader.boolean("judges_unnumbered", out.judges_unnumbered);
    reader.boolean("first_star_ends", out.first_star_ends);
    reader.boolean("numbers_uploads", out.numbers_uploads);
    reader.boolean("emergency_parser", out.emergency_parser);
    reader.finish();
}

void load_common(ObjectReader& reader, Findings& findings, machine::MachineConfig& machine) {
    if (const Json* part = reader.get("card")) {
        load_card(*part, reader.pointer("card"), findings, machine.card);
    }
    if (const Json* part = reader.get("host")) {
        load_host(*part, reader.pointer("host"), findings, machine.host);
    }
    reader.boolean("udisk_port", machine.udisk_port);
}

void load_identity(const Json& node, const std::string& pointer, Findings& findings,
                   machine::Identity& identity) {
    ObjectReader reader(node, pointer, findings);
    reader.wire_text("device_name", identity.device_name, 64);
    reader.wire_text("model", identity.model, 64);
    reader.wire_text("serial_number", identity.serial_number, 64);
    reader.wire_text("firmware", identity.firmware, 64);
    reader.wire_text("volume", identity.volume_text, 64);
    reader.wire_text("hardware", identity.hardware, 64);
    reader.finish();
}

}  // namespace fauxboard::behaviour
