#include "emulator/record/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <functional>
#include <istream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "emulator/behaviour/parse_json.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/link/waiting_file.h"

namespace fauxboard::record {
namespace {

constexpr std::size_t max_text = 64U * 1024;
constexpr double max_seconds = 1e9;  // thirty years: beyond it is no recording
constexpr std::array<std::string_view, 8> from_names{"board", "screen",  "host",   "world",
                                                     "usb",   "network", "module", "fault"};

std::string found(const behaviour::Json& value) {
    const std::string text = value.dump(-1, ' ', true, behaviour::Json::error_handler_t::replace);
    return "found " + (text.size() > 60 ? text.substr(0, 60) + "..." : text);
}

}  // namespace

std::string_view from_name(RecordedLine::From from) {
    return from_names[static_cast<std::size_t>(from)];
}

RecordingError::RecordingError(std::string_view file, std::size_t line, std::string_view message)
    : std::runtime_error(line == 0 ? fmt::format("{}: {}", file, message)
                                   : fmt::format("{}:{}: {}", file, line, message)) {}

void RecordingReader::fail(std::string_view message) const {
    throw RecordingError(name_, line_, message);
}

/// A disk that fails in the middle throws out of the stream's buffer, whatever the stream is told.
int RecordingReader::next_byte() {
    try {
        return in_.rdbuf()->sbumpc();
    } catch (const std::ios_base::failure& error) {
        fail(fmt::format("it cannot be read ({})", error.code().message()));
    }
}

/// The next line of the file into text_. False at the end.
bool RecordingReader::read_text() {
    text_.clear();
    ++line_;
    for (;;) {
        const int c = next_byte();
        if (c == std::char_traits<char>::eof()) {
            return !text_.empty();
        }
        if (c == '\n') {
            return true;
        }
        if (text_.size() == max_text) {
            fail("a line of more than 64 KiB; expected one JSON object a line");
        }
        text_ += static_cast<char>(c);
    }
}

std::optional<RecordedLine> RecordingReader::next() {
    while (read_text()) {
        if (text_.find_first_not_of(" \t\r") == std::string::npos) {
            continue;
        }
        if (auto line = parse()) {
            return line;
        }
    }
    return std::nullopt;
}

/// Nothing for a note, which `decode` makes of what a host program logged of itself.
std::optional<RecordedLine> RecordingReader::parse() {
    const auto entry = behaviour::parse_json(text_);
    if (!entry.is_object()) {
        fail(entry.is_discarded() ? "not JSON; expected one JSON object a line"
                                  : found(entry) + "; expected an object with t, from, and line or do");
    }
    if (entry.contains("note") && !entry.contains("t")) {
        return std::nullopt;
    }
    const auto value = [&](const char* key) -> const behaviour::Json& {
        const auto hit = entry.find(key);
        if (hit == entry.end()) {
            fail(fmt::format("the key \"{}\" is missing", key));
        }
        return *hit;
    };
    RecordedLine out;
    const behaviour::Json& t = value("t");
    if (!t.is_number() || !(t.get<double>() >= 0 && t.get<double>() <= max_seconds)) {
        fail("t: " + found(t) + "; expected seconds from 0 to 1e9");
    }
    out.t = machine::from_seconds(t.get<double>());
    const behaviour::Json& from = value("from");
    const auto name = from.is_string() ? std::find(from_names.begin(), from_names.end(),
                                                   std::string_view(from.get_ref<const std::string&>()))
                                       : from_names.end();
    if (name == from_names.end()) {
        fail("from: " + found(from) + "; expected board, screen, host, world, usb, network, module or fault");
    }
    out.from = static_cast<RecordedLine::From>(name - from_names.begin());
    const char* key = out.key();
    const behaviour::Json& bytes = value(key);
    auto wire = bytes.is_string() ? behaviour::to_wire(bytes.get_ref<const std::string&>()) : std::nullopt;
    const bool ends = wire && wire->find_first_of(std::string_view("\r\n")) != std::string::npos;
    if (!wire || (ends && !out.is_datagram())) {
        fail(fmt::format("{}: {}; expected a text of characters up to U+00FF{}", key, found(bytes),
                         out.is_datagram() ? "" : " without line ends"));
    }
    out.bytes = std::move(*wire);
    if (out.is_datagram()) {
        const behaviour::Json& peer = value("peer");
        if (!peer.is_number_unsigned() || peer.get<std::uint64_t>() == 0) {
            fail("peer: " + found(peer) + "; expected a whole number from 1 on");
        }
        out.peer = peer.get<std::uint64_t>();
    }
    return out;
}

std::optional<RecordedLine> OrderedRecording::next() {
    while (!ended_ && heap_.size() < window) {
        auto line = reader_.next();
        if (!line) {
            ended_ = true;
            break;
        }
        if (any_ && line->t < last_) {
            throw RecordingError(reader_.name(), reader_.line(),
                                 fmt::format("its time lies before that of {} entries ahead of it", window));
        }
        heap_.push_back({*std::move(line), read_++});
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
    if (heap_.empty()) {
        return std::nullopt;
    }
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    RecordedLine line = std::move(heap_.back().line);
    heap_.pop_back();
    last_ = line.t;
    any_ = true;
    return line;
}

std::vector<RecordedLine> load_recording(std::istream& in, std::string_view name) {
    RecordingReader reader(in, std::string(name));
    std::vector<RecordedLine> lines;
    while (auto line = reader.next()) {
        lines.push_back(std::move(*line));
    }
    std::stable_sort(lines.begin(), lines.end(),
                     [](const RecordedLine& a, const RecordedLine& b) { return a.t < b.t; });
    return lines;
}

std::ifstream open_recording(const std::filesystem::path& file) {
    std::error_code error;
    const auto kind = std::filesystem::status(file, error).type();
    if (kind == std::filesystem::file_type::not_found) {
        throw RecordingError(file.string(), 0, "there is no such file");
    }
    if (kind != std::filesystem::file_type::regular) {
        throw RecordingError(file.string(), 0, error ? error.message() : "it is no file");
    }
    if (link::must_be_waited_for(file.string())) {
        throw RecordingError(file.string(), 0, "it is no file: it would have to be waited for");
    }
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        throw RecordingError(file.string(), 0,
                             "it cannot be read (" + std::system_category().message(errno) + ")");
    }
    return in;
}

std::vector<RecordedLine> load_recording(const std::filesystem::path& file) {
    std::ifstream in = open_recording(file);
    return load_recording(in, file.string());
}

namespace {

/// `peer`: of a datagram, else 0.
std::string line_text(machine::SimTime t, std::string_view from, std::uint64_t peer, std::string_view key,
                      std::string_view bytes) {
    const std::string text = behaviour::Json(behaviour::from_wire(bytes)).dump(-1, ' ', true);
    const std::string who = peer == 0 ? std::string{} : fmt::format(", \"peer\": {}", peer);
    const auto us = t.count();
    return fmt::format("{{\"t\": {}.{:06}, \"from\": \"{}\"{}, \"{}\": {}}}\n", us / 1'000'000,
                       us % 1'000'000, from, who, key, text);
}

}  // namespace

std::string recording_line(machine::SimTime t, std::string_view from, std::string_view key,
                           std::string_view bytes) {
    return line_text(t, from, 0, key, bytes);
}

std::string recording_line(const RecordedLine& line) {
    return line_text(line.t, from_name(line.from), line.peer, line.key(), line.bytes);
}

}  // namespace fauxboard::record
