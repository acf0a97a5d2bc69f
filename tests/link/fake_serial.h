#pragma once

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>

#include "emulator/link/serial_api.h"
#include "helpers.h"

namespace fauxboard::link::test {

/// A serial port behind libserialport's functions: the slave of a pseudo-terminal, whose master is the
/// device. The `fail_at`-th call fails. One at a time, since the library's functions have no place for an
/// object.
class FakeSerial {
  public:
    FakeSerial() {
        current() = this;
        plug_in();
    }
    ~FakeSerial() { current() = nullptr; }
    FakeSerial(const FakeSerial&) = delete;
    FakeSerial& operator=(const FakeSerial&) = delete;

    int fail_at = 0;  ///< 0: none
    int fail_with = EIO;
    int calls = 0;
    int opens = 0;
    int ports = 0;  ///< got and not yet freed
    std::optional<OtherPty> device;

    void plug_in() { device.emplace(); }
    void pull_out() { device.reset(); }
    bool slave_open() const { return static_cast<bool>(slave_); }
    bool failed() const { return fail_at != 0 && calls >= fail_at; }

    static SerialApi api() {
        SerialApi api;
        api.get_port_by_name = [](const char*, sp_port** port) {
            if (current()->fails()) return SP_ERR_ARG;
            if (!current()->device) return SP_ERR_ARG;
            ++current()->ports;
            *port = reinterpret_cast<sp_port*>(current());
            return SP_OK;
        };
        api.free_port = [](sp_port*) { --current()->ports; };
        api.open = [](sp_port*, sp_mode) { return current()->open(); };
        api.close = [](sp_port*) { return current()->close(); };
        api.set_baudrate = [](sp_port*, int) { return current()->plain(); };
        api.set_bits = [](sp_port*, int) { return current()->plain(); };
        api.set_parity = [](sp_port*, sp_parity) { return current()->plain(); };
        api.set_stopbits = [](sp_port*, int) { return current()->plain(); };
        api.set_flowcontrol = [](sp_port*, sp_flowcontrol) { return current()->plain(); };
        api.flush = [](sp_port*, sp_buffer) { return current()->plain(); };
        api.get_port_handle = [](const sp_port*, void* result) {
            const int fd = current()->slave_.get();
            std::memcpy(result, &fd, sizeof fd);
            return current()->plain();
        };
        api.nonblocking_read = [](sp_port*, void* data, std::size_t size) {
            if (current()->fails()) return SP_ERR_FAIL;
            const ssize_t count = ::read(current()->slave_.get(), data, size);
            // As the library: nothing there is 0.
            return static_cast<sp_return>(count < 0 && errno == EAGAIN ? 0 : count);
        };
        api.nonblocking_write = [](sp_port*, const void* data, std::size_t size) {
            if (current()->fails()) return SP_ERR_FAIL;
            return static_cast<sp_return>(::write(current()->slave_.get(), data, size));
        };
        api.last_error_code = [] { return current()->fail_with; };
        return api;
    }

  private:
    static FakeSerial*& current() {
        static FakeSerial* instance = nullptr;
        return instance;
    }

    bool fails() { return ++calls == fail_at; }
    sp_return plain() { return fails() ? SP_ERR_FAIL : SP_OK; }
    sp_return open() {
        if (fails()) return SP_ERR_FAIL;
        ++opens;
        slave_ = open_terminal(device->path);
        return SP_OK;
    }
    // As the library: the descriptor is closed even when that is an error.
    sp_return close() {
        slave_.reset();
        return plain();
    }

    UniqueFd slave_;
};

}  // namespace fauxboard::link::test
