#pragma once

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {

/// The client's end of a serial line, byte for byte.
class RawPeer {
  public:
    explicit RawPeer(const std::string& path) : fd_(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
        REQUIRE(fd_.get() >= 0);
        termios settings{};
        REQUIRE(tcgetattr(fd_.get(), &settings) == 0);
        cfmakeraw(&settings);
        REQUIRE(tcsetattr(fd_.get(), TCSANOW, &settings) == 0);
    }
    void set_speed(speed_t speed) const {
        termios settings{};
        REQUIRE(tcgetattr(fd_.get(), &settings) == 0);
        REQUIRE(cfsetspeed(&settings, speed) == 0);
        REQUIRE(tcsetattr(fd_.get(), TCSANOW, &settings) == 0);
    }
    void say(std::string_view bytes) const {
        REQUIRE(write(fd_.get(), bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    }
    /// All that comes up to `mark`, which is taken off.
    std::string until(const std::string& mark) {
        std::array<char, 4096> some{};
        while (true) {
            const std::size_t at = come_.find(mark);
            if (at != std::string::npos) {
                const std::string before = come_.substr(0, at);
                come_.erase(0, at + mark.size());
                return before;
            }
            pollfd wait{fd_.get(), POLLIN, 0};
            if (poll(&wait, 1, patience_ms) != 1) {
                return come_ + "(silence)";
            }
            const ssize_t count = read(fd_.get(), some.data(), some.size());
            if (count > 0) {
                come_.append(some.data(), static_cast<std::size_t>(count));
            }
        }
    }

  private:
    UniqueFd fd_;
    std::string come_;
};

}  // namespace fauxboard::e2e
