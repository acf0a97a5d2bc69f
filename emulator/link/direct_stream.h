#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// A wire whose other end is written to, asked, and answers, while the caller waits, for a moment at most.
/// Not for tested lines, and not on the event loop: for parts of a machine that somebody else plays.
class DirectStream {
  public:
    virtual ~DirectStream() = default;
    DirectStream(const DirectStream&) = delete;
    DirectStream& operator=(const DirectStream&) = delete;

    /// Whether somebody is at the other end. Who waits is taken.
    virtual bool up() = 0;
    /// Sends all of it. False when nobody is there, or takes it: then it is lost, as a whole or its rest
    /// follows before the next. Waits `limit` for somebody who stops reading, once.
    bool write(std::string_view bytes, std::chrono::milliseconds limit);
    /// What has come, up to the size of `out`; waits `limit` for the first byte. 0: nothing.
    std::size_t read(std::span<char> out, std::chrono::milliseconds limit);

    virtual std::string kind() const = 0;  ///< "pty" | "tcp"
    virtual std::string path() const = 0;  ///< "/dev/pts/5", "127.0.0.1:4000"

  protected:
    DirectStream() = default;
    /// Of who is there; -1: nobody.
    virtual int fd() const = 0;
    /// The one who was there is gone.
    virtual void lost() = 0;
    /// As ::write and ::read.
    virtual long write_some(const char* data, std::size_t size) = 0;
    virtual long read_some(char* data, std::size_t size) = 0;
    /// Nothing is left of what was meant for somebody who is gone.
    void forget() {
        rest_.clear();
        stalled_ = false;
    }

  private:
    std::size_t send(std::string_view bytes, std::chrono::milliseconds limit);

    std::string rest_;      ///< of a message that was sent in part
    bool stalled_ = false;  ///< the other end does not read
};

/// A pseudo-terminal of our own. `link_name`: a symlink to it, gone with this; "" for none. Throws LinkError.
std::unique_ptr<DirectStream> make_direct_pty(const std::string& link_name);
/// Listens for one client at a time, on "HOST:PORT" and the like; port 0 takes a free one. Throws LinkError.
std::unique_ptr<DirectStream> make_direct_tcp(const std::string& host_port);

}  // namespace fauxboard::link
