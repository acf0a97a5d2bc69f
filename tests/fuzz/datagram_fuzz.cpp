// What senders on a network say to a resin board with a disk in memory.
//
// The input is a script, a step a line; its first byte says what it is:
//   1 2 3  this sender sends the rest of the line, as it stands
//   a b c  the same senders send a whole chunk that fits, of as many bytes as the number behind it says
//   A B C  the same, damaged: the number says which bit
//   t      so many ms pass
//   s      the rest of the line comes over the serial line
//   o i    the disk goes out, comes in
//   f      the disk is full from here on; a number: so many bytes more go onto it
//   n      the network goes bad: the number's last digit says how (see Network::spoil), the others how often

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "protocol/chitu_chunk.h"
#include "tests/fuzz/support.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::fuzz {
namespace {

using machine::SimTime;

constexpr std::string_view precious = "precious.ctb";
constexpr std::string_view first_content = "as it was";
constexpr std::size_t most_steps = 400;
constexpr std::size_t most_output = 8192;
constexpr SimTime longest = std::chrono::minutes(10);

class Network {
  public:
    Network() : board_(shipped_profile("elegoo-mars-pro"), services(), {true, 7, nullptr}) {
        disk_.put(std::string(precious), std::string(first_content));
        disk_.set_room(1'000'000);
        board_.power_on(now_);
    }
    void step(std::string_view line);
    void finish();

  private:
    machine::Services services() {
        machine::Services made;
        made.sd = &disk_;
        return made;
    }
    void datagram(std::uint64_t peer, std::string_view bytes);
    void chunk(std::uint64_t peer, std::uint64_t number, bool damaged);
    void pass(SimTime time);
    void spoil(std::uint64_t number);
    void watch(std::string_view request);

    testing::MemoryDisk disk_;
    board::Board board_;
    SimTime now_{0};
    std::string last_ = std::string(first_content);
    unsigned answers_ = 0;
    std::uint64_t position_ = 0;  ///< after the last datagram
};

void Network::pass(SimTime time) {
    now_ = std::min(now_ + time, longest);
    advance_to(board_, now_, 20'000, [](SimTime, std::string_view) {});
    board_.clear_output();
}

/// The file changes by M29, M30 and M8512 alone, whoever says them, and never to half of something.
void Network::watch(std::string_view request) {
    const std::string* const content = disk_.content(precious);
    const std::string now = content == nullptr ? std::string() : *content;
    if (now != last_) {
        // However they are written: "M029", "N1 M29*39".
        constexpr std::array<std::string_view, 3> numbers{"29", "30", "8512"};
        require(std::any_of(numbers.begin(), numbers.end(),
                            [&](std::string_view n) { return request.find(n) != std::string_view::npos; }),
                "a file changed before its upload was finished");
        last_ = now;
    }
    require(board_.machine().transfer.position() <= machine::Transfer::max_bytes, "a file beyond the bound");
}

void Network::datagram(std::uint64_t peer, std::string_view bytes) {
    board_.receive_datagram(now_, peer, bytes);
    position_ = board_.machine().transfer.position();  // before a restart that falls due meanwhile
    std::size_t size = 0;
    board_.take_datagrams([&](std::uint64_t to, std::string_view answer) {
        require(to == peer, "an answer to somebody who did not ask");
        require(!answer.empty() && answer.size() <= protocol::max_chunk_bytes,
                "an answer of a strange length");
        require(answer.back() == '\n' || board_.machine().transfer.trouble.damaged > 0 ||
                    protocol::read_chunk(answer).fault == protocol::ChunkFault::none,
                "an answer that is neither line nor block");
        size += answer.size();
        ++answers_;
    });
    require(size <= most_output, "too much is said at once");
    watch(bytes);
    pass(std::chrono::milliseconds(1));
}

void Network::chunk(std::uint64_t peer, std::uint64_t number, bool damaged) {
    std::array<char, protocol::max_chunk_bytes> room{};
    const std::string payload(damaged ? 64 : 1 + number % protocol::max_chunk_payload, 'x');
    const auto at = static_cast<std::uint32_t>(board_.machine().transfer.position());
    const std::size_t size = protocol::write_chunk(room, at, payload);
    if (damaged) {
        const std::size_t bit = number % (8 * size);
        room[bit / 8] = static_cast<char>(room[bit / 8] ^ 1 << bit % 8);
    }
    const bool owner = board_.machine().transfer.takes_from(peer);
    datagram(peer, {room.data(), size});
    require(!damaged || !owner || position_ == at, "a damaged chunk was written");
    require(position_ == at || position_ == at + payload.size(), "a chunk was written in part");
}

void Network::spoil(std::uint64_t number) {
    machine::Transfer::Trouble trouble;
    const std::array<double*, 4> kinds{&trouble.lost, &trouble.answers_lost, &trouble.damaged,
                                       &trouble.repeated};
    if (const std::uint64_t kind = number % 10; kind < kinds.size()) {
        *kinds[kind] = static_cast<double>(number / 10 % 101) / 100;
    }
    board_.machine().transfer.trouble = trouble;
}

void Network::step(std::string_view line) {
    if (line.empty()) {
        return;
    }
    const char what = line[0];
    const std::string_view rest = line.substr(1);
    std::uint64_t number = 0;
    std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (what >= '1' && what <= '3') {
        datagram(static_cast<std::uint64_t>(what - '0'), rest);
    } else if (what >= 'a' && what <= 'c') {
        chunk(static_cast<std::uint64_t>(what - 'a') + 1, number, false);
    } else if (what >= 'A' && what <= 'C') {
        chunk(static_cast<std::uint64_t>(what - 'A') + 1, number, true);
    } else if (what == 't') {
        pass(std::chrono::milliseconds(std::min<std::uint64_t>(number, 60'000)));
    } else if (what == 's') {
        board_.receive(now_, std::string(rest) + "\r\n");
        pass(std::chrono::milliseconds(20));
        watch(rest);
    } else if (what == 'o' || what == 'i') {
        board_.world(now_, what == 'o' ? "card out" : "card in");
    } else if (what == 'f') {
        disk_.set_room(std::min<std::uint64_t>(number, 1'000'000) + 1);
    } else if (what == 'n') {
        spoil(number);
    }
}

void Network::finish() {
    answers_ = 0;
    datagram(9, "M4002");
    require(answers_ == 1, "the board does not answer any more");
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard::fuzz;
    Network network;
    std::size_t steps = 0;
    for_each_line({reinterpret_cast<const char*>(data), size}, [&](std::string_view line) {
        if (++steps <= most_steps) {
            network.step(line);
        }
    });
    network.finish();
    return 0;
}
