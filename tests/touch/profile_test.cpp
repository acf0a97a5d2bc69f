#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/touch/bench.h"

namespace fauxboard::testing {
namespace {

/// The made-up screen with one thing put at a JSON pointer.
std::string with(const std::string& pointer, const std::string& value) {
    auto json = nlohmann::ordered_json::parse(made_up_screen);
    json[nlohmann::ordered_json::json_pointer(pointer)] = nlohmann::ordered_json::parse(value);
    return json.dump();
}

}  // namespace

TEST_CASE("the made-up screen is right") {
    CHECK(wrong_with(made_up_screen).empty());
}

TEST_CASE("mistakes in a board's own screen are told by place, with the nearest name") {
    struct Case {
        std::string pointer;
        std::string value;
        std::string told;
    };
    const std::vector<Case> cases{
        {"/pages/Main/buttons/Sound/do", R"({"set": {"addons.sond": 1}})",
         "\"addons.sond\" is no field of the machine; did you mean \"addons.sound\"?"},
        {"/pages/Main/buttons/Sound/do", R"({"set": {"job.name": "x"}})", "\"job.name\" is read only"},
        {"/pages/Main/buttons/Sound/do", R"("card.insrt")",
         "there is no action \"card.insrt\"; did you mean \"card.insert\"?"},
        {"/pages/Main/buttons/Sound/at", "[1, 2, 3]", "expected [x, y, width, height] in pixels"},
        {"/pages/Main/buttons/Sound/at", "[1, 2, \"speed.percnt\", 3]",
         "unknown value \"speed.percnt\"; did you mean \"speed.percent\"?"},
        {"/pages/Main/buttons/Sound/look", R"("buton")",
         "there is no look \"buton\"; did you mean \"button\"?"},
        {"/pages/Main/buttons/Sound/send", R"("M105")", "send"},
        {"/pages/Main/buttons/Ask/leads_to", R"("Sur?")", "there is no page \"Sur?\""},
        {"/pages/Main/draw/0/color", R"("C8")", "expected a colour of six hexadecimal digits"},
        {"/pages/Main/draw/0/icon", R"("x")", "\"text\" and \"icon\" at once"},
        {"/pages/Main/draw/0/text", R"("{speed.percent:2f}")", "unknown format \"2f\""},
        {"/boxes/Done/kind", R"("okay")", "okay"},
        {"/events/card.remuved", R"({"leads_to": "Card"})",
         "there is no event \"card.remuved\"; did you mean \"card.removed\"?"},
        {"/translations/Russian/Speeed", R"("x")",
         "no text of this screen reads so; did you mean \"Speed\"?"},
        {"/pages/Number/buttons/1/key", R"("x")", "is no key; expected a digit"},
        {"/pages/Main/buttons/Sound/assume", R"({"speed.percent": 3})", "\"speed.percent\" is the machine's"},
        {"/pages/Lost", R"({"title": "x"})", "no button leads to this page"},
    };
    for (const Case& one : cases) {
        CAPTURE(one.pointer);
        const std::string told = wrong_with(with(one.pointer, one.value));
        CHECK_MESSAGE(told.find(one.told) != std::string::npos, told);
    }
}

TEST_CASE("the language of own screens: formats, pieces of texts, functions") {
    screen::ValueTable table;
    screen::ValueInfo number;
    number.name = "n";
    number.start = 3725;
    table.add(number);
    screen::ValueInfo file;
    file.name = "file";
    file.kind = screen::ValueKind::text;
    file.start_text = "a.b.pws";
    table.add(file);
    const auto values = table.power_on();
    const std::vector<std::string> columns{"date"};
    const std::vector<std::string> cells{"2020-09-08 02:56"};
    const screen::Scope scope{values, 1, "x", 0, cells};
    const auto render = [&](std::string_view source) {
        return screen::Template(source, table, {true, false, &columns}).render(scope);
    };
    CHECK(render("{n:hms}") == "01:02:05");
    CHECK(render("{n:hm}") == "01:02");
    CHECK(render("{360000+59:hms}") == "100:00:59");
    CHECK(render("{7:02d}/{123:02d}/{7.9:d}") == "07/123/7");
    CHECK(render("{file:stem} {file:ending}") == "a.b .pws");
    CHECK(render("{row.date:8+2}.{row.date:5+2} {row.date:11+5}") == "08.09 02:56");
    CHECK(render("{row.date:99+2}") == "");
    CHECK(render("{days(2,20)} {days(2,21)} {days(4,0)} {days(12,0)}") == "29 28 30 31");
    // As a computer of 32 bits has it: 52 % and 58 %.
    CHECK(render("{floor(float(float(53/100)*100))} {floor(float(float(59/100)*100))}") == "52 58");
    CHECK_THROWS_AS(render("{file:2x3}"), std::runtime_error);
    CHECK_THROWS_AS(render("{row.size}"), std::runtime_error);
}

}  // namespace fauxboard::testing
