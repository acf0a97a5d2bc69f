// Bytes of the line: splitting, unframing, parsing, decoding, encoding, explaining.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "protocol/annotate.h"
#include "protocol/command.h"
#include "protocol/framing.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using protocol::ChecksumPolicy;
using protocol::DecodedLine;
using protocol::Direction;
using protocol::FrameStyle;
using protocol::LineSplitter;

std::vector<std::string> split(std::string_view bytes, std::size_t step) {
    std::vector<std::string> lines;
    LineSplitter splitter;
    while (!bytes.empty()) {
        const std::string_view piece = bytes.substr(0, step);
        bytes.remove_prefix(piece.size());
        splitter.feed(piece, [&](std::string_view line) { lines.emplace_back(line); });
    }
    return lines;
}

bool inside(std::string_view part, std::string_view whole) {
    return part.empty() ||
           (part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size());
}

void check_command(std::string_view body) {
    const auto command = protocol::parse_command(body);
    if (!command) {
        return;
    }
    require(inside(command->word, body) && inside(command->text, body) && inside(command->argument, body),
            "a view of the command points out of its body");
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
        const auto number = command->number_of(letter);
        require(number.has_value() == command->has(letter), "has() and number_of() differ");
        require(!number || std::isfinite(*number), "a parameter is not finite");
    }
    require(inside(command->value_of("FW:"), body), "value_of() points out of its body");
}

void check_unframe(std::string_view line) {
    for (const ChecksumPolicy policy :
         {ChecksumPolicy::required, ChecksumPolicy::if_present, ChecksumPolicy::ignored}) {
        const protocol::Unframed unframed = protocol::unframe(line, policy);
        require(inside(unframed.body, line), "the body points out of its line");
        check_command(unframed.body);
        std::array<char, protocol::max_line_bytes + 16> wire{};
        const std::size_t size = protocol::write_frame(wire, unframed.body, FrameStyle::framed);
        const bool plain = protocol::plain_run(unframed.body) == unframed.body.size();
        if (size < 2 || !plain) {
            continue;
        }
        const auto again = protocol::unframe({wire.data(), size - 2}, ChecksumPolicy::required);
        require(again.fault == protocol::FrameFault::none, "a frame of our own is taken for a wrong one");
        require(again.body == unframed.body, "a frame of our own changes its body");
    }
}

void check_decode(std::string_view line, Direction direction) {
    const DecodedLine first = protocol::decode_line(line, direction);
    const std::string bytes = protocol::encode_line(first);
    const std::size_t star = bytes.rfind('*');
    if (first.style == FrameStyle::framed || first.style == FrameStyle::star_only) {
        // Up to the star all is kept; the checksum is set right, blanks behind it go.
        require(star != std::string::npos && line.starts_with(std::string_view(bytes).substr(0, star + 1)),
                "encoding changed bytes before the checksum");
    } else {
        require(bytes == line, "encoding changed a line without checksum");
    }
    const DecodedLine second = protocol::decode_line(bytes, direction);
    require(protocol::encode_line(second) == bytes, "decoding and encoding again changed the line");
    require(second.checksum_ok(), "the encoder wrote a wrong checksum");
    require(first.code == second.code && first.fields.size() == second.fields.size(),
            "decoding again found another code or other fields");
    const std::string words = protocol::explain(first);
    require(!words.empty(), "no words for a line");
    require(
        std::all_of(words.begin(), words.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x20; }),
        "a control byte in the words for a line");
}

void check(std::string_view bytes) {
    const std::vector<std::string> lines = split(bytes, bytes.size() + 1);
    for (const std::size_t step : {1U, 3U, 64U}) {
        require(split(bytes, step) == lines, "another split of the bytes gives other lines");
    }
    for (const std::string& line : lines) {
        check_unframe(line);
        check_decode(line, Direction::to_board);
        check_decode(line, Direction::to_screen);
    }
    // A recording may hold any bytes as one line.
    check_unframe(bytes);
    check_decode(bytes, Direction::to_screen);
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t enough = 4096;
    const std::string bytes(data, data + std::min(size, enough));
    fauxboard::fuzz::check(bytes);
    return 0;
}
