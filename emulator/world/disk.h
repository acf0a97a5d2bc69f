#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/fault/dice.h"
#include "emulator/machine/storage.h"

namespace fauxboard::world {

/// A disk in memory that does to its board what disks do: fills up, fails, and at a power cut loses, or
/// tears, what was not on the disk for certain. It promises what host::FolderCard does and no more: what a
/// file holds is certain when rename() gave it its name, and nothing before.
class Disk final : public machine::Volume {
  public:
    enum class Trouble : std::uint8_t { none, full, read_fails, write_fails };
    static constexpr std::uint64_t room = 4UL * 1024 * 1024;
    static constexpr std::size_t most_files = 256;

    /// A file that was there before the world began.
    void put(const std::string& path, std::string content);
    void set_trouble(Trouble trouble) { trouble_ = trouble; }
    /// The power of the computer that holds the disk goes: of each file not certain, any beginning may be
    /// left.
    void power_cut(fault::Dice& dice);

    bool list(std::string_view folder, std::vector<machine::CardEntry>& out) const override;
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;
    bool create(std::string_view path) override;
    bool append(std::string_view path, std::uint64_t offset, std::string_view bytes) override;
    bool rename(std::string_view from, std::string_view to) override;
    bool remove(std::string_view path) override;

    /// Null where there is none.
    const std::string* content(std::string_view path) const;
    /// A file that had its name before it was whole: created or added to under a name that is not an
    /// unfinished one's. Empty: there was none.
    const std::string& named_too_early() const { return named_too_early_; }
    /// Bytes read since the last call of this.
    std::uint64_t take_bytes_read() const { return std::exchange(bytes_read_, 0); }

  private:
    struct File {
        std::string content;
        bool certain = true;
    };
    std::uint64_t used() const;
    void judge_name(std::string_view path);

    std::map<std::string, File, std::less<>> files_;
    Trouble trouble_ = Trouble::none;
    std::string named_too_early_;
    mutable std::uint64_t bytes_read_ = 0;
};

}  // namespace fauxboard::world
