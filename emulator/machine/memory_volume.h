#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/storage.h"

namespace fauxboard::machine {

/// A disk in memory that can be written to. What is on it at first may come from a profile or a scenario; it
/// is gone with this object.
class MemoryVolume final : public Volume {
  public:
    /// All files together have no more bytes than this.
    static constexpr std::uint64_t room = 64UL * 1024 * 1024;
    static constexpr std::size_t most_files = 4096;

    explicit MemoryVolume(const std::vector<BuiltInEntry>& root = {}) { take_in(root, {}); }

    bool list(std::string_view folder, std::vector<CardEntry>& out) const override;
    Kind look(std::string_view path, std::uint64_t& bytes) const override;
    std::optional<std::size_t> read(std::string_view path, std::uint64_t offset,
                                    std::span<char> out) const override;
    bool create(std::string_view path) override;
    bool append(std::string_view path, std::uint64_t offset, std::string_view bytes) override;
    bool rename(std::string_view from, std::string_view to) override;
    bool remove(std::string_view path) override;

  private:
    void take_in(const std::vector<BuiltInEntry>& entries, const std::string& folder);
    bool may_be_file(std::string_view path) const;

    std::map<std::string, std::string, std::less<>> files_;  ///< by path
    std::set<std::string, std::less<>> folders_;
    std::uint64_t used_ = 0;
};

}  // namespace fauxboard::machine
