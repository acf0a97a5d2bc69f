#include "protocol/chitu_chunk.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "protocol/framing.h"

namespace fauxboard::protocol {
namespace {

constexpr char chunk_mark = '\x83';

}  // namespace

Chunk read_chunk(std::string_view datagram) {
    if (datagram.size() <= chunk_frame_bytes || datagram.size() > max_chunk_bytes ||
        datagram.back() != chunk_mark) {
        return {};
    }
    const std::size_t size = datagram.size() - chunk_frame_bytes;
    Chunk chunk;
    chunk.payload = datagram.substr(0, size);
    for (std::size_t i = 4; i-- > 0;) {
        chunk.offset = chunk.offset << 8 | static_cast<unsigned char>(datagram[size + i]);
    }
    // All bytes and their XOR have the XOR 0.
    chunk.fault = xor_checksum(datagram.substr(0, size + 5)) == 0 ? ChunkFault::none : ChunkFault::checksum;
    return chunk;
}

std::size_t write_chunk(std::span<char> out, std::uint32_t offset, std::string_view payload) {
    const std::size_t size = payload.size() + chunk_frame_bytes;
    if (payload.size() > max_chunk_payload || out.size() < size) {
        return 0;
    }
    char* const end = std::copy(payload.begin(), payload.end(), out.data());
    for (std::size_t i = 0; i < 4; ++i) {
        end[i] = static_cast<char>(offset >> (8 * i) & 0xFF);
    }
    end[4] = static_cast<char>(xor_checksum({out.data(), payload.size() + 4}));
    end[5] = chunk_mark;
    return size;
}

std::optional<std::uint32_t> resend_offset(std::string_view answer) {
    const std::size_t last = answer.find_last_of("0123456789");
    if (!answer.starts_with("resend") || last == std::string_view::npos) {
        return std::nullopt;
    }
    const std::size_t first = answer.find_last_not_of("0123456789", last) + 1;
    std::uint32_t offset = 0;
    const auto [end, error] = std::from_chars(answer.data() + first, answer.data() + last + 1, offset);
    return error == std::errc{} ? std::optional(offset) : std::nullopt;
}

}  // namespace fauxboard::protocol
