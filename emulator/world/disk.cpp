#include "emulator/world/disk.h"

#include <algorithm>
#include <utility>

namespace fauxboard::world {

void Disk::put(const std::string& path, std::string content) {
    files_[path] = {std::move(content), true};
}

void Disk::power_cut(fault::Dice& dice) {
    for (auto at = files_.begin(); at != files_.end();) {
        File& file = at->second;
        if (!file.certain && dice.below(4) == 0) {
            at = files_.erase(at);
            continue;
        }
        if (!file.certain) {
            file.content.resize(dice.below(file.content.size() + 1));
            file.certain = true;
        }
        ++at;
    }
}

bool Disk::list(std::string_view folder, std::vector<machine::CardEntry>& out) const {
    if (!folder.empty() || trouble_ == Trouble::read_fails) {
        return false;
    }
    for (const auto& [path, file] : files_) {
        out.push_back({path, false, file.content.size()});
    }
    return true;
}

machine::Volume::Kind Disk::look(std::string_view path, std::uint64_t& bytes) const {
    if (path.empty()) {
        return Kind::folder;
    }
    const auto hit = files_.find(path);
    if (hit == files_.end()) {
        return Kind::missing;
    }
    bytes = hit->second.content.size();
    return trouble_ == Trouble::read_fails ? Kind::unreadable : Kind::file;
}

std::optional<std::size_t> Disk::read(std::string_view path, std::uint64_t offset,
                                      std::span<char> out) const {
    const auto hit = files_.find(path);
    if (hit == files_.end() || trouble_ == Trouble::read_fails) {
        return std::nullopt;
    }
    const std::string& content = hit->second.content;
    if (offset >= content.size()) {
        return 0;
    }
    const std::size_t size = content.copy(out.data(), out.size(), static_cast<std::size_t>(offset));
    bytes_read_ += size;
    return size;
}

std::uint64_t Disk::used() const {
    std::uint64_t sum = 0;
    for (const auto& [path, file] : files_) {
        sum += file.content.size();
    }
    return sum;
}

void Disk::judge_name(std::string_view path) {
    if (!path.ends_with("temp")) {
        named_too_early_ = path;
    }
}

bool Disk::create(std::string_view path) {
    judge_name(path);
    if (trouble_ == Trouble::write_fails || path.find('/') != std::string_view::npos ||
        files_.size() >= most_files) {
        return false;
    }
    files_[std::string(path)] = {{}, false};
    return true;
}

bool Disk::append(std::string_view path, std::uint64_t offset, std::string_view bytes) {
    judge_name(path);
    const auto hit = files_.find(path);
    const bool takes = trouble_ == Trouble::none || trouble_ == Trouble::read_fails;
    if (hit == files_.end() || !takes || hit->second.content.size() != offset ||
        used() + bytes.size() > room) {
        return false;
    }
    hit->second.content.append(bytes);
    hit->second.certain = false;
    return true;
}

bool Disk::rename(std::string_view from, std::string_view to) {
    const auto hit = files_.find(from);
    if (hit == files_.end() || trouble_ == Trouble::write_fails) {
        return false;
    }
    File file = std::move(hit->second);
    file.certain = true;
    files_.erase(hit);
    files_[std::string(to)] = std::move(file);
    return true;
}

bool Disk::remove(std::string_view path) {
    const auto hit = files_.find(path);
    if (hit == files_.end() || trouble_ == Trouble::write_fails) {
        return false;
    }
    files_.erase(hit);
    return true;
}

const std::string* Disk::content(std::string_view path) const {
    const auto hit = files_.find(path);
    return hit == files_.end() ? nullptr : &hit->second.content;
}

}  // namespace fauxboard::world
