#pragma once

#include <doctest/doctest.h>
#include <fcntl.h>

#include <fstream>
#include <iterator>
#include <string>

#include "emulator/link/unique_fd.h"
#include "tests/link/helpers.h"

namespace fauxboard::host::test {

using link::test::TemporaryFolder;

inline std::string read_file(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline link::UniqueFd open_new(const std::string& file) {
    link::UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
    REQUIRE(fd);
    return fd;
}

}  // namespace fauxboard::host::test
