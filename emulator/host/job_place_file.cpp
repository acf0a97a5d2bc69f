#include "emulator/host/job_place_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <type_traits>
#include <utility>

#include "emulator/link/host_error.h"

namespace fauxboard::host {
namespace {

using machine::JobPlace;

constexpr std::uint64_t mark = 0x3145434C50424A46;  // "FJBPLCE1" in little endian, near enough
constexpr std::size_t longest_path = 512;

struct Head {
    std::uint64_t mark = 0;
    std::uint64_t sequence = 0;
    std::uint64_t size = 0;  ///< of the payload; 0: no place
    std::uint64_t checksum = 0;
};

/// The values of a place as they lie in the file; the path follows. This machine's byte order: the file does
/// not travel.
struct Values {
    std::uint64_t bytes, byte;
    std::int64_t elapsed_us;
    std::int32_t volume, layer, layers, part_fan_percent, speed_percent, flow_percent;
    std::array<double, 4> at;
    double nozzle_c, bed_c, unit_mm, feed_mm_s;
    std::array<double, 3> weights;
    std::uint8_t relative, relative_e;
    std::array<std::uint8_t, 6> nothing;
};
static_assert(std::is_trivially_copyable_v<Values>);
static_assert(sizeof(Head) + sizeof(Values) + longest_path <= JobPlaceFile::slot_bytes);

/// FNV-1a over words: against tearing, not against malice.
std::uint64_t checksum(std::uint64_t sequence, std::string_view bytes) {
    std::uint64_t hash = (0xCBF29CE484222325U ^ sequence) * 0x100000001B3U;
    for (const char c : bytes) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    }
    return hash;
}

/// Calls `pass(member, value)` for each member of a place and where it lies in the file: the one list for
/// both ways.
template <class Place, class Kept, class F>
void each_value(Place& place, Kept& v, F&& pass) {
    pass(place.bytes, v.bytes);
    pass(place.byte, v.byte);
    pass(place.volume, v.volume);
    pass(place.layer, v.layer);
    pass(place.layers, v.layers);
    pass(place.part_fan_percent, v.part_fan_percent);
    pass(place.speed_percent, v.speed_percent);
    pass(place.flow_percent, v.flow_percent);
    pass(place.at, v.at);
    pass(place.nozzle_c, v.nozzle_c);
    pass(place.bed_c, v.bed_c);
    pass(place.modal.unit_mm, v.unit_mm);
    pass(place.modal.feed_mm_s, v.feed_mm_s);
    pass(place.modal.weights, v.weights);
    pass(place.relative, v.relative);
    pass(place.relative_e, v.relative_e);
}

template <class T>
constexpr bool is_flag = std::is_same_v<std::remove_cvref_t<T>, bool>;

Values values_of(const JobPlace& place) {
    Values v{};
    v.elapsed_us = place.elapsed.count();
    each_value(place, v, [](const auto& from, auto& to) {
        if constexpr (is_flag<decltype(from)>) {
            to = from ? 1 : 0;
        } else {
            to = from;
        }
    });
    return v;
}

bool sane(const Values& v) {
    bool good = v.byte <= v.bytes && v.volume >= 0 && v.volume <= 1 && v.layer >= 0 && v.layers >= 0 &&
                v.elapsed_us >= 0;
    for (const double value : {v.at[0], v.at[1], v.at[2], v.at[3], v.nozzle_c, v.bed_c, v.unit_mm,
                               v.feed_mm_s, v.weights[0], v.weights[1], v.weights[2]}) {
        good = good && std::isfinite(value);
    }
    return good;
}

std::optional<JobPlace> place_of(std::string_view payload) {
    Values v{};
    if (payload.size() <= sizeof v) {
        return std::nullopt;
    }
    std::memcpy(&v, payload.data(), sizeof v);
    if (!sane(v)) {
        return std::nullopt;
    }
    JobPlace place;
    place.path = payload.substr(sizeof v);
    place.elapsed = machine::SimTime{v.elapsed_us};
    each_value(place, v, [](auto& to, const auto& from) {
        if constexpr (is_flag<decltype(to)>) {
            to = from != 0;
        } else {
            to = from;
        }
    });
    return place;
}

}  // namespace

JobPlaceFile::JobPlaceFile(std::string file, OnTrouble on_trouble)
    : file_(std::move(file)),
      on_trouble_(std::move(on_trouble)),
      fd_(::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0644)) {
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
}

std::optional<JobPlace> JobPlaceFile::load() {
    std::optional<JobPlace> newest;
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
        newest = place_of(payload);
    }
    return newest;
}

void JobPlaceFile::keep(const JobPlace& place) {
    if (place.path.size() > longest_path) {
        return drop();
    }
    std::array<char, slot_bytes> payload;
    const Values v = values_of(place);
    std::memcpy(payload.data(), &v, sizeof v);
    std::memcpy(payload.data() + sizeof v, place.path.data(), place.path.size());
    write({payload.data(), sizeof v + place.path.size()});
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
