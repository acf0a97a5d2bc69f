// `fauxboard decode`, the real program.

#include <doctest/doctest.h>

#include <string>

#include "tests/tools/program.h"

namespace fauxboard::test {
namespace {

TEST_CASE("decode: files, two files merged, standard input") {
    const TemporaryFolder folder;
    const std::string in = folder.put("in.txt", "15:00:00.1 - N-0 M27*59\n15:00:00.3 - N-0 M105*10\n");
    const std::string out = folder.put("out.txt", "15:00:00.2 - N-0 L21 P0 S0*63\n");
    const Outcome merged = run_program("decode " + in + " " + out);
    CHECK(merged.code == 0);
    const auto lines = lines_of(merged.out);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].find("N-0 M27*59") != std::string::npos);
    CHECK(lines[1].find("N-0 L21 P0 S0*63") != std::string::npos);
    const Outcome piped = run_shell("printf 'M27\\n\\033\\n' | " FAUXBOARD_PROGRAM " decode");
    CHECK(piped.code == 0);
    CHECK(lines_of(piped.out).at(1).find("\\x1B") != std::string::npos);
    CHECK(run_shell("printf 'M27\\n' | " FAUXBOARD_PROGRAM " decode --json -")
              .out.starts_with("{\"from\":\"screen\""));
}

TEST_CASE("decode: a bad line is marked and the rest decoded; a bad file is exit code 3") {
    const TemporaryFolder folder;
    const std::string file =
        folder.put("x.jsonl", "{\"t\":\n{\"t\": 1, \"from\": \"screen\", \"line\": \"M27\"}\n");
    const Outcome bad_line = run_program("decode " + file);
    CHECK(bad_line.code == 0);
    CHECK(bad_line.out.starts_with("x " + file + ":1: not JSON"));
    CHECK(lines_of(bad_line.out).size() == 2);
    for (const std::string& none : {folder.file("none"), folder.file("")}) {
        const Outcome outcome = run_program("decode " + file + " " + none);
        CHECK(outcome.code == 3);
        CHECK(lines_of(outcome.out).size() == 1);
        CHECK(outcome.out.find("cannot be read") != std::string::npos);
    }
}

TEST_CASE("decode --screen: what that screen would have made of the board's lines") {
    const TemporaryFolder folder;
    const std::string file = folder.put("talk.txt",
                                        "L1 X1 Y2 Z3 F4\n"
                                        "L18 P26 S15\n"
                                        "L3 PS:0 FN:cube.gcode TM:0\n"
                                        "L22 MS:0 MR:100\n"
                                        "M105\n");
    const auto lines = lines_of(run_program("decode --screen geeetech-a30 " + file).out);
    REQUIRE(lines.size() == 5);
    CHECK(lines[0].starts_with("  "));
    CHECK(lines[1].starts_with("* "));
    CHECK(lines[1].find(
              "[geeetech-a30: would crash: the page table ends at 14, and the screen reads past it]") !=
          std::string::npos);
    CHECK(lines[2].find("geeetech-a30: would crash: no \" PG:\" behind \"FN:\"") != std::string::npos);
    CHECK(lines[3].find("geeetech-a30: ignored: this screen knows no L22") != std::string::npos);
    CHECK(lines[4].find("geeetech-a30") == std::string::npos);  // the screen's own line
    CHECK(run_program("decode " + file).out.find("would crash") == std::string::npos);
    const std::string json = run_program("decode --json --screen geeetech-a30 " + file).out;
    CHECK(json.find(R"("kind":"would crash","sentence":"geeetech-a30: would crash: the page table)") !=
          std::string::npos);
    const Outcome none = run_program("decode --screen nosuch " + file);
    CHECK(none.code == 3);
    CHECK(none.out.find("there is no screen of this name; known: btt-tft geeetech-a30 geeetech-a30t") !=
          std::string::npos);
}

TEST_CASE("decode: a serial.log of OctoPrint, in words and as a recording") {
    const TemporaryFolder folder;
    const std::string log = folder.put("serial.log",
                                       "2024-01-02 10:00:00,050 - Connected to: Serial\n"
                                       "2024-01-02 10:00:00,100 - Send: N0 M110 N0*125\n"
                                       "2024-01-02 10:00:00,120 - Recv: ok\n"
                                       "2024-01-02 10:00:00,200 - Send: N1 G90*17\n"
                                       "2024-01-02 10:00:00,210 - Recv: ok T:92.1 /0.0 B:55.4 /0.0 @:0 B@:0\n"
                                       "2024-01-02 10:00:00,300 - Send: N2 G90*17\n");
    const Outcome text = run_program("decode " + log);
    CHECK(text.code == 0);
    const auto lines = lines_of(text.out);
    REQUIRE(lines.size() == 6);
    CHECK(lines[0].find("log             Connected to: Serial") != std::string::npos);
    CHECK(lines[1].find("2024-01-02 10:00:00,100  host → board    N0 M110 N0*125") != std::string::npos);
    CHECK(lines[4].find("board → host    ok T:92.1 /0.0 B:55.4") != std::string::npos);
    CHECK(lines[3].starts_with("  "));
    CHECK(lines[5].starts_with("! "));
    CHECK(lines[5].find("checksum 17 is wrong") != std::string::npos);
    const auto json = lines_of(run_program("decode --json " + log).out);
    CHECK(json.at(0).find("\"note\":\"Connected to: Serial\"") != std::string::npos);
    // And a recording again, notes and all.
    const std::string again = folder.put("again.jsonl", run_program("decode --json " + log).out);
    CHECK(lines_of(run_program("decode " + again).out).size() == 6);
    CHECK(run_program("replay --profile geeetech-a30t " + again).code == 0);
    CHECK(json.at(2).starts_with(R"({"t":0.07,"clock":"2024-01-02 10:00:00,120","from":"usb","line":"ok")"));
}

TEST_CASE("decode: a form that it does not know is said, line by line and in the end") {
    const TemporaryFolder folder;
    const Outcome other = run_program("decode " + folder.put("other.log", "[10:00:00] >> N0 M110 N0*125\n"));
    CHECK(other.code == 3);
    CHECK(other.out.find(":1: it begins with a date or a time, in a form that decode does not know") !=
          std::string::npos);
    CHECK(other.out.find("nothing here is of a form that decode knows") != std::string::npos);
    CHECK(run_program("decode " + folder.put("words.txt", "Dear diary,\n")).code == 3);
    CHECK(run_program("decode " + folder.put("own.txt", "M2999 S1\n")).code == 0);
    CHECK(run_program("decode " + folder.put("empty.txt", "\n")).code == 0);
}

TEST_CASE("decode: an end that nobody reads any more ends it") {
    const Outcome outcome = run_shell("yes M27 | " FAUXBOARD_PROGRAM " decode | head -n 1");
    CHECK(lines_of(outcome.out).size() == 1);
}

}  // namespace
}  // namespace fauxboard::test
