#include "emulator/host/eeprom_cells_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "emulator/link/host_error.h"

namespace fauxboard::host {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw link::HostError(fmt::format("The EEPROM {} cannot be used: {}.", file, why));
}

std::string last_error() {
    return std::system_category().message(errno);
}

bool write_all(int fd, std::string_view bytes, off_t offset) {
    while (!bytes.empty()) {
        const ssize_t done = ::pwrite(fd, bytes.data(), bytes.size(), offset);
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done <= 0) {
            return false;
        }
        bytes.remove_prefix(static_cast<std::size_t>(done));
        offset += done;
    }
    return true;
}

}  // namespace

/// A fresh chip appears whole under its name, or not at all.
void EepromCellsFile::make() const {
    std::string name = file_ + ".XXXXXX";
    const link::UniqueFd fd(::mkostemp(name.data(), O_CLOEXEC));
    const std::string fresh(bytes_, '\xFF');
    // link() and not rename(): another board may have made its chip meanwhile, and that one stays.
    const bool good = fd && ::fchmod(fd.get(), 0644) == 0 && write_all(fd.get(), fresh, 0) &&
                      ::fsync(fd.get()) == 0 && (::link(name.c_str(), file_.c_str()) == 0 || errno == EEXIST);
    const std::string why = good ? std::string() : last_error();
    ::unlink(name.c_str());
    if (!good) {
        refuse(file_, why);
    }
}

EepromCellsFile::EepromCellsFile(std::string file, std::size_t bytes, OnTrouble on_trouble)
    : file_(std::move(file)), bytes_(bytes), on_trouble_(std::move(on_trouble)) {
    struct stat info {};
    if (::stat(file_.c_str(), &info) != 0 && errno == ENOENT) {
        make();
    }
    fd_ = link::UniqueFd(::open(file_.c_str(), O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (!fd_ || ::fstat(fd_.get(), &info) != 0) {
        refuse(file_, last_error());
    }
    if (!S_ISREG(info.st_mode) || info.st_size != static_cast<off_t>(bytes_)) {
        refuse(file_,
               fmt::format("the chip has {} bytes, and this {}", bytes_,
                           S_ISREG(info.st_mode) ? fmt::format("file {}", info.st_size) : "is no file"));
    }
    if (::flock(fd_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        refuse(file_, "it is in use by a board that runs, and each board needs an EEPROM of its own");
    }
    // The board would write its defaults over a chip that it cannot read.
    if (std::string probe(bytes_, '\0'); ::pread(fd_.get(), probe.data(), bytes_, 0) < 0) {
        refuse(file_, last_error());
    }
}

std::optional<std::string> EepromCellsFile::load() {
    std::string bytes(bytes_, '\0');
    const ssize_t got = ::pread(fd_.get(), bytes.data(), bytes.size(), 0);
    if (got == static_cast<ssize_t>(bytes.size())) {
        return bytes;
    }
    on_trouble_(
        fmt::format("the EEPROM {} cannot be read ({}); it counts as a fresh chip", file_, last_error()));
    return std::nullopt;
}

void EepromCellsFile::store(std::size_t address, std::string_view bytes) {
    if (write_all(fd_.get(), bytes, static_cast<off_t>(address))) {
        complained_ = false;
    } else if (!std::exchange(complained_, true)) {
        on_trouble_(fmt::format("the EEPROM {} could not be saved ({})", file_, last_error()));
    }
}

}  // namespace fauxboard::host
