#pragma once

// Internal to emulator/link.

#include <string>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// Hears of a file's being opened and closed, by inotify. The kernel joins equal events that follow each
/// other, so the count is a hint that the owner corrects where it knows better.
class PeerWatch {
  public:
    struct Seen {
        bool anything = false;
        bool opened = false;    ///< at least once
        bool reopened = false;  ///< ... when the count said that nobody was there
    };

    /// False where the system has no (more) watches.
    bool start(const std::string& path);
    void stop() { fd_.reset(); }
    int fd() const { return fd_.get(); }

    /// Takes in what has happened; at most one read.
    Seen take();
    void set_count(int count) { count_ = count; }
    int count() const { return count_; }

  private:
    UniqueFd fd_;
    int count_ = 0;
};

}  // namespace fauxboard::link
