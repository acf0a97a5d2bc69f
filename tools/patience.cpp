#include "tools/patience.h"

#include <filesystem>

namespace fauxboard::tools {

void wait_for_port(const std::string& port) {
    wait_a_moment([&port] {
        std::error_code error;
        return std::filesystem::exists(port, error);
    });
}

}  // namespace fauxboard::tools
