#include "emulator/host/job_place_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "emulator/host/eeprom_file.h"
#include "emulator/link/host_error.h"

namespace fauxboard::host {
namespace {

constexpr std::uint64_t mark = 0x3145434C50424A46;  // "FJBPLCE1" in little endian, near enough

struct Head {
    std::uint64_t mark = 0;
    std::uint64_t sequence = 0;
    std::uint64_t size = 0;  ///< of the payload; 0: no place
    std::uint64_t checksum = 0;
};

constexpr std::size_t longest = JobPlaceFile::slot_bytes - sizeof(Head);

/// FNV-1a over words: against tearing, not against malice.
std::uint64_t checksum(std::uint64_t sequence, std::string_view bytes) {
    std::uint64_t hash = (0xCBF29CE484222325U ^ sequence) * 0x100000001B3U;
    for (const char c : bytes) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    }
    return hash;
}

}  // namespace

std::string JobPlaceFile::beside(const std::string& eeprom) {
    return EepromFile::real_path(eeprom) + ".job";
}

JobPlaceFile::JobPlaceFile(std::string file, OnTrouble on_trouble)
    : file_(std::move(file)),
      on_trouble_(std::move(on_trouble)),
      fd_(::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0600)) {
    struct stat what {};
    if (!fd_ || ::fstat(fd_.get(), &what) != 0) {
        throw link::HostError(
            fmt::format("{}, where the place of a print is kept, cannot be written ({}): its folder "
                        "must exist and be writable.",
                        file_, std::system_category().message(errno)));
    }
    if (!S_ISREG(what.st_mode)) {
        throw link::HostError(
            fmt::format("{} cannot hold the place of a print: it is no plain file.", file_));
    }
    claim();
}

void JobPlaceFile::claim() const {
    if (::flock(fd_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        throw link::HostError(
            fmt::format("{} is in use by a board that runs. Each board needs an EEPROM of its own.", file_));
    }
    if (!is_ours()) {
        throw link::HostError(fmt::format(
            "{} cannot hold the place of a print: what is in it is not fauxboard's. Move it away, "
            "or give the EEPROM another name.",
            file_));
    }
}

/// Whether a slot has our mark, or nothing is there yet. A slot may be torn, even at its mark.
bool JobPlaceFile::is_ours() const {
    std::array<char, 2 * slot_bytes + 1> all{};
    const ssize_t got = ::pread(fd_.get(), all.data(), all.size(), 0);
    const auto has_mark = [&all](std::size_t at) {
        Head head;
        std::memcpy(&head, all.data() + at, sizeof head);
        return head.mark == mark;
    };
    const bool empty = std::all_of(all.begin(), all.end(), [](char c) { return c == 0; });
    return got >= 0 && got <= static_cast<ssize_t>(2 * slot_bytes) &&
           (empty || has_mark(0) || has_mark(slot_bytes));
}

std::optional<std::string> JobPlaceFile::load() {
    std::optional<std::string> newest;
    for (int i = 0; i < 2; ++i) {
        std::array<char, slot_bytes> slot{};
        const ssize_t got = ::pread(fd_.get(), slot.data(), slot.size(), i * static_cast<off_t>(slot_bytes));
        Head head;
        if (got < static_cast<ssize_t>(sizeof head)) {
            continue;
        }
        std::memcpy(&head, slot.data(), sizeof head);
        if (head.mark != mark || head.size > static_cast<std::uint64_t>(got) - sizeof head ||
            head.sequence < sequence_) {
            continue;
        }
        const std::string_view payload(slot.data() + sizeof head, static_cast<std::size_t>(head.size));
        if (head.checksum != checksum(head.sequence, payload)) {
            continue;
        }
        sequence_ = head.sequence;
        newest = payload.empty() ? std::nullopt : std::optional<std::string>(payload);
    }
    return newest;
}

void JobPlaceFile::keep(std::string_view place) {
    write(place.substr(0, place.size() <= longest ? place.size() : 0));
}

void JobPlaceFile::drop() {
    write({});
}

void JobPlaceFile::write(std::string_view payload) {
    ++sequence_;
    std::array<char, slot_bytes> slot;
    const Head head{mark, sequence_, payload.size(), checksum(sequence_, payload)};
    std::memcpy(slot.data(), &head, sizeof head);
    payload.copy(slot.data() + sizeof head, payload.size());
    const std::size_t size = sizeof head + payload.size();
    const auto offset = static_cast<off_t>(sequence_ % 2 * slot_bytes);
    if (::pwrite(fd_.get(), slot.data(), size, offset) != static_cast<ssize_t>(size) && !complained_) {
        complained_ = true;
        on_trouble_(fmt::format("the place of the print cannot be kept in {} ({})", file_,
                                std::system_category().message(errno)));
    }
}

}  // namespace fauxboard::host
