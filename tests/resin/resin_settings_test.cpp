#include "emulator/resin/resin_settings.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "emulator/resin/printer.h"

using namespace fauxboard::resin;

TEST_CASE("resin settings: each is found by its code and letters, and by no other's") {
    std::set<std::string> keys;
    for (const ResinSettingInfo& info : resin_settings()) {
        CAPTURE(info.path);
        for (const char letter : {info.letter, info.also}) {
            if (letter != 0) {
                CHECK(keys.insert(std::to_string(info.code) + letter).second);
                CHECK(find_resin_setting(info.code, letter) == &info);
            }
        }
        CHECK_FALSE(info.help.empty());
        CHECK(ResinSettings{}[info.id] == info.initial);
    }
    CHECK(find_resin_setting(8004, 'Z') == nullptr);
    CHECK(find_resin_setting(8003, 'I') == nullptr);
}

TEST_CASE("resin settings: values are kept within their bounds, whole ones whole") {
    for (const ResinSettingInfo& info : resin_settings()) {
        CAPTURE(info.path);
        ResinSettings settings;
        settings.set(info.id, info.max + 1);
        CHECK(settings[info.id] == info.max);
        settings.set(info.id, info.min - 1);
        CHECK(settings[info.id] == info.min);
    }
    ResinSettings settings;
    settings.set(ResinSetting::start_speed, 12.6);
    CHECK(settings[ResinSetting::start_speed] == 13);
    settings.set(ResinSetting::offset, -0.25);
    CHECK(settings[ResinSetting::offset] == -0.25);
}
