#include "emulator/link/link_name.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <random>
#include <system_error>

#include "emulator/link/link.h"

namespace fauxboard::link {

namespace {

constexpr int attempts = 100;

/// Where the symlink `name` points to; "" if it is not a symlink.
std::string read_target(const std::string& name) {
    std::array<char, PATH_MAX> buffer{};
    const ssize_t size = ::readlink(name.c_str(), buffer.data(), buffer.size());
    return size < 0 ? std::string() : std::string(buffer.data(), static_cast<std::size_t>(size));
}

[[noreturn]] void refuse(const std::string& name, const std::string& target, int error) {
    throw LinkError(fmt::format("The link {} to {} cannot be made: {}.", name, target,
                                std::system_category().message(error)));
}

/// Puts a new symlink in the place of a stale one, in one step.
void replace(const std::string& name, const std::string& target) {
    std::random_device random;
    for (int i = 0; i < attempts; ++i) {
        const std::string temporary = fmt::format("{}.{:08x}", name, random());
        if (::symlink(target.c_str(), temporary.c_str()) != 0) {
            if (errno == EEXIST) continue;
            refuse(name, target, errno);
        }
        if (::rename(temporary.c_str(), name.c_str()) == 0) return;
        const int error = errno;
        ::unlink(temporary.c_str());
        refuse(name, target, error);
    }
    refuse(name, target, EEXIST);
}

}  // namespace

void LinkName::create(const std::string& name, const std::string& target) {
    remove();
    if (::symlink(target.c_str(), name.c_str()) != 0) {
        if (errno != EEXIST) refuse(name, target, errno);
        const std::string old_target = read_target(name);
        if (old_target.empty()) {
            throw LinkError(fmt::format("{} exists and is not a symlink; choose another name.", name));
        }
        struct stat unused {};
        if (old_target != target && ::stat(name.c_str(), &unused) == 0) {
            throw LinkError(
                fmt::format("{} points to {}, which exists: somebody may be using it. Remove the link, "
                            "or choose another name.",
                            name, old_target));
        }
        if (old_target != target) replace(name, target);
    }
    name_ = name;
    target_ = target;
}

void LinkName::remove() noexcept {
    if (name_.empty()) return;
    if (read_target(name_) == target_) ::unlink(name_.c_str());
    name_.clear();
}

}  // namespace fauxboard::link
