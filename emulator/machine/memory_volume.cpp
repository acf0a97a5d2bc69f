#include "emulator/machine/memory_volume.h"

#include <utility>

namespace fauxboard::machine {
namespace {

std::string_view folder_of(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? std::string_view{} : path.substr(0, slash);
}

std::string_view name_of(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

}  // namespace

void MemoryVolume::take_in(const std::vector<BuiltInEntry>& entries, const std::string& folder) {
    for (const BuiltInEntry& entry : entries) {
        const std::string path = folder.empty() ? entry.name : folder + "/" + entry.name;
        if (entry.folder) {
            folders_.insert(path);
            take_in(entry.entries, path);
        } else {
            used_ += entry.content.size();
            files_[path] = entry.content;
        }
    }
}

bool MemoryVolume::list(std::string_view folder, std::vector<CardEntry>& out) const {
    if (!folder.empty() && !folders_.contains(folder)) {
        return false;
    }
    for (const auto& [path, content] : files_) {
        if (folder_of(path) == folder) {
            out.push_back({std::string(name_of(path)), false, content.size()});
        }
    }
    for (const std::string& path : folders_) {
        if (folder_of(path) == folder) {
            out.push_back({std::string(name_of(path)), true, 0});
        }
    }
    return true;
}

Volume::Kind MemoryVolume::look(std::string_view path, std::uint64_t& bytes) const {
    if (const auto hit = files_.find(path); hit != files_.end()) {
        bytes = hit->second.size();
        return Kind::file;
    }
    return folders_.contains(path) ? Kind::folder : Kind::missing;
}

std::optional<std::size_t> MemoryVolume::read(std::string_view path, std::uint64_t offset,
                                              std::span<char> out) const {
    const auto hit = files_.find(path);
    if (hit == files_.end()) {
        return std::nullopt;
    }
    if (offset >= hit->second.size()) {
        return 0;
    }
    return hit->second.copy(out.data(), out.size(), static_cast<std::size_t>(offset));
}

bool MemoryVolume::may_be_file(std::string_view path) const {
    const std::string_view folder = folder_of(path);
    return !path.empty() && !folders_.contains(path) && (folder.empty() || folders_.contains(folder));
}

bool MemoryVolume::create(std::string_view path) {
    const auto hit = files_.find(path);
    if (!may_be_file(path) || (hit == files_.end() && files_.size() >= most_files)) {
        return false;
    }
    if (hit != files_.end()) {
        used_ -= hit->second.size();
        hit->second.clear();
    } else {
        files_.emplace(path, std::string());
    }
    return true;
}

bool MemoryVolume::append(std::string_view path, std::uint64_t offset, std::string_view bytes) {
    const auto hit = files_.find(path);
    if (hit == files_.end() || offset != hit->second.size() || used_ > room || bytes.size() > room - used_) {
        return false;
    }
    hit->second += bytes;
    used_ += bytes.size();
    return true;
}

bool MemoryVolume::rename(std::string_view from, std::string_view to) {
    const auto source = files_.find(from);
    if (source == files_.end() || !may_be_file(to)) {
        return false;
    }
    if (from == to) {
        return true;
    }
    std::string content = std::move(source->second);
    files_.erase(source);
    if (const auto old = files_.find(to); old != files_.end()) {
        used_ -= old->second.size();
        old->second = std::move(content);
    } else {
        files_.emplace(to, std::move(content));
    }
    return true;
}

bool MemoryVolume::remove(std::string_view path) {
    const auto hit = files_.find(path);
    if (hit == files_.end()) {
        return false;
    }
    used_ -= hit->second.size();
    files_.erase(hit);
    return true;
}

}  // namespace fauxboard::machine
