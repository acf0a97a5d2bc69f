#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/dlp/stick.h"

namespace fauxboard::dlp {

enum class FileKind : std::uint8_t { folder, print, settings, image };
std::string_view to_string(FileKind kind);

/// An entry as the board lists it.
struct ListedFile {
    StickEntry entry;
    FileKind kind = FileKind::folder;
    std::string date;  ///< see date_text()
};

/// The folder of the stick that the board shows: folders, and files whose ending it knows, in lower case.
class FileList {
  public:
    /// With `ctb`, .ctb files are listed, too (0.08).
    FileList(const Stick& stick, bool ctb) : stick_(stick), ctb_(ctb) {}

    /// Reads the folder anew; back to the root when it is gone.
    void refresh();
    void home();
    bool enter(std::string_view name);
    bool up();

    const std::vector<ListedFile>& files() const { return files_; }
    /// "" at the root, else "dir/" or "dir/sub/".
    const std::string& folder() const { return folder_; }
    /// The same as the board shows it, with a '/' before it.
    const std::string& shown() const { return shown_; }
    /// The listed file of that name, or null.
    const ListedFile* find(std::string_view name) const;
    /// Folder and name.
    std::string path_of(std::string_view name) const { return folder_ + std::string(name); }

  private:
    static constexpr std::size_t most_files = 4096;
    void read();

    const Stick& stick_;
    bool ctb_;
    std::string folder_;
    std::string shown_ = "/";
    std::vector<ListedFile> files_;
};

/// "YYYY-MM-DD HH:MM"; empty when it is not known.
std::string date_text(std::int64_t since_1970_s);

}  // namespace fauxboard::dlp
