// Chunks of a file: vectors worked out by hand, round trips, damage.

#include "protocol/chitu_chunk.h"

#include <doctest/doctest.h>

#include <array>
#include <random>
#include <string>

namespace fauxboard::protocol {
namespace {

using namespace std::string_view_literals;

std::string chunk_of(std::uint32_t offset, std::string_view payload) {
    std::array<char, max_chunk_bytes> room{};
    return {room.data(), write_chunk(room, offset, payload)};
}

std::string random_bytes(std::mt19937_64& random, std::size_t size) {
    std::string bytes(size, '\0');
    for (char& byte : bytes) {
        byte = static_cast<char>(random() & 0xFF);
    }
    return bytes;
}

TEST_CASE("chunk: vectors") {
    // 'A' ^ 'B' ^ 'C' = 0x40; offset 0x500: bytes 00 05 00 00, with them 0x45.
    CHECK(chunk_of(0x500, "ABC") == "ABC\x00\x05\x00\x00\x45\x83"sv);
    CHECK(chunk_of(0x12345678, "\x83") == "\x83\x78\x56\x34\x12\x8B\x83"sv);
    CHECK(chunk_of(0, "") == "\x00\x00\x00\x00\x00\x83"sv);

    const Chunk chunk = read_chunk("ABC\x00\x05\x00\x00\x45\x83"sv);
    CHECK(chunk.fault == ChunkFault::none);
    CHECK(chunk.offset == 0x500);
    CHECK(chunk.payload == "ABC");
    CHECK(read_chunk("\x83\x78\x56\x34\x12\x8B\x83"sv).offset == 0x12345678);
}

TEST_CASE("chunk: every length comes back, at every kind of offset") {
    std::mt19937_64 random(1);
    for (std::size_t size = 1; size <= max_chunk_payload; ++size) {
        CAPTURE(size);
        const std::string payload = random_bytes(random, size);
        const auto offset = static_cast<std::uint32_t>(random());
        const std::string bytes = chunk_of(offset, payload);
        REQUIRE(bytes.size() == size + chunk_frame_bytes);
        const Chunk chunk = read_chunk(bytes);
        CHECK(chunk.fault == ChunkFault::none);
        CHECK(chunk.offset == offset);
        CHECK(chunk.payload == payload);
    }
}

TEST_CASE("chunk: one damaged bit is always found, as is a lost or an added end") {
    std::mt19937_64 random(2);
    for (const std::size_t size : {1U, 2U, 7U, 64U, 1280U}) {
        const std::string bytes = chunk_of(static_cast<std::uint32_t>(random()), random_bytes(random, size));
        for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
            CAPTURE(bit);
            std::string damaged = bytes;
            damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
            const ChunkFault expected =
                bit / 8 + 1 == bytes.size() ? ChunkFault::no_chunk : ChunkFault::checksum;
            CHECK(read_chunk(damaged).fault == expected);
        }
    }
    CHECK(read_chunk("").fault == ChunkFault::no_chunk);
    CHECK(read_chunk("\x00\x00\x00\x00\x00\x83"sv).fault == ChunkFault::no_chunk);
    CHECK(read_chunk("M29").fault == ChunkFault::no_chunk);
    CHECK(read_chunk(std::string(max_chunk_bytes, '\x83')).fault != ChunkFault::no_chunk);
    CHECK(read_chunk(std::string(max_chunk_bytes + 1, '\x83')).fault == ChunkFault::no_chunk);
}

TEST_CASE("chunk: what does not fit is not written") {
    std::array<char, 9> room{};
    room.fill('x');
    CHECK(write_chunk(room, 0, "four") == 0);
    CHECK(room[0] == 'x');
    CHECK(write_chunk(room, 0, "abc") == 9);
    std::array<char, 2 * max_chunk_bytes> big{};
    CHECK(write_chunk(big, 0, std::string(max_chunk_payload + 1, 'a')) == 0);
}

TEST_CASE("chunk: what a board asks for again, in both forms") {
    CHECK(resend_offset("resend 3840\r\n") == 3840U);
    CHECK(resend_offset("resend 1280,offset error:2560\r\n") == 2560U);
    CHECK(resend_offset("resend 4294967295") == 0xFFFFFFFFU);
    CHECK_FALSE(resend_offset("resend 4294967296"));
    CHECK_FALSE(resend_offset("resend"));
    CHECK_FALSE(resend_offset("ok 3840"));
    CHECK_FALSE(resend_offset(""));
}

}  // namespace
}  // namespace fauxboard::protocol
