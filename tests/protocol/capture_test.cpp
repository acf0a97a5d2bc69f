// Every line of a recorded A30T line: known, verified, and the same bytes again. The recording is somebody
// else's and not part of this repository; without it the test says so and passes.

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "protocol/annotate.h"
#include "protocol/command.h"

using namespace fauxboard::protocol;

namespace {

struct Recorded {
    Direction direction;
    std::string line;
};

/// The JSON holds bytes as Latin-1 code points; what the parser returns is UTF-8.
std::string latin1(const std::string& utf8) {
    std::string bytes;
    for (std::size_t i = 0; i < utf8.size(); ++i) {
        const auto lead = static_cast<unsigned char>(utf8[i]);
        if (lead < 0x80 || i + 1 == utf8.size()) {
            bytes += utf8[i];
        } else {
            const auto next = static_cast<unsigned char>(utf8[++i]);
            bytes += static_cast<char>(((lead & 0x03) << 6) | (next & 0x3F));
        }
    }
    return bytes;
}

std::vector<Recorded> recording() {
    std::ifstream file(FAUXBOARD_SOURCE_DIR "/../shared/captures/a30t-boot-heat-load-home.jsonl");
    std::vector<Recorded> lines;
    for (std::string text; std::getline(file, text);) {
        const auto entry = nlohmann::json::parse(text);
        const std::string from = entry.at("from");
        if (from != "board" && from != "screen") continue;
        lines.push_back({from == "board" ? Direction::to_screen : Direction::to_board,
                         latin1(entry.at("line").get<std::string>())});
    }
    return lines;
}

}  // namespace

TEST_CASE("the recorded line decodes, verifies and encodes to the same bytes") {
    const auto lines = recording();
    if (lines.empty()) {
        MESSAGE("skipped: no recording beside the source tree");
        return;
    }
    CHECK(lines.size() == 504);
    std::size_t framed = 0;
    std::size_t serials = 0;
    for (const Recorded& recorded : lines) {
        const std::string& wire = recorded.line;
        CAPTURE(wire);
        const DecodedLine line = decode_line(wire, recorded.direction);
        REQUIRE(line.known());
        REQUIRE(line.checksum_ok());
        REQUIRE(encode_line(line) == wire);
        REQUIRE(explain(line).find("unknown") == std::string::npos);
        if (line.style == FrameStyle::framed) ++framed;
        const DecodedField* serial = line.field("SN:");
        if (serial != nullptr && serial->text == std::string(16, '\xFF')) ++serials;

        const Unframed body = unframe(wire, ChecksumPolicy::required);
        REQUIRE(body.fault == FrameFault::none);
        REQUIRE(parse_command(body.body).has_value());
        if (line.style == FrameStyle::framed) REQUIRE(frame(body.body) == wire + "\r\n");
    }
    CHECK(framed == 503);  // all but the screen's log line
    CHECK(serials >= 2);
}
