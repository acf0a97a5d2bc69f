#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fauxboard::tools {

struct LogOptions;
struct RunOptions;

/// Every file and line that a program was given, and what for: one that is written is there for nothing else,
/// by whatever name, through symlinks and hard links. To be asked before the first of them is opened, as that
/// may empty it. What is given twice throws link::HostError.
class FileRoles {
  public:
    /// Something that may also be read under another role. No path: nothing.
    void reads(std::string what, const std::string& path) { add(std::move(what), path, Use::read); }
    void reads(const std::string& what, const std::vector<std::string>& paths);
    /// A device such as /dev/null takes from many.
    void writes(std::string what, const std::string& path) { add(std::move(what), path, Use::write); }
    /// A serial port or a pseudo-terminal.
    void talks(std::string what, const std::string& path) { add(std::move(what), path, Use::talk); }
    void add_log(const LogOptions& log);
    /// Each thing that a board works with; `whose` (" of a") is put behind what it is.
    void add_board(const RunOptions& options, const std::string& whose = "");

  private:
    enum class Use : std::uint8_t { read, write, talk };
    /// What a path leads to, where that is there, and where it stands.
    struct Place {
        std::optional<std::pair<dev_t, ino_t>> file;
        std::string name;    ///< with every folder on the way to it resolved, itself not
        std::string target;  ///< with all resolved
        bool device = false;
    };
    struct Role {
        std::string what;
        std::string path;
        Place place;
        Use use;
    };

    static Place place_of(const std::string& path);
    static bool clash(const Role& a, const Role& b);
    void add(std::string what, const std::string& path, Use use);

    std::vector<Role> roles_;
};

}  // namespace fauxboard::tools
