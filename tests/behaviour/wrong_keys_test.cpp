// Profiles that are wrong, one way each: wrong_keys.json.

#include "tests/support/small_profile.h"
#include "tests/support/wrong_values.h"

namespace fauxboard::testing {

TEST_CASE("mistakes in a profile are told by place, each by one sentence") {
    auto right = nlohmann::ordered_json::parse(small_base);
    right["words"] = {{"M1", {{"title", "go"}, {"fields", {{"S", "how far"}}}}}};
    right["schedule"] = {{"slots", {{{"send", "L1"}, {"when_changed", {"position.x"}}}, nullptr}}};
    right["requests"] = {{"M1", {{"when", {{"S", 1}}}, {"do", "motion.home"}, {"send", "L1"}}}};
    right["events"] = {{"motion.homed", {{"send", "L1"}}}};
    right["boot"] = {"L1"};
    check_wrong_values("behaviour/wrong_keys.json", right.dump(), [](std::string_view json) -> std::string {
        try {
            behaviour::load_profile({"small.json", std::string(json)}, finder_in({}));
        } catch (const behaviour::ProfileError& error) {
            return error.what();
        }
        return {};
    });
}

}  // namespace fauxboard::testing
