#include "emulator/host/profile_watch.h"

#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "emulator/link/event_loop.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;
/// An editor saves in several steps.
constexpr std::chrono::milliseconds settling{100};
constexpr std::uint32_t changes = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE;

}  // namespace

class ProfileWatch::Impl {
  public:
    Impl(link::EventLoop& loop, std::function<void()> on_change)
        : on_change_(std::move(on_change)),
          changes_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
          watch_(loop, [this] { take(); }),
          settled_(loop, [this] { on_change_(); }) {
        if (changes_) {
            watch_.start(changes_.get());
        }
    }

    void watch(const std::vector<std::string>& files) {
        std::map<int, std::set<std::string>> wanted;
        for (const std::string& file : files) {
            std::error_code error;
            add(fs::absolute(file, error), wanted);
            add(fs::canonical(file, error), wanted);  // where a symlink leads
        }
        for (const auto& [id, names] : watches_) {
            if (!wanted.contains(id)) {
                ::inotify_rm_watch(changes_.get(), id);
            }
        }
        watches_ = std::move(wanted);
    }

    bool works() const { return !watches_.empty(); }

  private:
    void add(const fs::path& file, std::map<int, std::set<std::string>>& wanted) {
        if (!changes_ || !file.has_parent_path()) {
            return;
        }
        const int id = ::inotify_add_watch(changes_.get(), file.parent_path().c_str(), changes);
        if (id >= 0) {
            wanted[id].insert(file.filename().string());
        }
    }

    void take() {
        alignas(inotify_event) std::array<char, 4096> buffer;
        const ssize_t size = ::read(changes_.get(), buffer.data(), buffer.size());
        if (size <= 0) {
            watch_.drained();
        }
        for (ssize_t at = 0; at + static_cast<ssize_t>(sizeof(inotify_event)) <= size;) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            const char* name = buffer.data() + at + sizeof event;
            at += static_cast<ssize_t>(sizeof event + event.len);
            const auto watched = watches_.find(event.wd);
            // An overflow may have swallowed ours.
            if ((event.mask & IN_Q_OVERFLOW) != 0 ||
                (watched != watches_.end() && event.len != 0 && watched->second.contains(name))) {
                settled_.after(settling);
            }
        }
    }

    std::function<void()> on_change_;
    link::UniqueFd changes_;
    link::Watch watch_;
    link::Timer settled_;
    std::map<int, std::set<std::string>> watches_;  ///< names by the watch of their folder
};

ProfileWatch::ProfileWatch(link::EventLoop& loop, std::function<void()> on_change)
    : impl_(std::make_unique<Impl>(loop, std::move(on_change))) {}

ProfileWatch::~ProfileWatch() = default;

void ProfileWatch::watch(const std::vector<std::string>& files) {
    impl_->watch(files);
}

bool ProfileWatch::works() const {
    return impl_->works();
}

}  // namespace fauxboard::host
