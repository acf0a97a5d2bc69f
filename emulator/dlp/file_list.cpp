#include "emulator/dlp/file_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

namespace fauxboard::dlp {
namespace {

struct Ending {
    std::string_view text;
    FileKind kind;
};
constexpr std::array<Ending, 7> endings{{{".pws", FileKind::print},
                                         {".photon", FileKind::print},
                                         {".cbddlp", FileKind::print},
                                         {".photons", FileKind::print},
                                         {".ctb", FileKind::print},
                                         {".acfg", FileKind::settings},
                                         {".cimg", FileKind::image}}};

std::optional<FileKind> kind_of(const StickEntry& entry, bool ctb) {
    if (entry.folder) {
        return FileKind::folder;
    }
    for (const Ending& ending : endings) {
        if (entry.name.ends_with(ending.text) && (ctb || ending.text != ".ctb")) {
            return ending.kind;
        }
    }
    return std::nullopt;
}

}  // namespace

std::string_view to_string(FileKind kind) {
    constexpr std::array<std::string_view, 4> names{"folder", "print", "settings", "image"};
    return names[static_cast<std::size_t>(kind)];
}

void FileList::refresh() {
    read();
    shown_ = "/" + folder_;
}

void FileList::read() {
    files_.clear();
    std::vector<StickEntry> entries;
    if (!stick_.present() || !stick_.list(folder_, entries)) {
        const bool lost = !folder_.empty();
        folder_.clear();
        entries.clear();
        if (!lost || !stick_.present() || !stick_.list(folder_, entries)) {
            return;
        }
    }
    for (StickEntry& entry : entries) {
        const auto kind = kind_of(entry, ctb_);
        if (kind && files_.size() < most_files) {
            std::string date = date_text(entry.modified_s);
            files_.push_back({std::move(entry), *kind, std::move(date)});
        }
    }
}

void FileList::home() {
    folder_.clear();
    refresh();
}

bool FileList::enter(std::string_view name) {
    const ListedFile* const found = find(name);
    if (found == nullptr || found->kind != FileKind::folder) {
        return false;
    }
    folder_ += std::string(name) + "/";
    refresh();
    return true;
}

bool FileList::up() {
    if (folder_.empty()) {
        return false;
    }
    folder_.pop_back();
    folder_.resize(folder_.rfind('/') == std::string::npos ? 0 : folder_.rfind('/') + 1);
    refresh();
    return true;
}

const ListedFile* FileList::find(std::string_view name) const {
    const auto hit = std::find_if(files_.begin(), files_.end(),
                                  [&](const ListedFile& file) { return file.entry.name == name; });
    return hit == files_.end() ? nullptr : &*hit;
}

std::string date_text(std::int64_t since_1970_s) {
    using namespace std::chrono;
    if (since_1970_s <= 0) {
        return {};
    }
    const seconds time(since_1970_s);
    const auto day = floor<days>(time);
    const year_month_day date{sys_days(day)};
    const auto minutes_of_day = floor<minutes>(time - day).count();
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       minutes_of_day / 60, minutes_of_day % 60);
}

}  // namespace fauxboard::dlp
