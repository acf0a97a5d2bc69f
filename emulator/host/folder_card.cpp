#include "emulator/host/folder_card.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>

#include "emulator/link/host_error.h"

namespace fauxboard::host {
namespace {

using link::UniqueFd;
using machine::CardEntry;

constexpr int folder_flags = O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NONBLOCK;
/// Names read from one folder before it is called endless.
constexpr std::size_t max_names = 65536;

struct CloseFolder {
    void operator()(DIR* folder) const { ::closedir(folder); }
};

/// Whether a name may be one part of a path on the line.
bool usable_name(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && std::none_of(name.begin(), name.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7F || byte == '/';
    });
}

/// The kind and size of `name` in the open folder, itself and not what it points to; missing for all that is
/// neither file nor folder.
machine::Volume::Kind look_at(int folder, const std::string& name, std::uint64_t& bytes) {
    using Kind = machine::Volume::Kind;
    struct stat info {};
    if (::fstatat(folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) {
        return Kind::missing;
    }
    if (S_ISDIR(info.st_mode)) {
        return Kind::folder;
    }
    if (!S_ISREG(info.st_mode)) {
        return Kind::missing;
    }
    bytes = static_cast<std::uint64_t>(info.st_size);
    return ::faccessat(folder, name.c_str(), R_OK, AT_EACCESS) == 0 ? Kind::file : Kind::unreadable;
}

bool is_file(machine::Volume::Kind kind) {
    return kind == machine::Volume::Kind::file || kind == machine::Volume::Kind::unreadable;
}

/// As FAT packs date and time: years since 1980, month, day, hours, minutes, pairs of seconds.
std::uint32_t fat_stamp(std::int64_t local_s) {
    constexpr std::int64_t first_s = 315'532'800;   // 1980
    constexpr std::int64_t last_s = 4'354'819'198;  // the end of 2107
    const std::time_t time = std::clamp(local_s, first_s, last_s);
    std::tm parts{};
    ::gmtime_r(&time, &parts);
    const int packed_date = (parts.tm_year - 80) << 9 | (parts.tm_mon + 1) << 5 | parts.tm_mday;
    const int packed_time = parts.tm_hour << 11 | parts.tm_min << 5 | parts.tm_sec / 2;
    return static_cast<std::uint32_t>(packed_date) << 16 | static_cast<std::uint32_t>(packed_time);
}

/// When it was written last, seconds since 1970 in local time; 0 when that is not known.
std::int64_t modified_s(int folder, const std::string& name) {
    struct stat info {};
    std::tm local{};
    if (::fstatat(folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0 ||
        ::localtime_r(&info.st_mtime, &local) == nullptr) {
        return 0;
    }
    return info.st_mtime + local.tm_gmtoff;
}

std::vector<std::string> read_names(DIR* folder) {
    std::vector<std::string> names;
    while (const dirent* entry = names.size() < max_names ? ::readdir(folder) : nullptr) {
        const bool maybe = entry->d_type == DT_REG || entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN;
        if (maybe && usable_name(entry->d_name)) {
            names.emplace_back(entry->d_name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

FolderCard::FolderCard(std::string folder, std::string_view what) : root_(std::move(folder)) {
    if (!open_root()) {
        throw link::HostError(fmt::format("{} cannot be {} ({}). Name a folder that you may read.", root_,
                                          what, std::system_category().message(errno)));
    }
    // The program may change its current folder; the card stays where it is.
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(root_, error);
    if (!error) {
        root_ = absolute.string();
    }
}

UniqueFd FolderCard::open_root() const {
    return UniqueFd(::open(root_.c_str(), folder_flags));
}

UniqueFd FolderCard::open_folder(std::string_view path) const {
    UniqueFd fd = open_root();
    while (fd && !path.empty()) {
        const std::size_t slash = std::min(path.find('/'), path.size());
        const std::string part(path.substr(0, slash));
        path.remove_prefix(std::min(slash + 1, path.size()));
        if (!usable_name(part)) {
            return {};
        }
        // Part by part and O_NOFOLLOW: nobody who swaps a folder for a symlink meanwhile leads us outside.
        fd = UniqueFd(::openat(fd.get(), part.c_str(), folder_flags | O_NOFOLLOW));
    }
    return fd;
}

bool FolderCard::list(std::string_view folder, std::vector<CardEntry>& out) const {
    UniqueFd fd = open_folder(folder);
    // fdopendir() takes the descriptor over; ours stays for looking at the entries.
    const int copy = fd ? ::fcntl(fd.get(), F_DUPFD_CLOEXEC, 0) : -1;
    const std::unique_ptr<DIR, CloseFolder> stream(copy >= 0 ? ::fdopendir(copy) : nullptr);
    if (!stream) {
        if (copy >= 0) {
            ::close(copy);
        }
        return false;
    }
    std::vector<CardEntry> folders;
    std::size_t count = 0;
    for (std::string& name : read_names(stream.get())) {
        std::uint64_t bytes = 0;
        const Kind kind = count < max_entries ? look_at(fd.get(), name, bytes) : Kind::missing;
        if (kind != Kind::missing) {
            ++count;
            const std::int64_t modified = modified_s(fd.get(), name);
            (kind == Kind::folder ? folders : out)
                .push_back({std::move(name), kind == Kind::folder, bytes, fat_stamp(modified), {}, modified});
        }
    }
    std::move(folders.begin(), folders.end(), std::back_inserter(out));
    return true;
}

UniqueFd FolderCard::open_parent(std::string_view path, std::string& name) const {
    const std::size_t slash = path.rfind('/');
    name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    const bool empty_part = slash == 0 || (slash != std::string_view::npos && path[slash - 1] == '/');
    return usable_name(name) && !empty_part
               ? open_folder(slash == std::string_view::npos ? std::string_view{} : path.substr(0, slash))
               : UniqueFd{};
}

machine::Volume::Kind FolderCard::look(std::string_view path, std::uint64_t& bytes) const {
    bytes = 0;
    if (path.empty()) {
        return open_root() ? Kind::folder : Kind::missing;
    }
    std::string name;
    const UniqueFd folder = open_parent(path, name);
    return folder ? look_at(folder.get(), name, bytes) : Kind::missing;
}

UniqueFd FolderCard::open_file(std::string_view path, int flags) const {
    std::string name;
    const UniqueFd folder = open_parent(path, name);
    if (!folder) {
        return {};
    }
    // O_NONBLOCK: a pipe that took the file's place meanwhile must not keep us waiting.
    UniqueFd file(
        ::openat(folder.get(), name.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat info {};
    const bool regular = file && ::fstat(file.get(), &info) == 0 && S_ISREG(info.st_mode);
    return regular ? std::move(file) : UniqueFd{};
}

std::optional<std::size_t> FolderCard::read(std::string_view path, std::uint64_t offset,
                                            std::span<char> out) const {
    const UniqueFd file = open_file(path, O_RDONLY);
    if (!file || offset > static_cast<std::uint64_t>(std::numeric_limits<off_t>::max())) {
        return std::nullopt;
    }
    ssize_t got = -1;
    do {
        got = ::pread(file.get(), out.data(), out.size(), static_cast<off_t>(offset));
    } while (got < 0 && errno == EINTR);
    return got < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(got));
}

bool FolderCard::create(std::string_view path) {
    std::string name;
    const UniqueFd folder = open_parent(path, name);
    if (!folder) {
        return false;
    }
    // A file of that name goes first: emptying it would reach through a hard link to what is outside.
    constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    std::uint64_t bytes = 0;
    if (is_file(look_at(folder.get(), name, bytes)) && ::unlinkat(folder.get(), name.c_str(), 0) != 0) {
        return false;
    }
    return static_cast<bool>(UniqueFd(::openat(folder.get(), name.c_str(), flags, 0666)));
}

bool FolderCard::append(std::string_view path, std::uint64_t offset, std::string_view bytes) {
    const UniqueFd file = open_file(path, O_WRONLY);
    struct stat info {};
    if (!file || ::fstat(file.get(), &info) != 0 || static_cast<std::uint64_t>(info.st_size) != offset) {
        return false;
    }
    off_t at = info.st_size;
    while (!bytes.empty()) {
        const ssize_t put = ::pwrite(file.get(), bytes.data(), bytes.size(), at);
        if (put < 0 && errno == EINTR) {
            continue;
        }
        if (put <= 0) {
            // Full, mostly. What fitted of this piece goes again; were even that refused, the size would
            // tell.
            return ::ftruncate(file.get(), info.st_size) == 0 && false;
        }
        at += put;
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    return true;
}

bool FolderCard::rename(std::string_view from, std::string_view to) {
    std::string old_name;
    std::string new_name;
    const UniqueFd old_folder = open_parent(from, old_name);
    const UniqueFd new_folder = open_parent(to, new_name);
    std::uint64_t bytes = 0;
    if (!old_folder || !new_folder || !is_file(look_at(old_folder.get(), old_name, bytes))) {
        return false;
    }
    // What is in the file must be on the disk before it has its name: else a power cut of this computer could
    // leave the name with nothing, or half of it.
    const UniqueFd file = open_file(from, O_RDONLY);
    if (!file || ::fsync(file.get()) != 0) {
        return false;
    }
    // Something else of that name is not shown, and must stay.
    struct stat info {};
    const bool taken = ::fstatat(new_folder.get(), new_name.c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0;
    if ((taken && !S_ISREG(info.st_mode)) ||
        ::renameat(old_folder.get(), old_name.c_str(), new_folder.get(), new_name.c_str()) != 0) {
        return false;
    }
    ::fsync(new_folder.get());  // the name itself; some file systems refuse, and there is nothing to do then
    return true;
}

bool FolderCard::remove(std::string_view path) {
    std::string name;
    std::uint64_t bytes = 0;
    const UniqueFd folder = open_parent(path, name);
    return folder && is_file(look_at(folder.get(), name, bytes)) &&
           ::unlinkat(folder.get(), name.c_str(), 0) == 0;
}

}  // namespace fauxboard::host
