// The MKS DLP board as the real program: a print with what its panel shows, its settings files, its EEPROM.

#include <md5.h>
#include <sys/stat.h>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "emulator/dlp/eeprom_layout.h"
#include "emulator/dlp/panel_line.h"
#include "tests/e2e/program.h"
#include "tests/support/dlp_bench.h"

namespace fauxboard::e2e {
namespace {

using nlohmann::json;

std::string read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// What the panel is sent for a picture, put together pixel by pixel and bit by bit; and its lit pixels.
struct Picture {
    std::string md5;
    std::uint32_t lit = 0;
};
Picture slow_picture(std::uint32_t layer, std::uint32_t level) {
    Picture picture;
    MD5_CTX sum;
    MD5Init(&sum);
    for (std::uint32_t y = 0; y < 2560; ++y) {
        std::vector<unsigned char> packet(196, 0);
        packet[0] = static_cast<unsigned char>(0x40 | y >> 8);
        packet[1] = static_cast<unsigned char>(y & 0xFF);
        for (std::uint32_t x = 0; x < 1440; ++x) {
            if (testing::panel_pws_lit(layer, level, x, y)) {
                const std::uint32_t bit = x < 720 ? x : x + 48;
                packet[2 + bit / 8] = static_cast<unsigned char>(packet[2 + bit / 8] | 0x80 >> bit % 8);
                ++picture.lit;
            }
        }
        unsigned crc = 0;
        for (std::size_t i = 0; i < 194; ++i) {
            crc ^= static_cast<unsigned>(packet[i]) << 8;
            for (int bit = 0; bit < 8; ++bit) {
                crc = (crc & 0x8000) != 0 ? (crc << 1 ^ 0x1021) & 0xFFFF : crc << 1;
            }
        }
        packet[194] = static_cast<unsigned char>(crc >> 8);
        packet[195] = static_cast<unsigned char>(crc & 0xFF);
        MD5Update(&sum, packet.data(), packet.size());
    }
    std::array<char, MD5_DIGEST_STRING_LENGTH> text{};
    picture.md5 = MD5End(&sum, text.data());
    return picture;
}

/// Prints model.pws of the stick, whole.
constexpr const char* print_script = R"({
  "$schema": "scenario.schema.json",
  "name": "print",
  "profile": "mks-dlp",
  "steps": [
    { "wait": { "event": "board.ready" } },
    { "do": { "print.start": { "path": "model.pws" } } },
    { "wait": { "event": "print.finished" }, "within": "10h" },
    { "check": { "watch.broken": 0 } }
  ]
})";

TEST_CASE("the MKS DLP board prints, and keeps what its panel showed") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("stick"));
    testing::PanelPws wishes;
    wishes.layers = 3;
    wishes.antialiasing = 2;
    write_bytes(folder.file("stick/model.pws"), testing::make_panel_pws(wishes));
    write_bytes(folder.file("print.json"), print_script);
    const Result result = run({"run", "--script", folder.file("print.json"), "--speed", "max", "--udisk",
                               folder.file("stick"), "--panel", folder.file("shown")});
    INFO(result.errors);
    REQUIRE(result.code == 0);
    CHECK(contains(result.out, R"(ready {"profile":"mks-dlp","link":"none")"));

    std::ifstream lines(folder.file("shown/panel.jsonl"));
    std::string line;
    std::uint32_t count = 0;
    double before = 0;
    for (; std::getline(lines, line); ++count) {
        const json shown = json::parse(line);
        const std::uint32_t layer = count / 2;
        const Picture picture = slow_picture(layer, count % 2);
        CHECK(shown["layer"] == layer + 1);
        CHECK(shown["z_mm"].get<double>() == doctest::Approx(0.05 * (layer + 1)));
        CHECK(shown["exposure_s"] == 20.0);
        CHECK(shown["lit"] == picture.lit);
        CHECK(shown["md5"] == picture.md5);
        CHECK(shown["t"].get<double>() > before);
        before = shown["t"].get<double>();
        CHECK(read_bytes(folder.file("shown/" + shown["file"].get<std::string>())).starts_with("\x89PNG"));
    }
    CHECK(count == 6);
}

TEST_CASE("check tells of a settings file what the board would") {
    const TemporaryFolder folder;
    write_bytes(folder.file("good.acfg"), "[ZMotor]\nfeedrate = 400\nhold_time = 0\n");
    write_bytes(folder.file("bad.acfg"), "[ZMotor]\nfeedrate = 7\nfoo = 1\n");
    const Result good = run({"check", folder.file("good.acfg"), "--json"});
    CHECK(good.code == 0);
    const json said = json::parse(good.out);
    CHECK(said["result"] == "ok");
    CHECK(said["line"].is_null());
    CHECK(said["saved"] == true);
    CHECK(said["values"]["feedrate"] == 40);
    CHECK(said["values"]["hold_time_ms"] == 0);
    CHECK(said["values"]["acceleration"] == 0.7);
    CHECK(said["values"].size() == 22);
    const Result bad = run({"check", folder.file("bad.acfg"), "--json"});
    CHECK(bad.code == failed);
    const json wrong = json::parse(bad.out);
    CHECK(wrong["result"] == "unknown_param");
    CHECK(wrong["line"] == 3);
    CHECK(wrong["saved"] == false);
    CHECK(wrong["values"]["feedrate"] == 7);
    CHECK(contains(run({"check", folder.file("bad.acfg")}).out,
                   "Error in settings file / on line 3 : / Unknown parameter name"));
    CHECK(run({"check", folder.file("none.acfg"), "--json"}).code == bad_input);
    CHECK(contains(run({"check", folder.file("none.acfg")}).out, "none.acfg: there is no such file\n"));
    REQUIRE(::mkfifo(folder.file("pipe.acfg").c_str(), 0600) == 0);
    CHECK(run({"check", folder.file("pipe.acfg")}).code == bad_input);  // and does not wait for a writer
    CHECK(run({"check", "/dev/zero.acfg"}).code == bad_input);
    write_bytes(folder.file("large.acfg"), std::string(2UL << 20, '\n'));
    CHECK(contains(run({"check", folder.file("large.acfg")}).out, "which no settings file is"));
}

TEST_CASE("killed at any moment, the EEPROM holds what the chip would, and the board starts from it") {
    const TemporaryFolder folder;
    const std::string file = folder.file("chip");
    std::string whole(dlp::eeprom_bytes, '\xFF');
    for (const dlp::Block block : dlp::all_blocks) {
        const auto bytes =
            dlp::block_bytes(block, dlp::default_kept(dlp::Firmware::v001), dlp::Firmware::v001);
        std::copy(bytes.begin(), bytes.end(), whole.begin() + dlp::address_of(block));
    }
    for (int kill = 0; kill < 100; ++kill) {
        if (kill % 5 == 0) {
            std::filesystem::remove(file);
        }
        Program board({"run", "--profile", "mks-dlp", "-q", "--speed", "20", "--eeprom", file, "--control",
                       folder.file("control")});
        board.ready();
        for (int i = 0; i < kill % 5; ++i) {
            CHECK(run({"ctl", folder.file("control"), "get", "board.ready"}).code == 0);
        }
        board.signal(SIGKILL);
        board.wait();
        const std::string bytes = read_bytes(file);
        REQUIRE(bytes.size() == dlp::eeprom_bytes);
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            CHECK((bytes[at] == whole[at] || bytes[at] == '\xFF'));
        }
        std::filesystem::remove(folder.file("control"));
    }
}

TEST_CASE("the MKS DLP board: what cannot be is said") {
    const TemporaryFolder folder;
    write_bytes(folder.file("short"), "not a chip");
    check_mistakes({{{"run", "--profile", "mks-dlp", "--pty"}, bad_input, "has no line"},
                    {{"run", "--profile", "mks-dlp", "--eeprom", folder.file("short")},
                     bad_input,
                     "the chip has 2048 bytes, and this file 10"},
                    {{"run", "--profile", "mks-dlp", "--fault", "garble"},
                     usage,
                     "this board has no line that it could spoil"},
                    {{"run", "--panel", folder.file("shown")}, bad_input, "has no UV panel"}});
    // And nothing is said of lines that it does not have.
    const Result brief = run({"run", "-q", "--profile", "mks-dlp", "--duration", "1s", "--speed", "max"});
    CHECK(brief.code == 0);
    CHECK(brief.errors.ends_with("\nAfter 1.000 s.\n"));
}

}  // namespace
}  // namespace fauxboard::e2e
