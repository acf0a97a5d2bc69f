#include "protocol/catalogue.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <tuple>

using namespace fauxboard::protocol;

TEST_CASE("every code of the line is there") {
    for (unsigned number = 1; number <= 24; ++number) {
        CAPTURE(number);
        REQUIRE(find_code(Direction::to_screen, 'L', number) != nullptr);
    }
    for (const unsigned number : {1U, 2U, 101U}) {
        CHECK(find_code(Direction::to_board, 'L', number) != nullptr);
    }
    for (const unsigned number : {0U, 1U, 28U, 29U, 90U, 91U, 92U}) {
        CHECK(find_code(Direction::to_board, 'G', number) != nullptr);
    }
    for (unsigned number = 0; number <= 3; ++number) {
        CHECK(find_code(Direction::to_board, 'T', number) != nullptr);
    }
    for (const unsigned number :
         {0U,    17U,   18U,   20U,   21U,   22U,   23U,   24U,   25U,   26U,   27U,   84U,   92U,
          104U,  105U,  106U,  107U,  108U,  109U,  112U,  114U,  115U,  117U,  140U,  163U,  164U,
          165U,  166U,  190U,  201U,  203U,  204U,  205U,  220U,  221U,  290U,  400U,  500U,  501U,
          502U,  600U,  2011U, 2100U, 2101U, 2103U, 2105U, 2106U, 2107U, 2111U, 2115U, 2120U, 2121U,
          2130U, 2131U, 2132U, 2133U, 2134U, 2135U, 2136U, 2137U, 2138U, 2139U, 2140U}) {
        CAPTURE(number);
        CHECK(find_code(Direction::to_board, 'M', number) != nullptr);
    }
    CHECK(find_code(Direction::to_screen, 'M', 2107) != nullptr);
}

TEST_CASE("what is not there is not found") {
    CHECK(find_code(Direction::to_screen, 'L', 0) == nullptr);
    CHECK(find_code(Direction::to_screen, 'L', 25) == nullptr);
    CHECK(find_code(Direction::to_screen, 'G', 28) == nullptr);
    CHECK(find_code(Direction::to_board, 'L', 3) == nullptr);
    CHECK(find_code(Direction::to_board, 'M', 65536 + 105) == nullptr);
    CHECK(find_code(Direction::to_board, '\0', 0) == nullptr);
    CHECK(find_code(Direction::to_board, 'Z', 1) == nullptr);
}

TEST_CASE("lines that start with words") {
    const auto title = [](Direction direction, std::string_view body) {
        const CodeInfo* code = find_words(direction, body);
        return code == nullptr ? std::string("none") : code_text(*code);
    };
    CHECK(title(Direction::to_screen, "SD printing byte 0/0") == "SD printing byte");
    CHECK(title(Direction::to_screen, "Start Print:SD1:/a") == "Start Print:");
    CHECK(title(Direction::to_screen, "Stop Print") == "Stop Print");
    CHECK(title(Direction::to_board, "log A30 LCD OK") == "log");
    CHECK(title(Direction::to_board, "logger") == "none");
    CHECK(title(Direction::to_screen, "log x") == "none");
    CHECK(title(Direction::to_board, "") == "none");
}

TEST_CASE("each code and each field is declared once and fully") {
    std::set<std::tuple<Direction, char, unsigned, std::string_view>> seen;
    for (const CodeInfo& code : catalogue()) {
        CAPTURE(code_text(code));
        CHECK(seen.emplace(code.direction, code.letter, code.number, code.word).second);
        CHECK_FALSE(code.title.empty());
        CHECK_FALSE(code.meaning.empty());
        CHECK((code.letter == 0) == !code.word.empty());
        if (code.letter != 0) CHECK(find_code(code.direction, code.letter, code.number) == &code);
        std::set<std::pair<std::string_view, std::int32_t>> keys;
        for (const FieldInfo& field : code.fields) {
            CAPTURE(field.key);
            CHECK_FALSE(field.name.empty());
            if (field.key != "/") CHECK(keys.emplace(field.key, field.when).second);
            if (field.when != always) CHECK_FALSE(words_of(code.fields[0], field.when).empty());
            if (field.kind == FieldKind::flag) CHECK(field.values.size() == 2);
            std::set<std::int32_t> values;
            for (const ValueName& value : field.values) {
                CHECK(values.insert(value.value).second);
                CHECK_FALSE(value.words.empty());
            }
        }
    }
    CHECK(seen.size() > 100);
}

TEST_CASE("values in words") {
    const FieldInfo& status = find_code(Direction::to_screen, 'L', 3)->fields[0];
    CHECK(words_of(status, 1) == "printing");
    CHECK(words_of(status, 9).empty());
    CHECK(value_list(status) == "0 = idle, 1 = printing, 2 = paused, 3 = recovery, 4 = finished");
    CHECK(value_list(find_code(Direction::to_screen, 'L', 1)->fields[0]).empty());
}
