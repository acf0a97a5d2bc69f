#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace fauxboard::host {

/// What a profile, a screen, a scenario or a schema may have.
inline constexpr std::size_t max_text_file_bytes = 4UL * 1024 * 1024;

/// A file's text as it could be had, or why not.
struct FileText {
    std::optional<std::string> text;
    /// A clause such as "it is larger than 4 MiB"; empty when there is no such file, or when it was read.
    std::string trouble;
};

/// Reads a plain file of at most max_text_file_bytes. Never waits: anything that is no plain file (a pipe, a
/// device, a folder) is refused by its kind; a disk that fails in the middle is a trouble like others.
FileText read_text_file(const std::filesystem::path& file);

}  // namespace fauxboard::host
