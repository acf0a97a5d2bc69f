#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/machine_config.h"

namespace fauxboard::machine {

struct CardEntry {
    std::string name;
    bool folder = false;
    std::uint64_t bytes = 0;
    /// When it was written, as FAT packs date and time; of a disk that does not know, some day.
    std::uint32_t stamp = 0x5A21'0000;
    std::string long_name = {};   ///< of files(): the same as its name where the disk knows no other
    std::int64_t modified_s = 0;  ///< since 1970, local time; 0: not known
    std::string file = {};        ///< its real name, where `name` is another one
};

/// A disk as the board sees it. Paths are relative to its root, parts parted by '/', never starting with one,
/// already cleaned by Storage: no "..", no empty parts. An implementation must still not follow anything out
/// of its root.
class Volume {
  public:
    virtual ~Volume() = default;
    enum class Kind : std::uint8_t { missing, file, folder, unreadable };
    /// Appends the entries of a folder, files first, then folders. False, and nothing added, when there is no
    /// such folder.
    virtual bool list(std::string_view folder, std::vector<CardEntry>& out) const = 0;
    /// What stands at `path`, and its size if it is a file.
    virtual Kind look(std::string_view path, std::uint64_t& bytes) const = 0;
    /// Reads the file's bytes from `offset` on, as many as `out` holds or there are; 0 at the end. Nothing
    /// when there is no such file, or it cannot be read.
    virtual std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                            std::span<char> out) const = 0;
    // Writing, which not every disk takes: each function says false then, as for all that cannot be done.

    /// Makes an empty file; empties the one that has that name.
    virtual bool create(std::string_view /*path*/) { return false; }
    /// Adds `bytes` to the end of a file, which must be at `offset`. The file is as before when it fails.
    virtual bool append(std::string_view /*path*/, std::uint64_t /*offset*/, std::string_view /*bytes*/) {
        return false;
    }
    /// Gives a file another name. A file that has it already is replaced, whole, in one step.
    virtual bool rename(std::string_view /*from*/, std::string_view /*to*/) { return false; }
    /// Removes a file; folders stay.
    virtual bool remove(std::string_view /*path*/) { return false; }
    /// Whether nothing on it ever changes, so that a listing may be kept.
    virtual bool fixed() const { return false; }
};

/// The small card that a profile carries within itself.
class BuiltInVolume final : public Volume {
  public:
    explicit BuiltInVolume(const std::vector<BuiltInEntry>& root) : root_(root) {}
    bool list(std::string_view folder, std::vector<CardEntry>& out) const override;
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;
    bool fixed() const override { return true; }

  private:
    const BuiltInEntry* find(std::string_view path) const;
    const std::vector<BuiltInEntry>& root_;
};

enum class DiskState : std::uint8_t { ok = 0, removed = 1, failed = 2 };

/// SD card and U-disk: which one is chosen, which folder is shown, what a name on the line means.
class Storage {
  public:
    static constexpr std::size_t disk_count = 2;  // 0 SD card, 1 U-disk

    /// How the board lists and finds; as CardConfig says.
    struct Naming {
        bool way_back = true;
        bool ignore_case = false;
        bool short_names = false;  ///< of eight and three characters, as a FAT disk has them
        bool long_names = true;    ///< where there are short ones: the long ones are taken as well
    };
    void configure(const CardConfig& config) {
        config_ = &config;
        naming_ = {config.way_back, config.ignore_case, config.short_names, config.long_names};
    }

    void attach(int disk, Volume* volume);  ///< nullptr takes it out
    void set_state(int disk, DiskState state) { states_[index(disk)] = state; }
    void mount(int disk);    ///< M21: the disk in the slot, if any, comes into use
    void release(int disk);  ///< M22: it goes out of use, and stays in its slot
    DiskState state(int disk) const { return states_[index(disk)]; }
    bool usable(int disk) const {
        return states_[index(disk)] == DiskState::ok && volumes_[index(disk)] != nullptr;
    }

    /// False unless `disk` is 0 or 1.
    bool choose(int disk);
    int chosen() const { return chosen_; }

    void enter_root() { folder_.clear(); }
    /// Enters what stands after `M20 file:`: "SD1:/A30T", "A30T", "/A30T/sub", "Main/A30T" (the way back: the
    /// parent of the folder shown). Any attempt to leave the root, and a folder that is not there, leaves the
    /// folder as it is.
    bool enter(std::string_view name);
    const std::string& folder() const { return folder_; }

    /// What the screen shows of the folder: the way back first unless at the root, at most `limit` entries in
    /// all.
    void listing(std::vector<CardEntry>& out, unsigned limit) const;
    /// Every file of the chosen disk, of all folders, its name with the way to it ("SUB/B.GCO"); at most
    /// `limit`.
    void files(std::vector<CardEntry>& out, std::size_t limit) const;

    /// The disk in the slot, if it is usable and its files can be read.
    const Volume* volume(int disk) const {
        return usable(disk) && file_trouble_ == Volume::Kind::file ? volumes_[index(disk)] : nullptr;
    }
    /// What stands at `path` on the disk.
    Volume::Kind look(int disk, std::string_view path) const;
    /// What every file is found to be that is there: Kind::file for no trouble, missing or unreadable.
    void set_file_trouble(Volume::Kind kind) { file_trouble_ = kind; }

    /// The same, to write to.
    Volume* writable(int disk) {
        return usable(disk) && file_trouble_ == Volume::Kind::file ? volumes_[index(disk)] : nullptr;
    }

    /// Writes a whole file of the chosen disk, beside and then under its name, so that half a one never
    /// stands there. False when that cannot be.
    bool write(std::string_view name, std::string_view bytes);
    /// Removes a file of the chosen disk. False when there is none, or it cannot be.
    bool remove(std::string_view name);
    /// Where a file of this name would be written, below the root. False for a name that cannot be a file's:
    /// it would leave the root, say, or is a folder's. The file's own name stays as it is spelled.
    bool path_for_writing(std::string_view name, std::string& path) const;

    /// The disk that listing() would show; nullptr when there is none to show, or when it may change.
    const Volume* fixed_volume() const {
        return usable(chosen_) && volumes_[index(chosen_)]->fixed() ? volumes_[index(chosen_)] : nullptr;
    }

    struct Found {
        Volume::Kind kind = Volume::Kind::missing;
        std::string path;  ///< relative to the root
        std::uint64_t bytes = 0;
        std::string shown{};  ///< what the list calls it, if that is not its name
    };
    /// The file that `name` means, relative to the folder shown. A checksum that a screen kept in the name
    /// ("x.gco*74"), or a size that a host did ("x.gco 1234", as M20 lists it), is taken off when there is no
    /// file that is really called so.
    Found find(std::string_view name) const;
    std::string asked;      ///< the last part of the name that was last asked for, as it was spelled
    std::string looked_up;  ///< what long_path() was last asked for gave
    /// The long path of a file or folder that is named by its short ones (M33); empty: there is none.
    std::string long_path(std::string_view name) const;

  private:
    Found find_listed(std::string_view name) const;
    static std::size_t index(int disk) { return disk == 1 ? 1 : 0; }
    /// Adds the files of a folder, listed under the name `shown`, and of those in it: a path has at most 255
    /// bytes, so that they are no deeper than 128.
    void add_files(const std::string& folder, const std::string& shown, std::size_t limit,
                   std::size_t& folders_left, std::vector<CardEntry>& out) const;
    std::array<Volume*, disk_count> volumes_{};
    std::array<DiskState, disk_count> states_{DiskState::removed, DiskState::removed};
    Volume::Kind file_trouble_ = Volume::Kind::file;
    int chosen_ = 0;
    std::string folder_;
    static const CardConfig plain_card;
    const CardConfig* config_ = &plain_card;
    Naming naming_;
};

/// What stands behind the name of a file that is being written: ".temp" as real boards have it; where the
/// disk has something of that name, which may be the user's, an ending that nobody but us gives.
std::string unfinished_path(const Volume& disk, const std::string& path);

/// Joins `name` to `folder` and cleans the result: volume names ("SD1:") and double slashes go. False when it
/// would leave the root, holds a control character, or is longer than 255 bytes.
bool clean_path(std::string_view folder, std::string_view name, std::string& out);

/// A name as requests bring it, without blanks, quotes and the colon of an absolute path: 'a.ctb', ':a.ctb'
/// and
/// :'a.ctb' all become a.ctb.
std::string_view bare_name(std::string_view name);

}  // namespace fauxboard::machine
