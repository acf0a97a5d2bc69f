#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/link/event_loop.h"
#include "emulator/link/link.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::link::test {

/// Remembers all it is told.
struct Recorder : LinkListener {
    std::string bytes;
    std::size_t most_at_once = 0;
    std::vector<std::pair<LinkState, std::string>> states;
    std::function<void(std::string_view)> then;  ///< called last

    void on_bytes(std::string_view more) override {
        bytes += more;
        most_at_once = std::max(most_at_once, more.size());
        if (then) then(more);
    }
    void on_state(LinkState state, std::string_view why) override {
        states.emplace_back(state, std::string(why));
    }

    std::string last_why() const { return states.empty() ? std::string() : states.back().second; }
    /// "wu": waiting, then up.
    std::string state_letters() const {
        std::string letters;
        for (const auto& entry : states)
            letters += entry.first == LinkState::up ? 'u' : 'w';
        return letters;
    }
};

/// Runs the loop until `condition` holds. The bound is only there so that a broken test ends.
inline bool run_until(EventLoop& loop, const std::function<bool()>& condition) {
    for (int i = 0; i < 2000; ++i) {
        if (condition()) return true;
        loop.run_one_for(std::chrono::milliseconds(10));
    }
    return false;
}

/// Runs what is ready, and nothing that would have to be waited for.
inline void run_ready(EventLoop& loop) {
    loop.poll();
}

/// What the descriptor (non-blocking) holds now, up to `limit` bytes.
inline std::string take(int fd, std::size_t limit = std::string::npos) {
    std::string taken;
    std::array<char, 4096> buffer;
    while (taken.size() < limit) {
        const ssize_t count = ::read(fd, buffer.data(), std::min(buffer.size(), limit - taken.size()));
        if (count <= 0) break;
        taken.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return taken;
}

inline void say(int fd, std::string_view text) {
    REQUIRE(::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
}

inline UniqueFd open_terminal(const std::string& path) {
    UniqueFd fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    REQUIRE(fd);
    return fd;
}

/// A pseudo-terminal made by "somebody else".
struct OtherPty {
    UniqueFd master;
    std::string path;

    OtherPty() : master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
        std::array<char, 128> name{};
        REQUIRE(master);
        REQUIRE(::grantpt(master.get()) == 0);
        REQUIRE(::unlockpt(master.get()) == 0);
        REQUIRE(::ptsname_r(master.get(), name.data(), name.size()) == 0);
        path = name.data();
        termios settings{};
        REQUIRE(::tcgetattr(master.get(), &settings) == 0);
        ::cfmakeraw(&settings);
        REQUIRE(::tcsetattr(master.get(), TCSANOW, &settings) == 0);
    }
};

/// A new folder, removed with all that is in it.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "fauxboard-link-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

/// The sentence of the LinkError that `action` throws; "" if it throws none.
inline std::string link_error(const std::function<void()>& action) {
    try {
        action();
    } catch (const LinkError& error) {
        return error.what();
    }
    return {};
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace fauxboard::link::test
