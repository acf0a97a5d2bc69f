#include "tools/profile_changes.h"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "emulator/behaviour/document.h"
#include "emulator/host/profile_files.h"

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Keys that a running board has used already, and when it does so again. All others are in force at once.
struct Waiting {
    std::string_view when;
    bool for_good;  ///< a start of the board does not bring them into force
    std::array<std::string_view, 4> keys;
};
constexpr std::array waiting{
    Waiting{"at the board's next start", false, {"boot", "defaults"}},
    Waiting{"at the next start of this program", true, {"machine", "identity", "line", "screen"}},
};

bool differs(const Json& a, const Json& b, const std::string& key) {
    return a.value(key, Json()) != b.value(key, Json());
}

}  // namespace

ProfileChanges::ProfileChanges(std::string profile)
    : profile_(std::move(profile)), at_start_(read()), before_(at_start_) {}

std::string ProfileChanges::what_waits() {
    Json now = read();
    std::string out;
    for (const Waiting& row : waiting) {
        std::vector<std::string_view> keys;
        for (const std::string_view key : row.keys) {
            if (!key.empty() && differs(row.for_good ? at_start_ : before_, now, std::string(key))) {
                keys.push_back(key);
            }
        }
        if (!keys.empty()) {
            out += fmt::format("; {} {}", fmt::join(keys, ", "), row.when);
        }
    }
    before_ = std::move(now);
    return out;
}

Json ProfileChanges::read() const {
    const auto finder = host::profile_finder();
    const auto source = finder(profile_, {});
    return source ? behaviour::load_document(*source, finder).root : Json::object();
}

}  // namespace fauxboard::tools
