// A serial port, through libserialport.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <climits>
#include <filesystem>
#include <utility>

#include "emulator/link/reopening_link.h"
#include "emulator/link/serial_api.h"

namespace fauxboard::link {

namespace {

// libserialport looks a port up in the kernel's list by its file name, so a symlink such as
// /dev/serial/by-id/... has to be followed first.
std::string follow_symlinks(const std::string& device) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::canonical(device, error);
    return error ? device : real.string();
}

class SerialLink final : public ReopeningLink {
  public:
    SerialLink(EventLoop& loop, std::string device, unsigned baud, const SerialApi& api)
        : ReopeningLink(loop), device_(std::move(device)), baud_(baud), api_(api) {}
    ~SerialLink() override { close(); }

    std::string describe() const override { return fmt::format("serial port {} at {} baud", device_, baud_); }
    std::string kind() const override { return "serial"; }
    std::string path() const override { return device_; }

  private:
    void open_device() override;
    void release_device() override;
    std::string lost_sentence(const std::string& why) const override {
        return fmt::format("{} vanished ({}); waiting for it to come back", device_, why);
    }
    ssize_t read_some(int fd, char* data, std::size_t size) override;
    ssize_t write_some(int fd, const char* data, std::size_t size) override;

    void configure();
    /// Throws LinkError unless `result` says that it worked. `attempt`: "be opened", "be set to 8 data bits";
    /// `argument_error`: the error number that "invalid argument" stands for.
    void check(sp_return result, const std::string& attempt, int argument_error = EINVAL) const;
    /// The system's error number of a call that just failed; never one that means "try again".
    int last_error() const;

    std::string device_;
    unsigned baud_;
    SerialApi api_;
    sp_port* port_ = nullptr;
    bool port_open_ = false;
};

void SerialLink::open_device() {
    if (baud_ == 0 || baud_ > INT_MAX) throw LinkError(fmt::format("{} baud is not a speed.", baud_));
    check(api_.get_port_by_name(follow_symlinks(device_).c_str(), &port_), "be found", ENOENT);
    check(api_.open(port_, SP_MODE_READ_WRITE), "be opened");
    port_open_ = true;
    configure();
    int fd = -1;
    check(api_.get_port_handle(port_, &fd), "give its descriptor");
    // Two programs on one port would each get some of the bytes. Not every driver can forbid it: no error.
    (void)::ioctl(fd, TIOCEXCL);
    attach(fd);
    go_up(was_up() ? fmt::format("{} is back", device_)
                   : fmt::format("{} is open at {} baud", device_, baud_));
}

void SerialLink::configure() {
    check(api_.set_baudrate(port_, static_cast<int>(baud_)), fmt::format("be set to {} baud", baud_));
    check(api_.set_bits(port_, 8), "be set to 8 data bits");
    check(api_.set_parity(port_, SP_PARITY_NONE), "be set to no parity");
    check(api_.set_stopbits(port_, 1), "be set to 1 stop bit");
    check(api_.set_flowcontrol(port_, SP_FLOWCONTROL_NONE), "be set to no flow control");
    // What came in before the line was set up was read at another speed.
    check(api_.flush(port_, SP_BUF_BOTH), "be emptied");
}

void SerialLink::release_device() {
    if (port_ == nullptr) return;
    // A port that is gone may fail to close; there is nothing left to do about it.
    if (port_open_) (void)api_.close(port_);
    api_.free_port(port_);
    port_ = nullptr;
    port_open_ = false;
}

// libserialport returns 0 both for "nothing there" and for a port that is no longer there.
ssize_t SerialLink::read_some(int fd, char* data, std::size_t size) {
    const int count = api_.nonblocking_read(port_, data, size);
    if (count > 0) return count;
    if (count == 0) return nothing_read(fd);
    errno = last_error();
    return -1;
}

ssize_t SerialLink::write_some(int /*fd*/, const char* data, std::size_t size) {
    const int count = api_.nonblocking_write(port_, data, size);
    if (count >= 0) return count;
    errno = last_error();
    return -1;
}

int SerialLink::last_error() const {
    const int error = api_.last_error_code();
    return error > 0 && error != EAGAIN && error != EINTR ? error : EIO;
}

void SerialLink::check(sp_return result, const std::string& attempt, int argument_error) const {
    if (result == SP_OK) return;
    // Of a port that is being retried nobody reads the sentence, and making it asks the system for all ports.
    if (was_up()) throw LinkError("still gone");
    int error = 0;
    switch (result) {
        case SP_ERR_ARG:
            error = argument_error;
            break;
        case SP_ERR_MEM:
            error = ENOMEM;
            break;
        case SP_ERR_SUPP:
            error = ENOTSUP;
            break;
        default:
            error = last_error();
    }
    throw LinkError(explain_port_error(device_, attempt, error));
}

}  // namespace

std::unique_ptr<Link> make_serial_link(EventLoop& loop, std::string device, unsigned baud,
                                       const SerialApi& api) {
    return std::make_unique<SerialLink>(loop, std::move(device), baud, api);
}

}  // namespace fauxboard::link
