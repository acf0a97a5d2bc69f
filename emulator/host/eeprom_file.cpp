#include "emulator/host/eeprom_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "emulator/link/host_error.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;
using link::UniqueFd;

constexpr std::string_view first_line = "fauxboard eeprom 1\n";
constexpr std::string_view last_line = "checksum ";
constexpr std::size_t last_line_bytes = last_line.size() + 16 + 1;
/// So that no file of the user's is taken for one that a killed program left.
constexpr std::string_view temporary_mark = ".fauxboard-new-";

/// FNV-1a, 64 bits: against tearing and editing, not against malice.
std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char c : bytes) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    }
    return hash;
}

std::string error_text(int error) {
    return std::system_category().message(error);
}

/// Both 0 or an errno.
int write_all(int fd, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(fd, text.data(), text.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return count < 0 ? errno : EIO;
        }
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

int read_all(int fd, std::string& text) {
    std::array<char, 4096> buffer;
    while (text.size() <= EepromFile::max_bytes) {
        const ssize_t count = ::read(fd, buffer.data(), buffer.size());
        if (count < 0 && errno != EINTR) {
            return errno;
        }
        if (count == 0) {
            return 0;
        }
        text.append(buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    }
    return 0;
}

/// Whether it begins as our files do, or with nothing, as a power cut may leave one.
bool may_be_ours(int fd) {
    constexpr std::string_view mark = first_line.substr(0, first_line.size() - 2);  // of any version
    std::array<char, first_line.size()> begin{};
    const ssize_t got = ::pread(fd, begin.data(), begin.size(), 0);
    const std::string_view text(begin.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return mark.starts_with(text) || text.starts_with(mark) ||
           text.find_first_not_of('\0') == std::string_view::npos;
}

}  // namespace

std::string eeprom_text(std::string_view image) {
    std::string text(first_line);
    text += image;
    if (!text.ends_with('\n')) {
        text += '\n';
    }
    return text + fmt::format("{}{:016x}\n", last_line, checksum(text));
}

std::optional<std::string> eeprom_image(std::string_view text) {
    if (text.size() < first_line.size() + last_line_bytes || !text.starts_with(first_line)) {
        return std::nullopt;
    }
    const std::string_view kept = text.substr(0, text.size() - last_line_bytes);
    if (text.substr(kept.size()) != fmt::format("{}{:016x}\n", last_line, checksum(kept))) {
        return std::nullopt;
    }
    return std::string(kept.substr(first_line.size()));
}

std::string EepromFile::real_path(const std::string& file) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
    return error ? file : real.string();
}

EepromFile::EepromFile(const std::string& file, OnTrouble on_trouble)
    : file_(real_path(file)), on_trouble_(std::move(on_trouble)) {
    std::error_code error;
    folder_ = fs::path(file_).parent_path().string();
    const fs::file_status status = fs::status(file_, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw link::HostError(fmt::format("{} cannot hold the EEPROM: it is no plain file.", file_));
    }
    const UniqueFd fd(::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!fd && errno != ENOENT) {
        throw link::HostError(fmt::format("The EEPROM {} cannot be read ({}).", file_, error_text(errno)));
    }
    if (fd && !may_be_ours(fd.get())) {
        throw link::HostError(
            fmt::format("{} cannot hold the EEPROM: what is in it is not fauxboard's. Move it away, or name "
                        "another file.",
                        file_));
    }
    sweep();
    std::string name;
    if (const int failure = write_new(name, {}); failure != 0) {
        throw link::HostError(
            fmt::format("The EEPROM {} cannot be written ({}): its folder must exist and be "
                        "writable.",
                        file_, error_text(failure)));
    }
    ::unlink(name.c_str());
}

/// Takes away what a program killed while saving has left.
void EepromFile::sweep() const {
    const std::string start = fs::path(file_).filename().string() + std::string(temporary_mark);
    std::error_code error;
    for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (name.starts_with(start) && name.size() == start.size() + 6) {
            std::error_code ignored;
            fs::remove(at->path(), ignored);
        }
    }
}

/// Writes a new file beside ours, on the disk for certain. 0 or an errno; `name` is the file's.
int EepromFile::write_new(std::string& name, std::string_view text) const {
    name = file_ + std::string(temporary_mark) + "XXXXXX";
    const UniqueFd fd(::mkostemp(name.data(), O_CLOEXEC));
    if (!fd) {
        return errno;
    }
    struct stat old {};
    const mode_t mode =
        ::stat(file_.c_str(), &old) == 0 ? old.st_mode & 0777U : mode_t{0600};  // a password may be in it
    int failure = ::fchmod(fd.get(), mode) == 0 ? 0 : errno;
    if (failure == 0) {
        failure = write_all(fd.get(), text);
    }
    if (failure == 0 && ::fsync(fd.get()) != 0) {
        failure = errno;
    }
    if (failure != 0) {
        ::unlink(name.c_str());
    }
    return failure;
}

std::optional<std::string> EepromFile::load() {
    std::string text;
    {
        const UniqueFd fd(::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
        if (!fd && errno == ENOENT) {
            return std::nullopt;
        }
        const int failure = fd ? read_all(fd.get(), text) : errno;
        if (failure != 0) {
            on_trouble_(fmt::format("the EEPROM {} cannot be read ({}); the defaults are used", file_,
                                    error_text(failure)));
            return std::nullopt;
        }
    }
    auto image = eeprom_image(text);
    if (!image) {
        put_aside(text.starts_with(first_line) ? "its checksum is wrong" : "it does not start as an EEPROM");
    }
    return image;
}

void EepromFile::put_aside(std::string_view why) {
    std::string name = file_ + ".broken";
    std::error_code error;
    for (int i = 2; fs::exists(fs::symlink_status(name, error)) && i < 1000; ++i) {
        name = fmt::format("{}.broken.{}", file_, i);
    }
    fs::rename(file_, name, error);
    on_trouble_(fmt::format("the EEPROM {} is broken ({}); it {} {}, and the defaults are used", file_, why,
                            error ? "could not be renamed to" : "is now called", name));
}

bool EepromFile::save(std::string_view image) {
    std::string name;
    int failure = write_new(name, eeprom_text(image));
    if (failure == 0 && ::rename(name.c_str(), file_.c_str()) != 0) {
        failure = errno;
        ::unlink(name.c_str());
    }
    if (failure == 0) {
        // The rename itself must be on the disk, too. Some file systems refuse; there is nothing to do then.
        const UniqueFd folder(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (folder) {
            ::fsync(folder.get());
        }
        return true;
    }
    on_trouble_(fmt::format("the EEPROM {} could not be saved ({}); the file is as it was", file_,
                            error_text(failure)));
    return false;
}

}  // namespace fauxboard::host
