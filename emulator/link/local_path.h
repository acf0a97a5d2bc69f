#pragma once

#include <sys/types.h>

#include <string>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// A Unix socket's name in the file system, for this user only, removed when this ends.
class LocalPath {
  public:
    LocalPath() = default;
    ~LocalPath() { remove(); }
    LocalPath(const LocalPath&) = delete;
    LocalPath& operator=(const LocalPath&) = delete;

    /// A listening socket (not blocking) at `path`, of mode 0600 from its first moment. A socket that a dead
    /// program left there is replaced. Throws LinkError: somebody listens there, something else is there, no
    /// permission, the name is too long for a socket.
    UniqueFd listen(const std::string& path);
    /// Idempotent. What somebody else put in its place meanwhile stays; for that to be known, the listening
    /// descriptor must still be open.
    void remove() noexcept;

  private:
    std::string path_;
    dev_t device_ = 0;
    ino_t inode_ = 0;
};

/// Connects to such a socket. Throws LinkError when nobody listens there.
UniqueFd connect_local(const std::string& path);

}  // namespace fauxboard::link
