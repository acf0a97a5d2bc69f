#include "emulator/behaviour/frame_loader.h"

#include <array>
#include <utility>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/rule_compiler.h"
#include "emulator/behaviour/wire_text.h"

namespace fauxboard::behaviour {
namespace {

constexpr std::size_t most_lines = 200;
/// Frames that take over lines of frames that take over lines.
constexpr int deepest = 4;

}  // namespace

FrameTemplate FrameLoader::compile(const Json& node, const std::string& pointer, bool loop) {
    if (!node.is_string()) {
        findings_.add(pointer, found(node) + "; expected a text, the line with {places} for its values");
        return {};
    }
    Names names = context_.request_names;
    names.loop = loop;
    const auto bytes = to_wire(around_.prefix + node.get_ref<const std::string&>() + around_.suffix);
    if (!bytes) {
        findings_.add(pointer, "a character that is not one byte on the wire (beyond U+00FF)");
        return {};
    }
    try {
        return FrameTemplate(*bytes, names);
    } catch (const ExpressionError& error) {
        findings_.add(pointer, error.what(), error.nearest);
        return {};
    }
}

std::vector<Condition> FrameLoader::conditions(ObjectReader& reader, bool loop) {
    std::vector<Condition> all = around_.when;
    if (const Json* when = reader.get("when")) {
        Names names = context_.request_names;
        names.loop = loop;
        for (Condition& condition : RuleCompiler(findings_, names, context_.index, context_.machine)
                                        .conditions(*when, reader.pointer("when"))) {
            all.push_back(std::move(condition));
        }
    }
    return all;
}

/// One line, lines for all entries of a list, or lines taken over from another frame.
void FrameLoader::load_line(const Json& node, const std::string& pointer, Frame& frame) {
    if (!node.is_object()) {
        frame.lines.push_back({compile(node, pointer, false), false, false, around_.when});
        return;
    }
    ObjectReader reader(node, pointer, findings_);
    Frame::Line line;
    constexpr std::array<std::string_view, 2> lists{"card.entries", "card.files"};
    std::size_t which = lists.size();
    reader.choice("for_each", lists, which);
    line.for_each_entry = which < lists.size();
    line.all_files = which == 1;
    line.when = conditions(reader, line.for_each_entry);
    if (reader.has("frame")) {
        take_over(reader, line.when, frame);
    } else {
        reader.required("line");
        if (const Json* text = reader.get("line")) {
            line.text = compile(*text, reader.pointer("line"), line.for_each_entry);
        }
        frame.lines.push_back(std::move(line));
    }
    reader.finish();
}

void FrameLoader::take_over(ObjectReader& reader, const std::vector<Condition>& when, Frame& frame) {
    std::string name;
    Around around;
    reader.text("frame", name);
    reader.text("prefix", around.prefix);
    reader.text("suffix", around.suffix);
    const auto hit = context_.frames.find(name);
    if (hit == context_.frames.end() || around_.depth == deepest) {
        std::vector<std::string_view> names;
        for (const auto& [known, index] : context_.index) {
            names.emplace_back(known);
        }
        findings_.add(reader.pointer("frame"),
                      around_.depth == deepest ? "frames that take over each other's lines"
                                               : "unknown frame \"" + name + '"',
                      around_.depth == deepest ? std::string() : std::string(nearest(name, names)));
        return;
    }
    around.prefix = around_.prefix + around.prefix;
    around.suffix += around_.suffix;
    around.when = when;
    around.depth = around_.depth + 1;
    const Around before = std::exchange(around_, std::move(around));
    take_over(*hit, reader.pointer("frame"), frame);
    around_ = before;
}

/// The lines of a frame, as if they stood here.
void FrameLoader::take_over(const Json& node, const std::string& pointer, Frame& frame) {
    if (!node.is_object()) {
        load_line(node, pointer, frame);
    } else if (const auto text = node.find("line"); text != node.end()) {
        load_line(*text, pointer, frame);
    } else if (const auto lines = node.find("lines"); lines != node.end() && lines->is_array()) {
        for (const Json& line : *lines) {
            load_line(line, pointer, frame);
        }
    }
}

void FrameLoader::load_lines(const Json& node, const std::string& pointer, Frame& frame) {
    if (!node.is_array() || node.empty() || node.size() > most_lines) {
        findings_.add(pointer, found(node) + "; expected a list of 1 to 200 lines");
        return;
    }
    for (std::size_t i = 0; i < node.size(); ++i) {
        load_line(node[i], pointer + "/" + std::to_string(i), frame);
    }
}

void FrameLoader::load_ways(ObjectReader& reader, Frame& frame) {
    constexpr std::array<std::string_view, 4> styles{"framed", "bare", "star_only", "unfinished"};
    auto style = static_cast<std::size_t>(frame.style);
    reader.choice("style", styles, style);
    frame.style = static_cast<protocol::FrameStyle>(style);
    constexpr std::array<std::string_view, 3> ends{"crlf", "lf", "none"};
    auto end = static_cast<std::size_t>(frame.end);
    reader.choice("end", ends, end);
    frame.end = static_cast<protocol::LineEnd>(end);
    constexpr std::array<std::string_view, channel_count + 1> channels{"main", "host", "network", "all"};
    std::size_t to = channels.size();
    reader.choice("to", channels, to);
    frame.everywhere = to == channel_count;
    if (to < channel_count) {
        frame.to = static_cast<Channel>(to);
    }
}

void FrameLoader::load_cell(ObjectReader& reader, Frame& frame) {
    std::string name;
    reader.text("cell", name, 64);
    if (!name.empty()) {
        frame.cell = cells_.emplace(name, cells_.size()).first->second;
    }
}

void FrameLoader::load(const Json& node, const std::string& pointer, Frame& frame) {
    frame.style = context_.style;
    frame.end = context_.end;
    if (!node.is_object()) {
        load_line(node, pointer, frame);
        return;
    }
    ObjectReader reader(node, pointer, findings_);
    load_ways(reader, frame);
    load_cell(reader, frame);
    const Json* text = reader.get("line");
    const Json* lines = reader.get("lines");
    reader.boolean("chunk", frame.chunk);
    if (frame.chunk) {
        if (text != nullptr || lines != nullptr) {
            findings_.add(pointer, "a frame with \"chunk\" has no lines of its own");
        }
    } else if ((text == nullptr) == (lines == nullptr)) {
        findings_.add(pointer, "expected either \"line\" or \"lines\"");
    } else if (text != nullptr) {
        frame.lines.push_back({compile(*text, reader.pointer("line"), false), false, false, {}});
    } else {
        load_lines(*lines, reader.pointer("lines"), frame);
    }
    if (const Json* then = reader.get("then")) {
        RuleCompiler compiler(findings_, context_.names, context_.index, context_.machine);
        frame.then = compiler.actions(*then, reader.pointer("then"));
    }
    reader.finish();
}

}  // namespace fauxboard::behaviour
