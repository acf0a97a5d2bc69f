// Screens that hang on a line and are wrong, one way each: wrong_screens.json.

#include "tests/screen/harness.h"
#include "tests/support/wrong_values.h"

namespace fauxboard::testing {
namespace {

constexpr std::string_view line_screen = R"({
  "name": "line-screen",
  "line": { "baud": 115200 },
  "values": { "n": { "names": { "0": "none" } }, "t": { "kind": "text" }, "l": { "kind": "list", "most": 4 },
              "bytes": { "is": "line_bytes" }, "page": { "kind": "text", "is": "page" } },
  "frames": { "L1": { "read": [ { "key": "N:", "as": "u8", "min": 0, "max": 9, "into": "n" } ],
                      "assume": { "t": "was {n}" }, "opens": "Sub" },
              "ok": { "acknowledges": true },
              "done": { "answers": "M1" } },
  "talk": { "queued": true, "waits": { "M1": "it shows a bar" }, "polls": [ { "send": "M105", "every_ms": 1000 } ] },
  "pages": {
    "Main": { "shows": [ "{n}" ], "buttons": {
      "Go": { "when": { "n": 0 }, "send": "G1 X{n:d}", "leads_to": "Sub", "expect": { "frame": "L1", "where": { "n": 1 } } },
      "Row": { "rows": "l", "label": "{row.text}", "send": "M23 {row.text}" },
      "Type": { "input": { "normally": 1, "min": 0, "max": 9 }, "send": "M1 S{input:d}", "prepare": "Go" } } },
    "Sub": { "buttons": { "Back": { "leads_to": "<back>" } } }
  },
  "everywhere": { "Home": { "leads_to": "Main" } },
  "idle": { "after_ms": 1000, "leads_to": "Main" },
  "assumed": { "why": "made up" }
})";

}  // namespace

TEST_CASE("mistakes in a screen that hangs on a line are told by place, each by one sentence") {
    check_wrong_values("screen/wrong_screens.json", line_screen, [](std::string_view json) -> std::string {
        try {
            screen_from(json);
        } catch (const behaviour::ProfileError& error) {
            return error.what();
        }
        return {};
    });
}

}  // namespace fauxboard::testing
