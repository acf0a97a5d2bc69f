#pragma once

// A piece of a file on its way to or from a ChiTu board: payload, its offset in the file (four bytes, little
// endian), the XOR of all those bytes, and 0x83. Source: the transfer protocol of the boards' network module,
// as CHITUBOX, Saturn-Sync, python-chitubox and photoNetLib speak it. Nothing here allocates.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace fauxboard::protocol {

inline constexpr std::size_t max_chunk_payload = 1280;
/// Bytes of a chunk beside its payload.
inline constexpr std::size_t chunk_frame_bytes = 6;
inline constexpr std::size_t max_chunk_bytes = max_chunk_payload + chunk_frame_bytes;

enum class ChunkFault : std::uint8_t {
    none,
    no_chunk,  ///< its last byte is not 0x83, or it has no payload, or too much
    checksum,
};

struct Chunk {
    ChunkFault fault = ChunkFault::no_chunk;
    std::uint32_t offset = 0;  ///< as it says; may be damaged unless `fault` is none
    std::string_view payload;  ///< into the datagram; at least one byte unless it is no chunk
};

/// Takes a datagram apart. One damaged bit anywhere is always found.
Chunk read_chunk(std::string_view datagram);

/// Writes a chunk to the start of `out` and returns its length; 0, and `out` left alone, when it does not fit
/// or the payload is longer than `max_chunk_payload`. A payload of no bytes can be written: it is what a
/// download ends with.
std::size_t write_chunk(std::span<char> out, std::uint32_t offset, std::string_view payload);

/// The offset that a board asks for again, in both its forms: "resend 3840", and with the offset that came in
/// front of it, "resend 1280,offset error:3840". Nothing when `answer` is no such request.
std::optional<std::uint32_t> resend_offset(std::string_view answer);

}  // namespace fauxboard::protocol
