#include "emulator/machine/storage.h"

#include <algorithm>
#include <utility>

#include "emulator/machine/card_names.h"
#include "emulator/machine/short_names.h"

namespace fauxboard::machine {
namespace {

constexpr std::size_t max_path_bytes = 255;
constexpr std::string_view way_back = "Main";

std::string_view last_part(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

std::string_view parent(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? std::string_view{} : path.substr(0, slash);
}

std::string_view without_volume(std::string_view name) {
    const std::size_t colon = name.find(':');
    // "SD1:", "SD:", "UDISK:": a short word before a colon names the disk, not a folder.
    if (colon != std::string_view::npos && colon <= 5 && name.find('/') > colon) {
        return name.substr(colon + 1);
    }
    return name;
}

/// Spells each part of the path as the disk does. False when it holds no such file or folder.
bool respell(const Volume& volume, const Storage::Naming& naming, std::string& path) {
    std::string out;
    std::vector<CardEntry> entries;
    for (std::size_t at = 0; at <= path.size();) {
        const std::size_t slash = std::min(path.find('/', at), path.size());
        const std::string_view part = std::string_view(path).substr(at, slash - at);
        at = slash + 1;
        entries.clear();
        volume.list(out, entries);
        const std::vector<std::string> shorts =
            naming.short_names ? short_names(entries) : std::vector<std::string>{};
        std::size_t hit = 0;
        while (hit < entries.size() && !((!shorts.empty() && same_letters(shorts[hit], part)) ||
                                         (naming.long_names && same_letters(entries[hit].name, part)))) {
            ++hit;
        }
        if (hit == entries.size()) {
            return false;
        }
        out += (out.empty() ? "" : "/") + entries[hit].name;
    }
    path = std::move(out);
    return true;
}

/// What a disk with short names calls the last part of a path.
std::string short_name_of(const Volume& volume, std::string_view path) {
    const std::size_t slash = path.rfind('/');
    std::vector<CardEntry> entries;
    volume.list(slash == std::string_view::npos ? std::string_view{} : path.substr(0, slash), entries);
    const std::vector<std::string> names = short_names(entries);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i].name == path.substr(slash + 1)) {
            return names[i];
        }
    }
    return {};
}

bool quote(char c) {
    return c == '\'' || c == '"';
}

/// What of a disk's entries a board shows, in its order and under its names.
void arrange(std::vector<CardEntry>& entries, const CardConfig& config) {
    const std::vector<std::string> names = short_names(entries);
    std::vector<CardEntry> shown;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        CardEntry& entry = entries[i];
        const auto holds = [&name = names[i]](const std::string& word) {
            return name.find(word) != std::string::npos;
        };
        if ((entry.folder && !config.folders) ||
            (!config.only.empty() && std::none_of(config.only.begin(), config.only.end(), holds))) {
            continue;
        }
        if (config.name_bytes != 0 && entry.name.size() > config.name_bytes) {
            entry.file = std::exchange(entry.name, names[i]);
        }
        shown.push_back(std::move(entry));
    }
    if (config.newest_first) {
        std::stable_sort(shown.begin(), shown.end(),
                         [](const CardEntry& a, const CardEntry& b) { return a.modified_s > b.modified_s; });
    }
    entries = std::move(shown);
}

}  // namespace

const CardConfig Storage::plain_card;

bool clean_path(std::string_view folder, std::string_view name, std::string& out) {
    if (name.size() > max_path_bytes) {
        return false;
    }
    const std::string_view rest = without_volume(name);
    const bool absolute = rest.size() != name.size() || rest.starts_with('/');
    out.assign(absolute ? std::string_view{} : folder);
    std::size_t at = 0;
    while (at <= rest.size()) {
        const std::size_t slash = std::min(rest.find('/', at), rest.size());
        const std::string_view part = rest.substr(at, slash - at);
        at = slash + 1;
        if (part.empty() || part == ".") {
            continue;
        }
        const bool control = std::any_of(part.begin(), part.end(),
                                         [](char c) { return static_cast<unsigned char>(c) < 0x20; });
        if (part == ".." || control || out.size() + part.size() + 1 > max_path_bytes) {
            return false;
        }
        if (!out.empty()) {
            out += '/';
        }
        out += part;
    }
    return true;
}

void Storage::attach(int disk, Volume* volume) {
    volumes_[index(disk)] = volume;
    states_[index(disk)] = volume != nullptr ? DiskState::ok : DiskState::removed;
    if (disk == chosen_) {
        folder_.clear();
    }
}

void Storage::mount(int disk) {
    if (states_[index(disk)] == DiskState::removed) {
        attach(disk, volumes_[index(disk)]);
    }
}

void Storage::release(int disk) {
    if (states_[index(disk)] == DiskState::ok) {
        states_[index(disk)] = DiskState::removed;
    }
}

bool Storage::choose(int disk) {
    if (disk != 0 && disk != 1) {
        return false;
    }
    chosen_ = disk;
    folder_.clear();
    return true;
}

bool Storage::enter(std::string_view name) {
    const std::string_view bare = without_volume(name);
    const std::string_view plain = bare.starts_with('/') ? bare.substr(1) : bare;
    if (!folder_.empty() && plain.size() == way_back.size() + 1 + last_part(folder_).size() &&
        plain.starts_with(way_back) && last_part(plain) == last_part(folder_)) {
        folder_ = std::string(parent(folder_));
        return true;
    }
    std::string path;
    std::uint64_t bytes = 0;
    if (!usable(chosen_) || !clean_path(folder_, name, path)) {
        return false;
    }
    if (!path.empty() && volumes_[index(chosen_)]->look(path, bytes) != Volume::Kind::folder) {
        return false;
    }
    folder_ = path;
    return true;
}

void Storage::listing(std::vector<CardEntry>& out, unsigned limit) const {
    out.clear();
    if (!usable(chosen_)) {
        return;
    }
    volumes_[index(chosen_)]->list(folder_, out);  // a folder that vanished meanwhile shows nothing
    arrange(out, *config_);
    if (config_->way_back && !folder_.empty()) {
        out.insert(out.begin(), {std::string(way_back) + "/" + std::string(last_part(folder_)), true, 0});
    }
    if (out.size() > limit) {
        out.resize(limit);
    }
}

void Storage::files(std::vector<CardEntry>& out, std::size_t limit) const {
    out.clear();
    if (usable(chosen_)) {
        std::size_t folders_left = 1000;
        add_files({}, {}, limit, folders_left, out);
    }
}

void Storage::add_files(const std::string& folder, const std::string& shown, std::size_t limit,
                        std::size_t& folders_left, std::vector<CardEntry>& out) const {
    std::vector<CardEntry> entries;
    volumes_[index(chosen_)]->list(folder, entries);
    const std::vector<std::string> shorts =
        naming_.short_names ? short_names(entries) : std::vector<std::string>{};
    for (std::size_t i = 0; i < entries.size() && out.size() < limit; ++i) {
        CardEntry& entry = entries[i];
        std::string path = folder.empty() ? entry.name : folder + "/" + entry.name;
        const std::string& name = shorts.empty() ? entry.name : shorts[i];
        std::string listed = shown.empty() ? name : shown + "/" + name;
        if (path.size() > max_path_bytes || (!entry.folder && !shorts.empty() && !is_printable(name))) {
            continue;
        }
        if (!entry.folder) {
            entry.name = std::move(listed);
            entry.long_name = std::move(path);
            out.push_back(std::move(entry));
        } else if (folders_left > 0) {
            --folders_left;
            add_files(path, listed, limit, folders_left, out);
        }
    }
}

std::string Storage::long_path(std::string_view name) const {
    std::string path;
    const bool there = usable(chosen_) && clean_path({}, name, path) && !path.empty() &&
                       respell(*volumes_[index(chosen_)], naming_, path);
    return there ? "/" + path : std::string();
}

Volume::Kind Storage::look(int disk, std::string_view path) const {
    std::uint64_t bytes = 0;
    const Volume::Kind kind = usable(disk) ? volumes_[index(disk)]->look(path, bytes) : Volume::Kind::missing;
    return kind == Volume::Kind::file ? file_trouble_ : kind;
}

Storage::Found Storage::find(std::string_view name) const {
    Found found;
    if (!usable(chosen_)) {
        return found;
    }
    if (config_->by_list) {
        return find_listed(name);
    }
    const Volume& volume = *volumes_[index(chosen_)];
    const auto look = [&](std::string_view candidate) {
        std::string path;
        if (candidate.empty() || !clean_path(folder_, candidate, path) || path.empty()) {
            return false;
        }
        const bool as_spelled = !naming_.short_names || naming_.long_names;
        found.kind = as_spelled ? volume.look(path, found.bytes) : Volume::Kind::missing;
        if (found.kind == Volume::Kind::missing && naming_.ignore_case && respell(volume, naming_, path)) {
            found.kind = volume.look(path, found.bytes);
        }
        found.kind = found.kind == Volume::Kind::file ? file_trouble_ : found.kind;
        found.shown = naming_.short_names ? short_name_of(volume, path) : std::string();
        found.path = std::move(path);
        return found.kind != Volume::Kind::missing;
    };
    if (look(name)) {
        return found;
    }
    const std::size_t mark = name.find_last_of("* ");
    if (mark != std::string_view::npos &&
        name.find_first_not_of("0123456789", mark + 1) == std::string_view::npos) {
        look(name.substr(0, mark));
    }
    return found;
}

/// By what the list shows, as a board does that has nothing but its list.
Storage::Found Storage::find_listed(std::string_view name) const {
    Found found;
    if (name.starts_with(' ')) {
        name.remove_prefix(1);  // the one that parts it from its code
    }
    if (!config_->name_ends.empty()) {
        name = cut_name(name, config_->name_ends);
        found.kind = name.empty() ? Volume::Kind::unreadable : Volume::Kind::missing;
    }
    std::vector<CardEntry> entries;
    listing(entries, config_->max_listed);
    for (const CardEntry& entry : entries) {
        if (!entry.folder && !name.empty() && same_letters(entry.name, name)) {
            found.kind = file_trouble_;
            found.path = entry.file.empty() ? entry.name : entry.file;
            found.shown = entry.name;
            found.bytes = entry.bytes;
            break;
        }
    }
    return found;
}

const BuiltInEntry* BuiltInVolume::find(std::string_view path) const {
    const std::vector<BuiltInEntry>* level = &root_;
    while (true) {
        const std::size_t slash = path.find('/');
        const std::string_view part = path.substr(0, slash);
        const auto hit =
            std::find_if(level->begin(), level->end(), [&](const BuiltInEntry& e) { return e.name == part; });
        if (hit == level->end() || slash == std::string_view::npos) {
            return hit == level->end() ? nullptr : &*hit;
        }
        level = &hit->entries;
        path.remove_prefix(slash + 1);
    }
}

bool BuiltInVolume::list(std::string_view folder, std::vector<CardEntry>& out) const {
    const std::vector<BuiltInEntry>* level = &root_;
    if (!folder.empty()) {
        const BuiltInEntry* entry = find(folder);
        if (entry == nullptr || !entry->folder) {
            return false;
        }
        level = &entry->entries;
    }
    for (const BuiltInEntry& e : *level) {
        out.push_back({e.name, e.folder, e.content.size()});
    }
    return true;
}

Volume::Kind BuiltInVolume::look(std::string_view path, std::uint64_t& bytes) const {
    const BuiltInEntry* entry = find(path);
    if (entry == nullptr) {
        return Kind::missing;
    }
    bytes = entry->content.size();
    return entry->folder ? Kind::folder : Kind::file;
}

std::optional<std::size_t> BuiltInVolume::read(std::string_view path, std::uint64_t offset,
                                               std::span<char> out) const {
    const BuiltInEntry* entry = find(path);
    if (entry == nullptr || entry->folder) {
        return std::nullopt;
    }
    if (offset >= entry->content.size()) {
        return 0;
    }
    return entry->content.copy(out.data(), out.size(), static_cast<std::size_t>(offset));
}

bool Storage::path_for_writing(std::string_view name, std::string& path) const {
    std::uint64_t bytes = 0;
    if (!usable(chosen_) || name.ends_with('/') || !clean_path({}, name, path) || path.empty()) {
        return false;
    }
    if (naming_.short_names && !naming_.long_names && !is_short_name(last_part(path))) {
        return false;
    }
    const Volume& volume = *volumes_[index(chosen_)];
    if (std::string folder(parent(path));
        naming_.ignore_case && !folder.empty() && respell(volume, naming_, folder)) {
        path = folder + "/" + std::string(last_part(path));
    }
    const Volume::Kind kind = volume.look(path, bytes);
    return kind == Volume::Kind::missing || kind == Volume::Kind::file;
}

std::string unfinished_path(const Volume& disk, const std::string& path) {
    std::uint64_t bytes = 0;
    const bool is_free = disk.look(path + ".temp", bytes) == Volume::Kind::missing;
    return path + (is_free ? ".temp" : ".fauxboard-temp");
}

bool Storage::write(std::string_view name, std::string_view bytes) {
    std::string path;
    Volume* const disk = writable(chosen_);
    if (disk == nullptr || !path_for_writing(name, path)) {
        return false;
    }
    const std::string beside = unfinished_path(*disk, path);
    return disk->create(beside) && disk->append(beside, 0, bytes) && disk->rename(beside, path);
}

bool Storage::remove(std::string_view name) {
    const Found found = find(name);
    Volume* const disk = writable(chosen_);
    return found.kind == Volume::Kind::file && disk != nullptr && disk->remove(found.path);
}

std::string_view bare_name(std::string_view name) {
    const auto strip = [&](auto&& unwanted) {
        while (!name.empty() && unwanted(name.front())) {
            name.remove_prefix(1);
        }
    };
    strip([](char c) { return c == ' ' || c == ':'; });
    if (!name.empty() && quote(name.front())) {
        const char mark = name.front();
        name.remove_prefix(1);
        name = name.substr(0, name.rfind(mark));  // the last one: a name may hold one
    }
    strip([](char c) { return c == ':'; });
    while (name.ends_with(' ')) {
        name.remove_suffix(1);
    }
    return name;
}

}  // namespace fauxboard::machine
