#include "emulator/record/pcapng.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "emulator/link/host_error.h"
#include "tests/host/tap_files.h"

namespace fauxboard::record {
namespace {

using machine::SimTime;
using protocol::Direction;

std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
        value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
}

struct Block {
    std::uint32_t type = 0;
    std::string body;
};

/// The blocks of a capture. Checks that each is whole, padded and carries its length at both ends.
std::vector<Block> blocks_of(std::string_view bytes) {
    std::vector<Block> blocks;
    while (!bytes.empty()) {
        REQUIRE(bytes.size() >= 12);
        const std::size_t length = number(bytes, 4, 4);
        REQUIRE(length >= 12);
        REQUIRE(length % 4 == 0);
        REQUIRE(length <= bytes.size());
        REQUIRE(number(bytes, length - 4, 4) == length);
        blocks.push_back({number(bytes, 0, 4), std::string(bytes.substr(8, length - 12))});
        bytes.remove_prefix(length);
    }
    return blocks;
}

/// The value of an option behind `at`. Checks that the list of options is whole and ended.
std::string option_of(std::string_view body, std::size_t at, std::uint32_t code) {
    std::string found = "none";
    for (;;) {
        REQUIRE(at + 4 <= body.size());
        const std::uint32_t here = number(body, at, 2);
        const std::size_t size = number(body, at + 2, 2);
        if (here == 0) {
            CHECK(size == 0);
            CHECK(at + 4 == body.size());
            return found;
        }
        REQUIRE(at + 4 + size <= body.size());
        if (here == code) {
            found = body.substr(at + 4, size);
        }
        at += 4 + (size + 3) / 4 * 4;
    }
}

TEST_CASE("a capture begins with a section and the two interfaces of a serial line") {
    const auto blocks = blocks_of(pcapng_head());
    REQUIRE(blocks.size() == 3);
    CHECK(blocks[0].type == 0x0A0D0D0A);
    CHECK(number(blocks[0].body, 0, 4) == 0x1A2B3C4D);
    CHECK(number(blocks[0].body, 4, 2) == 1);
    CHECK(option_of(blocks[0].body, 16, 4) == "fauxboard tap");
    for (const std::size_t i : {1U, 2U}) {
        CHECK(blocks[i].type == 1);
        CHECK(number(blocks[i].body, 0, 2) == pcapng_link_type);
        CHECK(option_of(blocks[i].body, 8, 9) == "\x06");
    }
    CHECK(option_of(blocks[1].body, 8, 2) == "board");
    CHECK(option_of(blocks[2].body, 8, 2) == "other end");
}

TEST_CASE("a packet keeps bytes, direction and time to the microsecond") {
    const SimTime t{1'700'000'000'123'456};
    for (const std::size_t size : {0U, 1U, 2U, 3U, 4U, 100U, 8192U}) {
        for (const Direction direction : {Direction::to_screen, Direction::to_board}) {
            std::string bytes(size, '\xFF');
            if (size != 0) {
                bytes.front() = '\0';
            }
            const auto blocks = blocks_of(pcapng_packet(t, direction, bytes));
            REQUIRE(blocks.size() == 1);
            const std::string& body = blocks[0].body;
            const bool from_board = direction == Direction::to_screen;
            CHECK(blocks[0].type == 6);
            CHECK(number(body, 0, 4) == (from_board ? 0U : 1U));
            const auto high = static_cast<std::uint64_t>(number(body, 4, 4)) << 32;
            CHECK((high | number(body, 8, 4)) == 1'700'000'000'123'456U);
            CHECK(number(body, 12, 4) == size + pcapng_event_bytes);
            CHECK(number(body, 16, 4) == size + pcapng_event_bytes);
            CHECK(body.substr(20, 12) == std::string("\x65\x53\xF1\x00\x00\x01\xE2\x40", 8) +
                                             (from_board ? '\x01' : '\x02') + std::string(3, '\0'));
            CHECK((body.substr(32, size) == bytes));
            const std::size_t options = 20 + (12 + size + 3) / 4 * 4;
            CHECK(option_of(body, options, 2) ==
                  std::string(from_board ? "\x02" : "\x01") + std::string(3, '\0'));
        }
    }
}

TEST_CASE("the writer adds the start of the tap to its times, and writes each packet at once") {
    const host::test::TemporaryFolder folder;
    const std::string file = folder.file("x.pcapng");
    PcapngWriter writer(file, SimTime{5'000'000}, {});
    CHECK((host::test::read_file(file) == pcapng_head()));
    writer.packet(SimTime{7}, Direction::to_board, "M27\r\n");
    CHECK((host::test::read_file(file) ==
           pcapng_head() + pcapng_packet(SimTime{5'000'007}, Direction::to_board, "M27\r\n")));
    CHECK(writer.packets() == 1);
}

TEST_CASE("a capture that cannot be written is refused with a sentence") {
    CHECK_THROWS_AS(PcapngWriter("/no/such/folder/x.pcapng", SimTime{0}, {}), link::HostError);
}

TEST_CASE("a full disk ends the capture at a whole packet, and says so once") {
    const host::test::TemporaryFolder folder;
    const std::string file = folder.file("x.pcapng");
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const std::size_t whole =
        pcapng_head().size() + 2 * pcapng_packet(SimTime{0}, Direction::to_board, "M27\r\n").size();
    const rlimit small{whole + 10, before.rlim_max};
    std::vector<std::string> said;
    PcapngWriter writer(file, SimTime{0}, [&](std::string_view text) { said.emplace_back(text); });
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    for (int i = 0; i < 5; ++i) {
        writer.packet(SimTime{i}, Direction::to_board, "M27\r\n");
    }
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);
    CHECK(writer.packets() == 2);
    REQUIRE(said.size() == 1);
    CHECK(said[0].find("after 2 packets") != std::string::npos);
    CHECK(host::test::read_file(file).size() == whole);
}

}  // namespace
}  // namespace fauxboard::record
