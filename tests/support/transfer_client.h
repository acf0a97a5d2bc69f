#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <string_view>

namespace fauxboard::testing {

/// A piece of a file as it goes over the network.
std::string chunk(std::uint32_t offset, std::string_view payload);
/// The bytes from `at` on of a file without end in which hardly two places are alike.
std::string pattern(std::uint64_t at, std::size_t size);

/// Sends files to a ChiTu board and fetches them, datagram by datagram, as the slicers' clients do: one
/// chunk, one answer. What it sends and hears is lost, damaged or repeated by chance on the way, the same for
/// the same seed.
class TransferClient {
  public:
    struct Wire {
        std::function<void(std::string_view datagram)> send;
        std::function<std::string()> receive;  ///< the next answer; empty when none comes
    };
    struct Trouble {
        double share = 0;  ///< of chunks and of their answers
        std::uint64_t seed = 1;
    };
    /// Gives the file's bytes from `offset` on, `size` of them.
    using Content = std::function<std::string(std::uint64_t offset, std::size_t size)>;

    TransferClient(Wire wire, Trouble trouble)
        : wire_(std::move(wire)), trouble_(trouble), random_(trouble.seed) {}

    /// A request and its first answer.
    std::string ask(std::string_view request);
    /// M28, all chunks, M4012, M29. Empty, or what went wrong.
    std::string upload(const std::string& name, std::uint64_t size, const Content& content);
    /// M6032, M3000 and M3001 until `size` bytes are there, M22; each block is handed to `take`.
    std::string download(const std::string& name, std::uint64_t size,
                         const std::function<void(std::string_view)>& take);

    std::uint64_t lost = 0;
    std::uint64_t damaged = 0;
    std::uint64_t repeated = 0;

  private:
    enum class Luck : std::uint8_t { good, request_lost, answer_lost, damaged, repeated };
    Luck draw();
    std::string damage(std::string bytes);
    std::string send_chunk(const std::string& chunk);

    Wire wire_;
    Trouble trouble_;
    std::mt19937_64 random_;
};

}  // namespace fauxboard::testing
