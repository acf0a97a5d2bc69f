#pragma once

// A right text and a table of what makes it wrong: each row is put into it, and what is told must be the
// row's sentences, each with its place, and no others.

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace fauxboard::testing {

/// `table` is a file below tests: [{ "at": POINTER, "is": VALUE, "says": [SENTENCE, ...] }, ...]. Without
/// "is" what stands there is taken out; "several": 9 makes an array of nine times that, "named": 9 an object
/// with the names "0" to "8". "also" puts in more: { POINTER: VALUE }. A row without sentences is right.
inline void check_wrong_values(const std::string& table, std::string_view right,
                               const std::function<std::string(std::string_view)>& refusal) {
    using Json = nlohmann::ordered_json;
    const auto put = [](Json& root, const std::string& pointer, const Json& value) {
        root[Json::json_pointer(pointer)] = value;
    };
    const auto value_of = [](const Json& row) {
        if (row.contains("several")) return Json(row["several"].get<std::size_t>(), row["is"]);
        if (!row.contains("named")) return row["is"];
        Json out = Json::object();
        for (int i = 0; i < row["named"].get<int>(); ++i) {
            out[std::to_string(i)] = row["is"];
        }
        return out;
    };
    std::ifstream in(FAUXBOARD_SOURCE_DIR "/tests/" + table);
    const Json rows = Json::parse(in);
    REQUIRE(!rows.empty());
    CHECK(refusal(right) == "");
    for (const Json& row : rows) {
        Json root = Json::parse(right);
        const auto at = row["at"].get<std::string>();
        if (row.contains("is")) {
            put(root, at, value_of(row));
        } else {
            const Json::json_pointer pointer(at);
            REQUIRE(root.contains(pointer));
            root[pointer.parent_pointer()].erase(pointer.back());
        }
        const Json also = row.value("also", Json::object());
        for (const auto& [pointer, value] : also.items()) {
            put(root, pointer, value);
        }
        const std::string told = refusal(root.dump());
        CAPTURE(row.dump());
        CAPTURE(told);
        for (const Json& sentence : row["says"]) {
            CHECK(told.find(sentence.get<std::string>()) != std::string::npos);
        }
        // One mistake, one sentence.
        CHECK(static_cast<std::size_t>(std::count(told.begin(), told.end(), '\n')) + (told.empty() ? 0 : 1) ==
              row["says"].size());
    }
}

}  // namespace fauxboard::testing
