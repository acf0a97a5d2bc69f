#include "protocol/secrets.h"

#include <doctest/doctest.h>

namespace fauxboard::protocol {
namespace {

TEST_CASE("secrets: a network's password is masked, in any of its forms") {
    CHECK(mask_secrets("M9003 \"home\",\"secret\"") == "M9003 \"home\",\"***\"");
    CHECK(mask_secrets("M9005 ``my_ssid\",\"my_password``\r\n") == "M9005 ``my_ssid\",\"***\"\r\n");
    CHECK(mask_secrets("N3 M9003 \"home\",\"se*5ret\"") == "N3 M9003 \"home\",\"***\"");
    for (const char* before : {"M009003", "N3M9003", "request \"M9003", "\tM9005"}) {
        CHECK(mask_secrets(before + std::string(" \"home\",\"secret\"")) ==
              before + std::string(" \"home\",\"***\""));
    }
    CHECK(mask_secrets("M9003 home,secret\n") == "M9003 home,\"***\"\n");
}

TEST_CASE("secrets: a checksum that was right is right again, a wrong one stays wrong") {
    const auto summed = [](const std::string& text) {
        unsigned sum = 0;
        for (const char c : text) {
            sum ^= static_cast<unsigned char>(c);
        }
        return text + "*" + std::to_string(sum);
    };
    CHECK(mask_secrets(summed("N7 M9003 \"home\",\"secret\"")) == summed("N7 M9003 \"home\",\"***\""));
    CHECK(mask_secrets("N7 M9003 \"home\",\"secret\"*1") == "N7 M9003 \"home\",\"***\"*1");
}

TEST_CASE("secrets: all other lines are as they were") {
    for (const char* line : {"", "M105", "M9003", "M9003 \"home\"", "M90030 1,2", "M117 a,b", "XM9003 1,2",
                             "N-0 M104 S200*74\r\n", "M9004 I192,168,1,1"}) {
        CHECK(mask_secrets(line) == line);
    }
}

}  // namespace
}  // namespace fauxboard::protocol
