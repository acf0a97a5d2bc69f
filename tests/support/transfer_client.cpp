#include "tests/support/transfer_client.h"

#include <algorithm>
#include <array>

#include "protocol/chitu_chunk.h"

namespace fauxboard::testing {
namespace {

/// Without progress for so long, something is wrong with the board.
constexpr int most_tries = 100;

bool starts_ok(const std::string& answer) {
    return answer.starts_with("ok");
}

}  // namespace

std::string chunk(std::uint32_t offset, std::string_view payload) {
    std::array<char, protocol::max_chunk_bytes> room{};
    return {room.data(), protocol::write_chunk(room, offset, payload)};
}

std::string pattern(std::uint64_t at, std::size_t size) {
    std::string out(size, '\0');
    for (std::size_t i = 0; i < size; ++i) {
        out[i] = static_cast<char>(((at + i) * 2654435761U >> 11U) & 0xFF);
    }
    return out;
}

TransferClient::Luck TransferClient::draw() {
    if (static_cast<double>(random_() >> 11) >= trouble_.share * 0x1p53) {
        return Luck::good;
    }
    return static_cast<Luck>(1 + random_() % 4);
}

std::string TransferClient::damage(std::string bytes) {
    ++damaged;
    const std::uint64_t bit = random_() % (8 * bytes.size());
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    return bytes;
}

std::string TransferClient::ask(std::string_view request) {
    wire_.send(request);
    return wire_.receive();
}

/// The answer that the sender gets to see; empty for none.
std::string TransferClient::send_chunk(const std::string& chunk) {
    switch (draw()) {
        case Luck::request_lost:
            ++lost;
            return {};
        case Luck::answer_lost:
            ++lost;
            ask(chunk);
            return {};
        case Luck::damaged:
            return ask(damage(chunk));
        case Luck::repeated: {
            ++repeated;
            const std::string first = ask(chunk);
            ask(chunk);
            return first;
        }
        case Luck::good:
            break;
    }
    return ask(chunk);
}

std::string TransferClient::upload(const std::string& name, std::uint64_t size, const Content& content) {
    if (const std::string answer = ask("M28 " + name); !starts_ok(answer)) {
        return "M28: " + answer;
    }
    std::uint64_t at = 0;
    for (int tries = 0; at < size; ++tries) {
        if (tries == most_tries) {
            return "no progress at " + std::to_string(at);
        }
        const auto piece =
            static_cast<std::size_t>(std::min<std::uint64_t>(protocol::max_chunk_payload, size - at));
        const std::string answer = send_chunk(chunk(static_cast<std::uint32_t>(at), content(at, piece)));
        const std::uint64_t before = at;
        if (starts_ok(answer)) {
            at += piece;
        } else if (const auto again = protocol::resend_offset(answer)) {
            at = *again;
        } else if (!answer.empty()) {
            return "chunk at " + std::to_string(at) + ": " + answer;
        }
        tries = at > before ? -1 : tries;
    }
    const std::string received = ask("M4012 I1 T" + std::to_string(size));
    if (!received.starts_with("ok " + std::to_string(size))) {
        return "M4012: " + received;
    }
    std::string answer = ask("M29");
    if (!starts_ok(answer)) {
        answer += wire_.receive();  // a text, then the ok
    }
    return answer.find("ok") == std::string::npos ? "M29: " + answer : std::string();
}

std::string TransferClient::download(const std::string& name, std::uint64_t size,
                                     const std::function<void(std::string_view)>& take) {
    const std::string length = ask("M6032 '" + name + "'");
    if (!length.starts_with("ok L:" + std::to_string(size))) {
        return "M6032: " + length;
    }
    std::uint64_t at = 0;
    bool next = true;
    for (int tries = 0; at < size; ++tries) {
        if (tries == most_tries) {
            return "no progress at " + std::to_string(at);
        }
        std::string answer = ask(next ? "M3000" : "M3001 I" + std::to_string(at));
        const Luck luck = draw();
        if (luck == Luck::damaged && !answer.empty()) {
            answer = damage(answer);
        } else if (luck == Luck::request_lost || luck == Luck::answer_lost) {
            ++lost;
            answer.clear();
        }
        const protocol::Chunk chunk = protocol::read_chunk(answer);
        next = chunk.fault == protocol::ChunkFault::none && chunk.offset == at;
        if (next) {
            take(chunk.payload);
            at += chunk.payload.size();
            tries = -1;
        }
        if (luck == Luck::repeated) {
            ++repeated;
            next = false;  // whatever comes of it is not what follows
            ask("M3000");
        }
    }
    const std::string closed = ask("M22");
    return starts_ok(closed) ? std::string() : "M22: " + closed;
}

}  // namespace fauxboard::testing
