// One file that a program was given for two purposes: it says so, before anything is opened or emptied.

#include <fcntl.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

namespace fs = std::filesystem;

constexpr const char* both = "are the same. Give each one of its own.";

void put(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Files of a user's, and other names for them.
struct Files {
    TemporaryFolder folder;
    std::string profile = folder.file("mine.json");
    std::string script = folder.file("play.json");
    std::string talk = folder.file("talk.jsonl");
    std::string board_name = folder.file("board");
    Program board{{"run", "-q", "--pty=" + board_name}};
    std::string port;

    Files() {
        put(profile, R"({"name": "mine", "extends": "geeetech-a30t"})");
        put(script, R"({"name": "play", "profile": "geeetech-a30t", "steps": [{"wait": "0.5s"}]})");
        put(talk, "{\"t\": 1.0, \"from\": \"screen\", \"line\": \"N-0 M105*10\"}\n");
        fs::create_symlink(talk, folder.file("symlink"));
        fs::create_hard_link(talk, folder.file("hardlink"));
        fs::create_directory(folder.file("sub"));
        port = board.ready()["path"];
    }
    Args run(const Args& more) const {
        Args args{"run", "-q", "--speed", "max", "--duration", "1s"};
        args.insert(args.end(), more.begin(), more.end());
        return args;
    }
};

TEST_CASE_FIXTURE(Files, "one file is not for two purposes, by whatever name") {
    const std::string x = folder.file("x");
    const std::string dlp = "mks-dlp";
    const auto refused = [](const Args& args) { return Mistake{args, bad_input, both}; };
    check_mistakes({
        refused(run({"--eeprom", x, "--record", x})),
        refused(run({"--eeprom", x, "--record", folder.file("sub/../x")})),
        refused(run({"--eeprom", x, "--record", x + ".job"})),
        refused(run({"--eeprom", x, "--log-file", x})),
        refused(run({"--eeprom", x + ".1", "--log-file", x})),
        refused(run({"--record", x, "--log-file", x})),
        refused(run({"--eeprom", x, "--control", x})),
        refused(run({"--pty=" + x, "--record", x})),
        refused(run({"--pty=" + x, "--host-pty=" + x})),
        refused(run({"--pty=" + x, "--control", x})),
        refused(run({"--port", port, "--host-port", board_name})),
        refused(run({"--port", port, "--record", board_name})),
        refused(run({"--profile", profile, "--record", profile})),
        refused(run({"--script", script, "--report", script})),
        refused(run({"--script", script, "--junit", script})),
        refused(run({"--script", script, "--junit", x, "--report", x})),
        refused(run({"--record", talk, "--log-file", folder.file("symlink")})),
        refused(run({"--record", folder.file("hardlink"), "--eeprom", folder.file("symlink")})),
        refused(run({"--profile", dlp, "--spi", x, "--eeprom", x})),
        refused(run({"--profile", dlp, "--spi", "pty=" + x, "--control", x})),
        refused(run({"--profile", dlp, "--panel", x, "--record", folder.file("x/panel.jsonl")})),
        refused(run({"--profile", dlp, "--panel", folder.file("sub"), "--udisk", folder.file("sub")})),
        refused({"replay", talk, "--plot", folder.file("symlink")}),
        refused({"sliced", talk, "--layer", "0", "--png", folder.file("hardlink")}),
        refused({"tap", "pty", "pty", "--record", x, "--pcapng", x}),
        refused({"tap", "pty=" + x, "pty=" + folder.file("sub/../x")}),
        refused({"tap", "pty=" + x, "pty", "--record", x}),
        refused({"screen", "--port", port, "--record", x, "tour", "--junit", x}),
        refused({"screen", "--port", port, "--record", board_name, "tour"}),
        refused({"ctl", talk, "screenshot", talk}),
    });
    CHECK(content(profile) == R"({"name": "mine", "extends": "geeetech-a30t"})");
    CHECK(content(script).starts_with(R"({"name": "play")"));
    CHECK(content(talk).starts_with("{\"t\": 1.0"));
    CHECK_FALSE(fs::exists(fs::symlink_status(x)));
    CHECK(board.stop() == 0);
}

TEST_CASE_FIXTURE(Files, "one file is not for two boards of a fleet, nor for one and the fleet's log") {
    const std::string x = folder.file("x");
    const auto fleet = [&](const std::string& boards, const Args& more = {}) {
        put(folder.file("fleet.json"), R"({"boards": [)" + boards + "]}");
        Args args{"fleet", "-q", folder.file("fleet.json"), "--duration", "0.1s"};
        args.insert(args.end(), more.begin(), more.end());
        return Mistake{args, bad_input, both};
    };
    const std::string with_eeprom = R"({"profile": "geeetech-a30t", "name": "a", "eeprom": ")" + x + "\"}";
    check_mistakes({fleet(with_eeprom + R"(, {"profile": "mks-dlp", "name": "b", "eeprom": ")" + x + "\"}")});
    check_mistakes(
        {fleet(with_eeprom + R"(, {"profile": "mks-dlp", "name": "b", "control": ")" + x + "\"}")});
    check_mistakes({fleet(with_eeprom, {"--log-file", x})});
    check_mistakes({fleet(R"({"profile": "mks-dlp"})", {"--log-file", folder.file("fleet.json")})});
    CHECK_FALSE(fs::exists(x));
    CHECK(content(folder.file("fleet.json")).starts_with(R"({"boards")"));
}

TEST_CASE_FIXTURE(Files, "what takes from many may be named twice, and what is only read") {
    CHECK(e2e::run(run({"--record", "/dev/null", "--script", script, "--report", "/dev/null"})).code == 0);
    const Args shared = run({"--sd", folder.file("sub"), "--record", folder.file("sub/talk.jsonl")});
    CHECK(e2e::run(shared).code == 0);
    put(folder.file("fleet.json"),
        R"({"boards": [{"profile": "mks-dlp", "count": 2, "udisk": ")" + folder.file("sub") + "\"}]}");
    CHECK(e2e::run({"fleet", "-q", folder.file("fleet.json"), "--duration", "0.1s"}).code == 0);
}

TEST_CASE("a folder for pictures in which others of these names are stays what it is") {
    const TemporaryFolder folder;
    const std::string panel = folder.file("panel");
    const Args args{"run", "-q",      "--profile", "mks-dlp",    "--panel",
                    panel, "--speed", "max",       "--duration", "1s"};
    fs::create_directory(panel);
    put(panel + "/000001.png", "a photograph");
    CHECK(contains(run(args).errors, "000001.png is not of --panel"));
    CHECK(content(panel + "/000001.png") == "a photograph");
    fs::remove(panel + "/000001.png");
    put(panel + "/panel.jsonl", "a list of my own\n");
    CHECK(contains(run(args).errors, "panel.jsonl is not of --panel"));
    CHECK(content(panel + "/panel.jsonl") == "a list of my own\n");
    put(panel + "/panel.jsonl", "{\"t\":1}\n");
    CHECK(run(args).code == 0);
}

TEST_CASE("a log's older name that is no plain file stays what it is") {
    const TemporaryFolder folder;
    REQUIRE(::mkfifo(folder.file("log.1").c_str(), 0600) == 0);
    const Result result = run({"run", "-q", "--log-file", folder.file("log"), "--duration", "1s"});
    CHECK(result.code == bad_input);
    CHECK(contains(result.errors, "log.1 is no log of fauxboard's"));
    CHECK(fs::is_fifo(folder.file("log.1")));
}

}  // namespace
}  // namespace fauxboard::e2e
