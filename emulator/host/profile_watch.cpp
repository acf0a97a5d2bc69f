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
    Impl(asio::io_context& context, std::function<void()> on_change)
        : on_change_(std::move(on_change)), descriptor_(context), timer_(context) {
        const int fd = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
        if (fd >= 0) {
            descriptor_.assign(fd);
            wait();
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
                ::inotify_rm_watch(descriptor_.native_handle(), id);
            }
        }
        watches_ = std::move(wanted);
    }

    bool works() const { return !watches_.empty(); }

  private:
    void add(const fs::path& file, std::map<int, std::set<std::string>>& wanted) {
        if (!descriptor_.is_open() || !file.has_parent_path()) {
            return;
        }
        const int id = ::inotify_add_watch(descriptor_.native_handle(), file.parent_path().c_str(), changes);
        if (id >= 0) {
            wanted[id].insert(file.filename().string());
        }
    }

    void wait() {
        descriptor_.async_wait(asio::posix::stream_descriptor::wait_read,
                               [this](const asio::error_code& error) {
                                   if (!error) {
                                       take();
                                       wait();
                                   }
                               });
    }

    void take() {
        alignas(inotify_event) std::array<char, 4096> buffer;
        const ssize_t size = ::read(descriptor_.native_handle(), buffer.data(), buffer.size());
        for (ssize_t at = 0; at + static_cast<ssize_t>(sizeof(inotify_event)) <= size;) {
            inotify_event event{};
            std::memcpy(&event, buffer.data() + at, sizeof event);
            const char* name = buffer.data() + at + sizeof event;
            at += static_cast<ssize_t>(sizeof event + event.len);
            const auto watched = watches_.find(event.wd);
            // An overflow may have swallowed ours.
            if ((event.mask & IN_Q_OVERFLOW) != 0 ||
                (watched != watches_.end() && event.len != 0 && watched->second.contains(name))) {
                start_settling();
            }
        }
    }

    void start_settling() {
        timer_.expires_after(settling);
        timer_.async_wait([this](const asio::error_code& error) {
            if (!error) {
                on_change_();
            }
        });
    }

    std::function<void()> on_change_;
    asio::posix::stream_descriptor descriptor_;
    asio::steady_timer timer_;
    std::map<int, std::set<std::string>> watches_;  ///< names by the watch of their folder
};

ProfileWatch::ProfileWatch(asio::io_context& context, std::function<void()> on_change)
    : impl_(std::make_unique<Impl>(context, std::move(on_change))) {}

ProfileWatch::~ProfileWatch() = default;

void ProfileWatch::watch(const std::vector<std::string>& files) {
    impl_->watch(files);
}

bool ProfileWatch::works() const {
    return impl_->works();
}

}  // namespace fauxboard::host
