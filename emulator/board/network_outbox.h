#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::board {

/// Datagrams on their way out, and who is being answered.
class NetworkOutbox {
  public:
    /// Beyond this much untaken, requests are lost.
    static constexpr std::size_t limit = 64UL * 1024;

    /// What the board says from here on goes to `peer`; 0: to the line again.
    void answer(std::uint64_t peer) { peer_ = peer; }
    bool asking() const { return peer_ != 0; }
    bool full() const { return bytes_.size() >= limit; }

    std::uint64_t peer() const { return peer_; }

    /// A message for the one who asked: a datagram for each line, its end included, or one for it all. Calls
    /// told(bytes) for each.
    template <class Told>
    void add(std::string_view message, bool whole, Told&& told) {
        while (!message.empty()) {
            const std::size_t end =
                whole ? message.size() : std::min(message.find('\n'), message.size() - 1) + 1;
            entries_.push_back({peer_, end});
            bytes_ += message.substr(0, end);
            told(message.substr(0, end));
            message.remove_prefix(end);
        }
    }

    template <class Out>
    void take(Out&& out) {
        std::size_t begin = 0;
        for (const Entry& entry : entries_) {
            out(entry.peer, std::string_view(bytes_).substr(begin, entry.size));
            begin += entry.size;
        }
        clear();
    }
    void clear() {
        entries_.clear();
        bytes_.clear();
    }

  private:
    struct Entry {
        std::uint64_t peer;
        std::size_t size;
    };
    std::uint64_t peer_ = 0;
    std::string bytes_;
    std::vector<Entry> entries_;
};

}  // namespace fauxboard::board
