// Steps and triggers of the USB side: a host program inside a scenario.

#include <doctest/doctest.h>

#include <string>

#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

using testing::play_steps;
using Verdict = Outcome::Verdict;

std::string sentence_of(std::string_view steps) {
    return play_steps(steps).outcome.sentence;
}

TEST_CASE("host: a line is heard as a host's, and what the board says to it is seen") {
    const auto run = play_steps(R"j([
        {"wait": "5s"},
        {"host": "M105"},
        {"expect": {"host_line": "^ok T:(?P<nozzle>[0-9]+)"
}
},
        {"host": "M117 nozzle ${nozzle}"},
        {"together": [
            {"steps": [{"expect": "^L14  nozzle ${nozzle}$", "why": "the screen shows it"}]},
            {"steps": [{"expect_next": {"host_line": "^ok$"}, "why": "the host is acknowledged"}]}
        ]},
        {"check": {"job.status": 0}}
    ])j");
    CHECK(run.outcome.sentence.starts_with("test passed: "));
    CHECK(run.outcome.captures.at("nozzle") == "22");
}

TEST_CASE("host: numbered lines are taken, a wrong checksum is asked for again") {
    const auto run = play_steps(R"j([
        {"wait": "5s"},
        {"host": "N0 M110 N0*125"}, {"expect_next": {"host_line": "^ok$"}},
        {"host": "M104 S180", "numbered": true}, {"expect_next": {"host_line": "^ok$"}},
        {"host": "N2 M104 S60*1"},
        {"expect_next": {"host_line": "^Error:checksum mismatch"}},
        {"expect_next": {"host_line": "^Resend: 2$"}}, {"expect_next": {"host_line": "^ok$"}},
        {"host": "M104 S190", "numbered": true}, {"expect": {"host_request": "^M104 S190$"}},
        {"check": {"heaters.nozzle.target": "190C", "host.last_line": 2}}
    ])j");
    CHECK(run.outcome.sentence.starts_with("test passed: "));
}

TEST_CASE("host: what must never be said to it fails when it is, with the words") {
    CHECK(sentence_of(R"j([{"wait": "5s"}, {"never": {"host_line": "^Error"}, "why": "the line is good",
                          "steps": [{"host": "N7 M105*1"}, {"wait": "5s"}]}])j") ==
          "test failed after 5 s: \"the line is good\" is not so: a line of the board to the host that "
          "matches \"^Error\" must not come, and came: \"Error:Line Number is not Last Line Number+1, Last "
          "Line: 0\" (test.json:1).");
    CHECK(sentence_of(
              R"j([{"wait": "5s"}, {"host": "M105"}, {"never": {"host_line": "^Error"}, "for": "5s"}])j")
              .starts_with("test passed: "));
}

TEST_CASE("host: what is waited for in vain is told with what was said last on that side") {
    CHECK(sentence_of(R"j([{"wait": "5s"}, {"host": "M27"}, {"expect": {"host_line": "^SD printing"}}])j") ==
          "test failed after 7 s: expected a line of the board to the host that matches \"^SD printing\" to "
          "come within 2 s; the last that the board said to the host was \"ok\" (test.json:1).");
    CHECK(
        sentence_of(R"j([{"wait": {"host_request": "^M105"}, "within": "1s"}])j") ==
        "test timed out after 1 s: waited in vain for a request of the host that matches \"^M105\" within 1 "
        "s; the host asked nothing lately (test.json:1).");
    CHECK(sentence_of(R"j([{"wait": "5s"}, {"host": "M115"}, {"expect_next": {"host_line": "^ok"}}])j")
              .starts_with("test failed after 5 s: expected the next line of the board to the host to match "
                           "\"^ok\"; it was \"FIRMWARE_NAME:"));
}

TEST_CASE("host: lines of one side are no lines of the other") {
    CHECK(sentence_of(R"j([{"wait": "5s"}, {"host": "M105"}, {"expect": "^ok T:", "within": "3s"}])j")
              .find("expected a line of the board that matches \"^ok T:\" to come within 3 s") !=
          std::string::npos);
    CHECK(sentence_of(
              R"j([{"wait": "5s"}, {"host": "M105"}, {"expect": {"request": "M105"}, "within": "3s"}])j")
              .find("expected a request of the screen that matches \"M105\" to come within 3 s") !=
          std::string::npos);
}

}  // namespace
}  // namespace fauxboard::script
