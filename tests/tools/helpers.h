#pragma once

#include <stdlib.h>  // mkdtemp

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace fauxboard::tests {

inline std::string read_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

/// A file that is gone when the test is over.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text)
        : folder_(std::filesystem::temp_directory_path() / ("fauxboard-XXXXXX")) {
        std::string pattern = folder_.string();
        folder_ = ::mkdtemp(pattern.data());
        path_ = folder_ / name;
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TemporaryFile() { std::filesystem::remove_all(folder_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    std::string path() const { return path_.string(); }

  private:
    std::filesystem::path folder_;
    std::filesystem::path path_;
};

}  // namespace fauxboard::tests
