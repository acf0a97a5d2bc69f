// What real clients of ChiTu boards trip over. Each trap has its test here, by its number; the table in
// tests/README.md says what each is about.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <regex>

#include "protocol/chitu_chunk.h"
#include "tests/support/chitu.h"
#include "tests/support/resin_bench.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

using Texts = std::vector<std::string>;

std::string first_line(const std::string& bytes) {
    return bytes.substr(0, bytes.find('\n') + 1);
}

}  // namespace

TEST_CASE("chitu trap 1: M4002 ends with LF alone, M4006 with CR LF and a name, idle too") {
    ResinBench bench;
    const std::regex version("^ok ([a-zA-Z0-9_.]+)\n$");
    const std::regex file("^ok '([^']+)'\r\n$");
    CHECK(std::regex_match(bench.ask("M4002"), version));
    CHECK(std::regex_match(bench.ask("M4006"), file));
    put_seed_stick(bench.disk);
    bench.ask(std::string("M6030 '") + seed_file + "'");
    CHECK(std::regex_match(bench.ask("M4006"), file));
    bench.ask("M33");
    CHECK(std::regex_match(bench.ask("M4006"), file));
    CHECK(bench.ask("M4000").ends_with(" \r\n"));
}

TEST_CASE("chitu trap 2: the byte position is 0 or exactly a layer's end, in M4000 and M27") {
    ResinBench bench;
    put_seed_stick(bench.disk);
    bench.ask(std::string("M6030 '") + seed_file + "'");
    const auto& ends = seed_content().layer_ends;
    std::size_t seen = 0;
    while (bench.number("job.active") == 1) {
        unsigned long place = 1;
        const std::string status = bench.ask("M4000", 0.01);
        const std::string bytes = bench.ask("M27", 0.01);
        REQUIRE(std::sscanf(status.c_str() + status.find(" D:"), " D:%lu/", &place) == 1);
        const bool at_end = place == 0 || std::find(ends.begin(), ends.end(), place) != ends.end();
        CHECK(at_end);
        unsigned long byte = 1;
        if (std::sscanf(bytes.c_str(), "SD printing byte %lu/", &byte) == 1) {
            CHECK((byte == place || std::find(ends.begin(), ends.end(), byte) != ends.end()));
            ++seen;
        }
        bench.run_for(0.7);
    }
    CHECK(seen > 20);
}

TEST_CASE("chitu trap 3: the first line comes well within 0.1 s, whatever was asked before") {
    ResinBench bench;
    put_seed_stick(bench.disk);
    for (const ChituVector& vector : load_chitu_vectors("chitu").vectors) {
        CAPTURE(vector.name);
        CHECK(bench.say(vector.send, 0.02).find_first_of("\n\x83") != std::string::npos);
        bench.ask("M33");
        bench.ask("M22");
    }
}

TEST_CASE("chitu trap 4: M28 and M29 say what the board says, and nothing of what a terminal shows") {
    ResinBench bench;
    std::string said = bench.ask("M28 test.txt");
    said += bench.ask("M29");
    CHECK(said == "Delete failed :TEST.TXT\r\nok N:0\r\nDone saving file!\r\n// TEST.TXT\r\nok N:0\r\n");
    for (const char* words : {"streaming", "All is well", "Finish writing"}) {
        CAPTURE(words);
        CHECK(said.find(words) == std::string::npos);
    }
}

TEST_CASE("chitu trap 5: M110 is answered with an ok, a NUL before it, with a line number and without") {
    ResinBench bench;
    const std::string answer("\0ok N:0\r\n", 9);
    CHECK(bench.ask("M110 N0") == answer);
    CHECK(bench.ask("N0 M110 N0*125") == answer);
    CHECK(bench.ask("N1 M105*38").starts_with("ok T:"));
}

TEST_CASE("chitu trap 6: each line of an answer is its own datagram; a request may end in any way") {
    ResinBench bench;
    bench.disk.put("a.ctb", "a");
    for (const std::string& end : {std::string(), std::string("\0\0", 2), std::string("\0", 1),
                                   std::string("\r\n"), std::string(" \r\n")}) {
        CHECK(bench.send("M20" + end) ==
              Texts{"Begin file list\r\n", "a.ctb 1\r\n", "End file list\r\n", "ok N:0\r\n"});
    }
}

TEST_CASE("chitu trap 7: an ok follows an Error line on Mars and Saturn, and none on a Photon") {
    for (const char* request : {"M27", "M33", "M29", "M6030 'x.ctb'", "M6032 'x.ctb'"}) {
        CAPTURE(request);
        for (const char* profile : {"elegoo-mars-pro", "elegoo-saturn"}) {
            ResinBench bench(profile);
            const Texts answers = bench.send(request);
            REQUIRE(answers.size() == 2);
            CHECK(answers[0].starts_with("Error:"));
            CHECK(answers[1] == "ok N:0\r\n");
        }
        ResinBench photon("anycubic-photon");
        const Texts answers = photon.send(request);
        REQUIRE(answers.size() == 1);
        CHECK(answers[0].starts_with("Error:"));
    }
}

TEST_CASE("chitu trap 8: M27 is two lines, of 4.4.3 in three pieces") {
    for (const char* profile : {"elegoo-mars-pro", "elegoo-saturn", "anycubic-photon", "chitu-4.4.3"}) {
        CAPTURE(profile);
        ResinBench bench(profile);
        put_seed_stick(bench.disk);
        bench.send(std::string("M6030 '") + seed_file + "'");
        bench.run_for(1);
        const Texts answers = bench.send("M27");
        const std::string size = std::to_string(seed_file_bytes);
        if (std::string_view(profile) == "chitu-4.4.3") {
            CHECK(answers == Texts{"SD N:1\r\n", "byte 0/" + size + "\r\n", "ok N:1\r\n"});
        } else {
            CHECK(answers == Texts{"SD printing byte 0/" + size + "\r\n", "ok N:0\r\n"});
        }
    }
}

TEST_CASE("chitu trap 9: a bad piece is answered by either form of resend, and nothing of it is written") {
    for (const auto& [profile, answer] : {std::pair{"elegoo-mars-pro", "resend 1280\r\n"},
                                          std::pair{"elegoo-saturn", "resend 1280,offset error:1280\r\n"}}) {
        const std::string name(profile);
        CAPTURE(name);
        ResinBench bench(profile);
        bench.send("M28 a.ctb");
        CHECK(bench.send(chunk(0, std::string(1280, 'a'))) == Texts{"ok\r\n"});
        std::string damaged = chunk(1280, "bbb");
        damaged[0] = 'c';
        for (const std::string& bad : {damaged, chunk(0, std::string(1280, 'a')), chunk(9999, "bbb")}) {
            CHECK(bench.send(bad) == Texts{answer});
        }
        CHECK(bench.send(chunk(1280, "bbb")) == Texts{"ok\r\n"});
        bench.send("M29");
        REQUIRE(bench.disk.content("a.ctb") != nullptr);
        CHECK(*bench.disk.content("a.ctb") == std::string(1280, 'a') + "bbb");
    }
}

TEST_CASE("chitu trap 10: a print and a download are named in every way that clients have") {
    for (const char* name : {"'%'", "':%'", "\"%\"", ":'%'", "'/%'"}) {
        CAPTURE(name);
        std::string asked(name);
        asked.replace(asked.find('%'), 1, seed_file);
        ResinBench bench;
        put_seed_stick(bench.disk);
        CHECK(bench.ask("M6032 " + asked) == "ok L:" + std::to_string(seed_file_bytes) + "\r\n");
        CHECK(first_line(bench.ask("M6030 " + asked)) == "ok N:0\r\n");
        CHECK(bench.number("job.active") == 1);
    }
}
