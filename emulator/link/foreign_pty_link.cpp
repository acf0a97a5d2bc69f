#include "emulator/link/foreign_pty_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "emulator/link/reopening_link.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

namespace {

class ForeignPtyLink final : public ReopeningLink {
  public:
    ForeignPtyLink(EventLoop& loop, std::string device, unsigned baud)
        : ReopeningLink(loop), device_(std::move(device)), baud_(baud) {}
    ~ForeignPtyLink() override { close(); }

    std::string describe() const override { return fmt::format("pseudo-terminal {}", device_); }
    std::string kind() const override { return "pty"; }
    std::string path() const override { return device_; }

  private:
    void open_device() override;
    void release_device() override { fd_.reset(); }
    std::string lost_sentence(const std::string& why) const override {
        return fmt::format("{} vanished ({}); waiting for it to come back", device_, why);
    }
    ssize_t read_some(int fd, char* data, std::size_t size) override;
    void make_raw() const;

    std::string device_;
    unsigned baud_;
    UniqueFd fd_;
};

void ForeignPtyLink::open_device() {
    // O_NOCTTY: a hangup of the line must not end this process.
    fd_.reset(::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!fd_) {
        const int error = errno;
        throw LinkError(
            fmt::format("{} cannot be opened: {}. Whoever makes this pseudo-terminal must run first, "
                        "as the same user.",
                        device_, error_text(error)));
    }
    make_raw();
    attach(fd_.get());
    go_up(was_up() ? fmt::format("{} is back", device_) : fmt::format("{} is open", device_));
}

void ForeignPtyLink::make_raw() const {
    termios settings{};
    if (::tcgetattr(fd_.get(), &settings) != 0) {
        throw LinkError(fmt::format("{} is not a terminal: {}.", device_, error_text(errno)));
    }
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    // Speeds without a constant are fine on a line that has no speed.
    (void)::cfsetspeed(&settings, baud_);
    // TCSANOW: what the other side has said already is ours to read.
    if (::tcsetattr(fd_.get(), TCSANOW, &settings) != 0) {
        throw LinkError(fmt::format("{} cannot be set to raw: {}.", device_, error_text(errno)));
    }
}

// VMIN may have been changed under us by another opener; then 0 may also mean "nothing there", or "an empty
// line".
ssize_t ForeignPtyLink::read_some(int fd, char* data, std::size_t size) {
    const ssize_t count = ::read(fd, data, size);
    return count != 0 ? count : nothing_read(fd);
}

}  // namespace

bool is_pty_path(const std::string& device) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(device, error);
    std::filesystem::path target = error ? std::filesystem::path(device) : real;
    if (std::filesystem::is_symlink(target, error)) target = std::filesystem::read_symlink(target, error);
    return target.string().starts_with("/dev/pts/");
}

std::unique_ptr<Link> make_foreign_pty_link(EventLoop& loop, std::string device, unsigned baud) {
    return std::make_unique<ForeignPtyLink>(loop, std::move(device), baud);
}

}  // namespace fauxboard::link
