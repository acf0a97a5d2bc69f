#pragma once

#include <string>

#include "emulator/link/unique_fd.h"
#include "emulator/machine/storage.h"

namespace fauxboard::host {

/// A folder of this computer as the printer's SD card, or U-disk. Shows regular files and folders only, and
/// never leaves the folder: symlinks, devices and pipes are not there. It is looked at anew each time, so it
/// may change, or vanish (an empty card) and come back. Names are bytes, whatever their encoding; names with
/// control characters are left out, since they would break the line.
class FolderCard final : public machine::Volume {
  public:
    static constexpr std::size_t max_entries =
        4096;  ///< of one folder: the first by name; the rest is left out

    /// Throws link::HostError, which calls it `what`, when `folder` is not a readable folder now.
    explicit FolderCard(std::string folder, std::string_view what = "the SD card");

    /// Files first, then folders, each by name (byte order).
    bool list(std::string_view folder, std::vector<machine::CardEntry>& out) const override;
    /// A file that this user may not read is `unreadable`.
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    /// Looks the file up anew each time, so one that vanished, or became something else, is nothing.
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;
    // As Volume says. Nothing but regular files is ever made, changed or removed: no symlink is followed or
    // replaced, in no part of the path.
    bool create(std::string_view path) override;
    bool append(std::string_view path, std::uint64_t offset, std::string_view bytes) override;
    bool rename(std::string_view from, std::string_view to) override;
    bool remove(std::string_view path) override;

  private:
    link::UniqueFd open_root() const;
    link::UniqueFd open_folder(std::string_view path) const;
    link::UniqueFd open_file(std::string_view path, int flags) const;
    /// The folder that holds `path`, which `name` is then the last part of; no descriptor for a name that
    /// cannot be.
    link::UniqueFd open_parent(std::string_view path, std::string& name) const;

    std::string root_;
};

}  // namespace fauxboard::host
