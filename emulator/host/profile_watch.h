#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fauxboard::link {
class EventLoop;
}

namespace fauxboard::host {

/// Hears of changes of a profile's files. The folders are watched, not the files, so that an editor that
/// writes a new file and renames it is heard, too.
class ProfileWatch {
  public:
    /// `on_change` is called from the event loop, 100 ms after the last of a series of changes. `loop`
    /// outlives this. Where the system has no watches left nothing is ever heard: works() says so.
    ProfileWatch(link::EventLoop& loop, std::function<void()> on_change);
    ~ProfileWatch();
    ProfileWatch(const ProfileWatch&) = delete;
    ProfileWatch& operator=(const ProfileWatch&) = delete;

    /// The files to hear of from now on, instead of those before.
    void watch(const std::vector<std::string>& files);
    bool works() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace fauxboard::host
