// What people who wanted to break it did: the real program against broken files, full outputs, odd terminals,
// signals and limits.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

namespace fs = std::filesystem;

void put(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::string small_profile(const std::string& more = "") {
    return "{\n  \"name\": \"mine\", \"extends\": \"geeetech-a30t\"" + more + "\n}\n";
}

bool has_escape(const std::string& text) {
    return text.find('\x1b') != std::string::npos;
}

TEST_CASE("a live profile that becomes unreadable is said, and the one before stays in force") {
    const TemporaryFolder folder;
    const std::string file = folder.file("mine.json");
    put(file, small_profile());
    Program program({"run", "--no-pacing", "--json", "--profile", file});
    Peer peer(program.ready()["path"]);
    CHECK(contains(peer.ask("M104 S111", "/111.0"), "L2 B:"));
    // This file opens, calls itself plain, and fails while it is read.
    fs::create_symlink("/proc/self/mem", folder.file("new.json"));
    fs::rename(folder.file("new.json"), file);
    CHECK(contains(program.out().find("stays in force"), "\"level\": \"error\""));
    CHECK(contains(program.out().find("it cannot be read (Input/output error)"), "mine.json"));
    CHECK(contains(peer.ask("M104 S112", "/112.0"), "L2 B:"));
    CHECK(program.stop() == 0);
}

TEST_CASE("check and include: a file that fails while it is read is a sentence") {
    const TemporaryFolder folder;
    fs::create_symlink("/proc/self/mem", folder.file("broken.json"));
    put(folder.file("heir.json"), "{\"name\": \"heir\", \"extends\": \"./broken.json\"}");
    put(folder.file("play.json"), "{\"name\": \"play\", \"steps\": [{\"include\": \"./broken.json\"}]}");
    for (const char* name : {"broken.json", "heir.json"}) {
        const Result result = run({"check", folder.file(name)});
        CAPTURE(name);
        CHECK((result.code == failed || result.code == bad_input));
        CHECK(contains(result.out + result.errors, "broken.json: it cannot be read (Input/output error)"));
    }
    const Result played = run({"run", "--script", folder.file("play.json"), "--speed", "max"});
    CHECK(played.code == bad_input);
    CHECK(contains(played.errors, "cannot be read"));
    REQUIRE(::mkfifo(folder.file("pipe.json").c_str(), 0600) == 0);
    CHECK(run({"check", folder.file("pipe.json")}).code == bad_input);  // and does not wait
    CHECK(run({"check", "/dev/zero"}).code == bad_input);
    CHECK(run({"decode", "/dev/zero"}).code == bad_input);
}

TEST_CASE("no text of a profile, a file's name or the line steers the terminal") {
    const TemporaryFolder folder;
    const std::string file = folder.file("mine.json");
    put(file, small_profile(", \"title\": \"\\u001b[2J\\u009b31mnice\""));
    ::setenv("FAUXBOARD_PROFILES", folder.file("").c_str(), 1);
    CHECK_FALSE(has_escape(run({"profiles"}).out));
    ::unsetenv("FAUXBOARD_PROFILES");
    put(folder.file("wrong\x1b[31m.json"), "{\"\\u001b[5m\": 1}");
    const Result checked = run({"check", folder.file("wrong\x1b[31m.json")});
    CHECK(checked.code == failed);
    CHECK_FALSE(has_escape(checked.out + checked.errors));
    CHECK_FALSE(has_escape(run({"check", "no\x1b[31msuch"}).out));
    CHECK_FALSE(has_escape(run({"\x1b[31m"}).errors));
    CHECK_FALSE(has_escape(run({"run", "--duration", "\x1b[31m"}).errors));

    fs::create_directory(folder.file("sd"));
    fs::create_directory(
        folder.file("sd/a\xc2\x9b"
                    "31m"));
    Program program({"run", "--no-pacing", "--profile", file, "--sd", folder.file("sd"), "--control",
                     folder.file("ctl"), "--host-pty"});
    const auto ready = program.ready();
    Peer screen(ready["path"]);
    Peer host(ready["host"]["path"]);
    screen.say("N-0 M2133 \x1b[2J*1\r\n\x1b]0;title\x07\r\n");
    host.say("M117 \x1b[2J\n\x1b[31mWORD\nM105\n");
    CHECK(contains(host.lines().find("T:"), "T:"));
    screen.ask("M104 S111", "/111.0");
    for (const Args& args :
         {Args{"ctl", folder.file("ctl"), "get"}, Args{"ctl", folder.file("ctl"), "status"}}) {
        CHECK_FALSE(has_escape(run(args).out));
    }
    CHECK(program.stop() == 0);
    CHECK_FALSE(has_escape(program.errors()));
    CHECK(program.errors().find("\xc2\x9b") == std::string::npos);
}

TEST_CASE("files that are somebody else's: the place of a job, an EEPROM in use") {
    const TemporaryFolder folder;
    put(folder.file("own.job"), std::string(362, 'f'));
    const Result refused = run({"run", "--eeprom", folder.file("own"), "--duration", "1s"});
    CHECK(refused.code == bad_input);
    CHECK(contains(refused.errors, "own.job"));
    CHECK(fs::file_size(folder.file("own.job")) == 362);

    Program first({"run", "-q", "--eeprom", folder.file("shared")});
    first.ready();
    const Result second = run({"run", "--eeprom", folder.file("shared"), "--duration", "1s"});
    CHECK(second.code == bad_input);
    CHECK(contains(second.errors, "is in use by a board that runs"));
    CHECK(first.stop() == 0);
    CHECK(run({"run", "-q", "--eeprom", folder.file("shared"), "--speed", "max", "--duration", "1s"}).code ==
          0);
}

TEST_CASE("a recording into a pipe that nobody reads is refused at once") {
    const TemporaryFolder folder;
    REQUIRE(::mkfifo(folder.file("pipe").c_str(), 0600) == 0);
    const Result result = run({"run", "--record", folder.file("pipe"), "--duration", "1s"});
    CHECK(result.code == bad_input);
    CHECK(contains(result.errors, "a pipe that nobody reads"));
}

TEST_CASE("a file as large as may be ends the recording, not the board") {
    const TemporaryFolder folder;
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const rlimit small{1000, before.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    const auto old = std::signal(SIGXFSZ, SIG_IGN);  // this program's own files, too
    const Result result =
        run({"run", "-q", "--speed", "max", "--duration", "60s", "--record", folder.file("talk.jsonl")});
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, old);
    CHECK(result.code == 0);
    CHECK(contains(result.errors, "ends here, after"));
    CHECK(fs::file_size(folder.file("talk.jsonl")) <= 1000);
}

TEST_CASE("where the ready line can never be written nobody waits for it") {
    Program program({"run", "--duration", "10min"}, Program::Stdout::full);
    CHECK(program.wait() == bad_input);
    CHECK(contains(program.errors(), "The line \"ready\" cannot be written to stdout"));
}

TEST_CASE("who binds beyond this computer is warned") {
    const Result open = run({"run", "--tcp", "0.0.0.0:0", "--duration", "1s", "--speed", "max"});
    CHECK(open.code == 0);
    CHECK(contains(open.errors, "can be reached from other computers"));
    const Result closed = run({"run", "--tcp", ":0", "--duration", "1s", "--speed", "max"});
    CHECK_FALSE(contains(closed.errors, "can be reached from other computers"));
}

TEST_CASE("days are a time, as everywhere in the reference") {
    CHECK(run({"run", "-q", "--duration", "0.001d", "--speed", "max"}).code == 0);
    CHECK(run({"run", "-q", "--duration", "1day"}).code == usage);
}

TEST_CASE("what belongs to this user alone is for this user alone") {
    const TemporaryFolder folder;
    Program program({"run", "-q", "--no-pacing", "--eeprom", folder.file("settings")});
    Peer peer(program.ready()["path"]);
    peer.ask("M104 S111", "/111.0");
    CHECK(program.stop() == 0);
    CHECK((fs::status(folder.file("settings.job")).permissions() & fs::perms::others_all) == fs::perms::none);
}

TEST_CASE("a password that the line sets is in nothing that is made to be shown to others") {
    const TemporaryFolder folder;
    put(folder.file("play.json"), R"({"name": "play", "profile": "elegoo-mars-pro", "steps": [{"wait": "1s"},
        {"request": "M9003 \"home\",\"hunter2\""}, {"wait": "1s"}, {"expect": "^NEVER", "within": "1s"}]})");
    const auto text_of = [&](const char* name) {
        std::ifstream in(folder.file(name), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (const bool json : {false, true}) {
        Args args{"run",         "-v",
                  "--script",    folder.file("play.json"),
                  "--speed",     "max",
                  "--report",    folder.file("report"),
                  "--junit",     folder.file("junit"),
                  "--record",    folder.file("talk"),
                  "--log-file",  folder.file("log"),
                  "--log-level", "trace"};
        if (json) {
            args.emplace_back("--json");
        }
        const Result played = run(args);
        CHECK(played.code == failed);
        CHECK(contains(played.out + played.errors, "M9003"));
        CHECK_FALSE(contains(played.out + played.errors, "hunter2"));
        for (const char* name : {"report", "junit", "talk", "log"}) {
            CAPTURE(name);
            CHECK_FALSE(text_of(name).empty());
            CHECK_FALSE(contains(text_of(name), "hunter2"));
        }
    }

    Program board({"run", "-q", "--profile", "elegoo-mars-pro", "--no-pacing",
                   "--pty=" + folder.file("board"), "--control", folder.file("ctl")});
    board.ready();
    Program tap({"tap", "pty=" + folder.file("end"), folder.file("board"), "--pcapng", folder.file("pcapng"),
                 "--record", folder.file("tapped"), "--decode"});
    tap.ready();
    const Result sent = run({"send", "--bare", "--port", folder.file("end"), "M9003 \"home\",\"hunter2\""});
    CHECK(contains(sent.out, "ok"));
    CHECK_FALSE(contains(sent.out + sent.errors, "hunter2"));
    CHECK(tap.stop() == 0);
    CHECK_FALSE(contains(tap.errors(), "hunter2"));
    CHECK(board.stop() == 0);
    for (const char* name : {"pcapng", "tapped"}) {
        CHECK(contains(text_of(name), "M9003"));
        CHECK_FALSE(contains(text_of(name), "hunter2"));
    }
    put(folder.file("serial.log"), "M9003 \"home\",\"hunter2\"\n");
    CHECK_FALSE(contains(run({"decode", folder.file("serial.log")}).out, "hunter2"));
}

}  // namespace
}  // namespace fauxboard::e2e
