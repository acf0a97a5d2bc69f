// Exit codes, sentences and the small commands.

#include <algorithm>
#include <fstream>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

TEST_CASE("each mistake has its exit code and its sentence, and says nothing on stdout") {
    const std::vector<Mistake> mistakes{
        {{}, usage, "a command is missing; known: run fleet"},
        {{"frobnicate"}, usage, "there is no command 'frobnicate'"},
        {{"rum"}, usage, "did you mean 'run'?"},
        {{"run", "--frobnicate"}, usage, "--frobnicate"},
        {{"run", "extra"}, usage, "extra"},
        {{"run", "--speed", "0"}, usage, "expected a number"},
        {{"run", "--duration", "5parsec"}, usage, "5min"},
        {{"run", "--seed", "-1"}, usage, "--seed"},
        {{"run", "--baud", "0"}, usage, "--baud: '0' is no whole number from 50 to 4000000"},
        {{"run", "--baud", "fast"}, usage, "'fast' is no whole number"},
        {{"run", "--web", "nonsense"}, usage, "\"nonsense\" is not an address"},
        {{"run", "--spi"}, usage, "--spi needs a value FILE|pty[=LINK]|HOST:PORT"},
        {{"run", "-x"}, usage, "run: there is no option '-x'"},
        {{"screen", "-q", "--port", "x", "show"}, usage, "screen: there is no option '-q'"},
        {{"soak", "geeetech-a30t", "--years", "x"}, usage, "'x' is no number from 0 to 1000000"},
        {{"manual", "rum"}, usage, "did you mean 'run'?"},
        {{"replay", "/missing.jsonl"}, bad_input, "/missing.jsonl: there is no such file"},
        {{"replay", "/tmp"}, bad_input, "/tmp: it is no file"},
        {{"fleet", "/missing.json"}, bad_input, "there is no such file"},
        {{"run", "--pty", "--tcp", ":0"}, usage, "excludes"},
        {{"run", "--port", "auto", "--tcp", ":0"}, usage, "excludes"},
        {{"run", "-v", "-q"}, usage, "excludes"},
        {{"run", "--profile", "geeetech-a30x"}, bad_input, "did you mean \"geeetech-a30"},
        {{"run", "--profile", "/missing.json"}, bad_input, "/missing.json"},
        {{"run", "--profile", "/etc/passwd"}, bad_input, "not JSON"},
        {{"run", "--sd", "/missing"}, bad_input, "cannot be the SD card"},
        {{"run", "--udisk", "/tmp"}, bad_input, "\"udisk_port\": true"},
        {{"run", "--eeprom", "/missing/eeprom"}, bad_input, "cannot be written"},
        {{"run", "--record", "/missing/talk"}, bad_input, "cannot be written"},
        {{"run", "--port", "/dev/ttyMISSING"}, no_port, "/dev/ttyMISSING"},
        {{"run", "--tcp", "nonsense"}, usage, "nonsense"},
        {{"run", "--pty=/etc/passwd"}, no_port, "/etc/passwd"},
        {{"run", "--pty=/missing/name"}, no_port, "/missing/name"},
        {{"send", "M105"}, usage, "--port"},
        {{"send", "--port", "/dev/ttyMISSING"}, usage, "COMMAND"},
        {{"send", "--port", "/dev/ttyMISSING", "--tcp", ":1", "M105"}, usage, "--tcp"},
        {{"send", "--port", "/dev/ttyMISSING", "M104", "S200"}, usage, "quote"},
        {{"send", "--port", "/dev/ttyMISSING", "M105"}, no_port, "/dev/ttyMISSING"},
        {{"send", "--port", "/dev/ttyMISSING", "--wait", "0", "M105"}, usage, "--wait"},
        {{"tap", "a"}, usage, "found a; expected two ends"},
        {{"tap", "a", "b", "c"}, usage, "found a b c; expected two ends"},
        {{"screen"}, usage, "a command is missing; known: press tour show interactive"},
        {{"new", "profil", "x"}, usage, "expected profile or screen or scenario; did you mean 'profile'?"},
        {{"check"}, usage, "fauxboard check: FILE is required"},
        {{"run", "--log-level", "wran"}, usage, "expected one of trace, debug, info, warning, error, off"},
        {{"run", "--log-json"}, usage, "--log-file"},
        {{"run", "--log-file", "x", "--log-size", "10Q"}, usage, "expected bytes, or such as 64k, 10M, 1G"},
        {{"run", "--log-file", "x", "--log-size", "1k"}, usage, "no less than 4096"},
        {{"run", "--log-file", "x", "--log-size", "99999999999G"}, usage, "is no size for a log"},
        {{"run", "--log-file", "/etc/passwd"}, bad_input, "is no log of fauxboard's"},
        {{"run", "--log-file", "/missing/log"}, bad_input, "cannot be written"},
    };
    check_mistakes(mistakes);
}

TEST_CASE("help says what it is, and that it is no printer") {
    const Result help = run({"--help"});
    CHECK(help.code == 0);
    for (const char* part : {"not a printer", "run", "send", "profiles", "Examples:", "Exit codes:"}) {
        CAPTURE(std::string(part));
        CHECK(contains(help.out, part));
    }
    CHECK(contains(run({"run", "--help"}).out, "--duration"));
    CHECK(run({"--version"}).out.starts_with("fauxboard "));
}

TEST_CASE("lists, for people and for programs") {
    CHECK(contains(run({"profiles"}).out, "geeetech-a30t"));
    const auto profiles = nlohmann::json::parse(run({"profiles", "--json"}).out);
    REQUIRE(profiles.is_array());
    CHECK(std::any_of(profiles.begin(), profiles.end(),
                      [](const auto& p) { return p["name"] == "geeetech-a30"; }));
    CHECK(std::any_of(profiles.begin(), profiles.end(),
                      [](const auto& p) { return p["name"] == "geeetech-a30t" && p["kind"] == "screen"; }));
    CHECK(std::any_of(profiles.begin(), profiles.end(), [](const auto& p) {
        return p["name"] == "power-loss" && p["kind"] == "scenario" && p["title"] != "";
    }));
    CHECK(run({"ports"}).code == 0);
    CHECK(nlohmann::json::parse(run({"ports", "--json"}).out).is_array());
}

/// A frame without its line end.
std::string line(std::string_view body) {
    std::string text = frame(body);
    return text.substr(0, text.size() - 2);
}

TEST_CASE("send frames, shows what comes back, and knows when nothing does") {
    Program board({"run", "--no-pacing", "-q"});
    const std::string path = board.ready()["path"];
    const Result talk = run({"send", "--port", path, "--wait", "200", "M104 S222", line("M140 S55")});
    CHECK(talk.code == 0);
    CHECK(contains(talk.out, "N-0 M104 S222*"));
    CHECK(contains(talk.out, "/222.0"));
    CHECK(contains(talk.out, "/55.0"));
    const Result json = run({"send", "--port", path, "--wait", "200", "--json", "M105"});
    CHECK(json.code == 0);
    CHECK(nlohmann::json::parse(json.out.substr(0, json.out.find('\n')))["line"] == "N-0 M105*10");

    const link::test::OtherPty silent;
    const UniqueFd held = link::test::open_terminal(silent.path);
    const Result nothing = run({"send", "--port", silent.path, "--wait", "20", "--bare", "M105", "M9999"});
    CHECK(nothing.code == timed_out);
    CHECK(contains(nothing.errors, "nothing came back for 'M105'"));
    CHECK_FALSE(contains(nothing.errors, "M9999"));
    CHECK(link::test::take(silent.master.get()) == "M105\r\nM9999\r\n");
}

TEST_CASE("send: what had been said before is no answer, and shown on demand") {
    const link::test::OtherPty pty;
    const UniqueFd held = link::test::open_terminal(pty.path);
    const Args command{"send", "--port", pty.path, "--wait", "20", "--bare", "M9999"};
    link::test::say(pty.master.get(), "N-0 L14 old*1\r\nN-0 L14 old*1\r\n");
    const Result folded = run(command);
    CHECK_FALSE(contains(folded.out, "L14 old"));
    CHECK(contains(folded.out, "2 lines that had been said before left out; --all shows them"));
    link::test::say(pty.master.get(), "N-0 L14 old*1\r\n");
    Args all = command;
    all.insert(all.end() - 1, "--all");
    const Result whole = run(all);
    CHECK(contains(whole.out, "L14 old"));
    CHECK_FALSE(contains(whole.out, "left out"));
}

TEST_CASE("run: a log of its own doings, apart from the talk") {
    const TemporaryFolder folder;
    const std::string file = folder.file("own.log");
    const Result result = run({"run", "--speed", "max", "--duration", "5s", "--fault",
                               "filament_out:at=1s,for=2s", "--log-file", file, "--log-json", "-q"});
    CHECK(result.code == 0);
    std::ifstream in(file);
    std::vector<nlohmann::json> told;
    for (std::string text; std::getline(in, text);) {
        told.push_back(nlohmann::json::parse(text));
        CHECK(told.back().value("text", std::string()).find("N-0 L1 ") == std::string::npos);
    }
    const auto find = [&](std::string_view part) {
        const auto hit = std::find_if(told.begin(), told.end(), [&](const nlohmann::json& one) {
            return one.value("text", std::string()).find(part) != std::string::npos;
        });
        return hit == told.end() ? nlohmann::json::object() : *hit;
    };
    CHECK(find("begins")["what"] == "program");
    CHECK(find("geeetech-a30t.json")["level"] == "info");
    CHECK(find("fault p1, filament_out").value("t", 0.0) == 1.0);
    CHECK(find("is over").value("t", 0.0) == 3.0);
    CHECK(find("After 5.000 s")["what"] == "program");
}

}  // namespace
}  // namespace fauxboard::e2e
