#include "emulator/record/transcript_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "emulator/behaviour/wire_text.h"
#include "protocol/chitu_chunk.h"
#include "protocol/framing.h"

namespace fauxboard::record {
namespace {

using Json = nlohmann::ordered_json;
using Form = TranscriptEntry::Form;
using From = RecordedLine::From;
using protocol::DecodedLine;
using protocol::FrameStyle;

constexpr int words_column = 36;  // most lines are shorter

void judge_checksum(const TranscriptEntry&, const DecodedLine& line, std::vector<LineMark>& marks) {
    if (!line.checksum_ok()) {
        marks.push_back({"checksum", fmt::format("the checksum is {}, right would be {}", line.checksum_given,
                                                 line.checksum_expected)});
    }
}

void judge_code(const TranscriptEntry&, const DecodedLine& line, std::vector<LineMark>& marks) {
    if (line.code == nullptr) {
        marks.push_back({"unknown code", fmt::format("the code {} is not known in this direction",
                                                     behaviour::as_ascii(line.code_text))});
    }
}

void judge_fields(const TranscriptEntry&, const DecodedLine& line, std::vector<LineMark>& marks) {
    for (const protocol::DecodedField& field : line.fields) {
        if (line.code != nullptr && field.info == nullptr) {
            marks.push_back(
                {"unknown field", fmt::format("{} has no field {}", behaviour::as_ascii(line.code_text),
                                              behaviour::as_ascii(field.key + field.text))});
        }
    }
}

void judge_length(const TranscriptEntry& entry, const DecodedLine&, std::vector<LineMark>& marks) {
    if (entry.bytes.size() > protocol::max_line_bytes) {
        marks.push_back({"length", fmt::format("{} bytes; a board takes {} at most", entry.bytes.size(),
                                               protocol::max_line_bytes)});
    }
}

void judge_nuls(const TranscriptEntry& entry, const DecodedLine&, std::vector<LineMark>& marks) {
    if (const auto nuls = std::count(entry.bytes.begin(), entry.bytes.end(), '\0'); nuls != 0) {
        marks.push_back({"nul", fmt::format("{} NUL bytes, which a board drops", nuls)});
    }
}

char mark_of(const std::vector<LineMark>& marks) {
    if (marks.empty()) {
        return ' ';
    }
    const std::string& kind = marks.front().kind;
    if (kind == "checksum") {
        return '!';
    }
    if (kind.starts_with("unknown")) {
        return '?';
    }
    return kind == "unreadable" ? 'x' : '*';
}

std::string time_text(const TranscriptEntry& entry) {
    if (!entry.clock.empty()) {
        return entry.clock;
    }
    return entry.t ? fmt::format("{:.6f}", machine::to_seconds(*entry.t)) : std::string();
}

std::string head_of(From from, std::string_view peer) {
    switch (from) {
        case From::board:
            return fmt::format("board → {}", peer);
        case From::screen:
            return fmt::format("{} → board", peer);
        case From::host:
            return "host → board";
        case From::usb:
            return "board → host";
        case From::network:
            return "network → board";
        case From::module:
            return "board → network";
        case From::world:
            break;
    }
    return "world";
}

/// What a datagram says, its end left off. For a piece of a file, which says nothing, `piece` tells it.
std::string datagram_line(const TranscriptEntry& entry, std::string& piece) {
    const protocol::Chunk chunk = protocol::read_chunk(entry.bytes);
    if (chunk.fault == protocol::ChunkFault::no_chunk) {
        return entry.bytes.substr(0, entry.bytes.find_last_not_of(std::string_view("\0\r\n ", 4)) + 1);
    }
    piece = fmt::format("piece of a file: {} bytes from {} on{}", chunk.payload.size(), chunk.offset,
                        chunk.fault == protocol::ChunkFault::none ? "" : "; damaged");
    return fmt::format("({} bytes)", entry.bytes.size());
}

bool is_datagram(const TranscriptEntry& entry) {
    return entry.from == From::network || entry.from == From::module;
}

/// explain() says what is wrong with the frame and which fields are unknown; the rest is said behind it.
std::string words_of(const JudgedLine& line) {
    if (!line.decoded) {
        return {};
    }
    std::string words = protocol::explain(*line.decoded);
    for (const LineMark& mark : line.marks) {
        if (mark.kind != "checksum" && !mark.kind.starts_with("unknown")) {
            words += fmt::format(" [{}]", mark.sentence);
        }
    }
    return words;
}

std::string_view checksum_word(const DecodedLine& line) {
    switch (line.style) {
        case FrameStyle::framed:
            return line.checksum_ok() ? "right" : "wrong";
        case FrameStyle::bare:
            return "none";
        case FrameStyle::star_only:
        case FrameStyle::unfinished:
            break;
    }
    return "unfinished";
}

Json field_json(const protocol::DecodedField& field) {
    Json out{{"key", behaviour::from_wire(field.key)}, {"text", behaviour::from_wire(field.text)}};
    if (field.number) {
        out["value"] = *field.number;
    }
    if (field.info == nullptr) {
        out["known"] = false;
        return out;
    }
    const protocol::FieldInfo& info = *field.info;
    out["name"] = info.name;
    if (!info.unit.empty()) {
        out["unit"] = info.unit;
    }
    const bool whole = field.number && *field.number == std::floor(*field.number);
    const std::string_view words =
        whole ? protocol::words_of(info, static_cast<std::int64_t>(*field.number)) : std::string_view();
    const std::string_view meaning = words.empty() ? info.meaning : words;
    if (!meaning.empty()) {
        out["meaning"] = meaning;
    }
    return out;
}

void add_decoded(Json& out, const DecodedLine& line) {
    out["code"] = behaviour::from_wire(line.code_text);
    if (line.code != nullptr) {
        out["title"] = line.code->title;
    }
    out["words"] = protocol::explain(line);
    Json fields = Json::array();
    for (const protocol::DecodedField& field : line.fields) {
        fields.push_back(field_json(field));
    }
    out["fields"] = std::move(fields);
    out["checksum"] = checksum_word(line);
    if (!line.checksum_ok()) {
        out["checksum_expected"] = line.checksum_expected;
    }
    out["known"] = line.known();
}

std::string dump(const Json& out) {
    return out.dump(-1, ' ', true, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::vector<LineJudge> line_judges() {
    return {judge_checksum, judge_code, judge_fields, judge_length, judge_nuls};
}

JudgedLine judge(TranscriptEntry entry, const std::vector<LineJudge>& judges) {
    JudgedLine out;
    out.entry = std::move(entry);
    if (out.entry.form == Form::bad) {
        out.marks.push_back({"unreadable", out.entry.problem});
    } else if (is_datagram(out.entry)) {
        const std::string line = datagram_line(out.entry, out.piece);
        if (out.piece.empty()) {
            out.decoded = protocol::decode_line(without_nuls(line), out.entry.direction());
        }
    } else if (!out.entry.note && out.entry.from != From::world) {
        out.decoded = protocol::decode_line(without_nuls(out.entry.bytes), out.entry.direction());
        if (out.entry.from == From::usb && out.decoded->code == nullptr) {
            out.decoded.reset();  // a console's own words, of which there is no list
        }
    }
    if (out.decoded && !is_datagram(out.entry) && out.entry.from != From::usb) {
        for (const LineJudge& each : judges) {
            each(out.entry, *out.decoded, out.marks);
        }
    }
    return out;
}

bool makes_sense(const JudgedLine& line) {
    if (line.entry.form == Form::bad || line.entry.note) {
        return false;
    }
    if (line.entry.form != Form::raw || !line.decoded || line.decoded->code != nullptr) {
        return true;
    }
    // An unknown code is still one: "M2999".
    const std::string& word = line.decoded->code_text;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return word.size() > 1 && word[0] >= 'A' && word[0] <= 'Z' &&
           std::all_of(word.begin() + 1, word.end(), is_digit);
}

std::string text_line(const JudgedLine& line) {
    const TranscriptEntry& entry = line.entry;
    const char mark = mark_of(line.marks);
    if (entry.form == Form::bad) {
        return fmt::format("{} {}:{}: {}: \"{}\"\n", mark, behaviour::as_ascii(entry.file), entry.number,
                           behaviour::as_ascii(entry.problem), behaviour::as_ascii(entry.bytes));
    }
    std::string text = fmt::format("{} ", mark);
    if (entry.form != Form::raw) {
        text += fmt::format("{:>15}  ", time_text(entry));
    }
    text += fmt::format("{:<14}  ", entry.note ? "log" : head_of(entry.from, line.peer));
    std::string piece;
    const std::string bytes = is_datagram(entry) ? datagram_line(entry, piece) : entry.bytes;
    const std::string words = piece.empty() ? words_of(line) : piece;
    if (words.empty()) {
        return text + behaviour::as_ascii(bytes) + '\n';
    }
    return text + fmt::format("{:<{}}  {}\n", behaviour::as_ascii(bytes), words_column, words);
}

std::string json_line(const JudgedLine& line) {
    const TranscriptEntry& entry = line.entry;
    if (entry.form == Form::bad) {
        return dump({{"file", behaviour::from_wire(entry.file)},
                     {"number", entry.number},
                     {"problem", entry.problem},
                     {"text", behaviour::from_wire(entry.bytes)}});
    }
    if (entry.note) {
        return dump({{"file", behaviour::from_wire(entry.file)},
                     {"number", entry.number},
                     {"note", behaviour::from_wire(entry.bytes)}});
    }
    Json out = Json::object();
    if (entry.t) {
        out["t"] = static_cast<double>(entry.t->count()) / 1e6;
    }
    if (!entry.clock.empty()) {
        out["clock"] = entry.clock;
    }
    out["from"] = from_name(entry.from);
    const RecordedLine as_recorded{{}, entry.from, {}, entry.peer};
    if (as_recorded.is_datagram()) {
        out["peer"] = entry.peer;
    }
    out[as_recorded.key()] = behaviour::from_wire(entry.bytes);
    if (!line.piece.empty()) {
        out["words"] = line.piece;
    }
    if (line.decoded) {
        add_decoded(out, *line.decoded);
        Json marks = Json::array();
        std::transform(line.marks.begin(), line.marks.end(), std::back_inserter(marks),
                       [](const LineMark& mark) {
                           return Json{{"kind", mark.kind}, {"sentence", mark.sentence}};
                       });
        out["marks"] = std::move(marks);
    }
    return dump(out);
}

}  // namespace fauxboard::record
