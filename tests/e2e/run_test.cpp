// `fauxboard run` as its user has it: the real program, a real pseudo-terminal, a real socket.

#include <csignal>
#include <fstream>

#include "emulator/record/recording.h"
#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

namespace fs = std::filesystem;

/// A board without pacing on a pty, and a screen that has its boot messages behind it.
struct Live {
    explicit Live(Args more = {}) : program(with(std::move(more))), where(program.ready()), peer(path()) {
        // The answer to a target of its own cannot be one of the boot messages.
        REQUIRE(contains(peer.ask("M104 S111", "/111.0"), "L2 B:"));
    }
    static Args with(Args more) {
        more.insert(more.begin(), {"run", "--no-pacing", "-q"});
        return more;
    }
    std::string path() const { return where["path"]; }

    Program program;
    nlohmann::json where;
    Peer peer;
};

TEST_CASE("the first line says where the board is") {
    Program program({"run"});
    const auto ready = program.ready();
    CHECK(ready["profile"] == "geeetech-a30t");
    CHECK(ready["link"] == "pty");
    CHECK(ready["path"].get<std::string>().starts_with("/dev/pts/"));
    CHECK_FALSE(ready.contains("name"));
    CHECK(program.stop() == 0);
    CHECK(program.out().next() == "(end)");
    CHECK(program.errors().starts_with("This is fauxboard, an emulator: there is no real printer here."));
    CHECK(contains(program.errors(), " lines heard, "));
}

TEST_CASE("a link name is there while it runs, however it is ended") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2}) {
        CAPTURE(number);
        Program program({"run", "--pty=" + name});
        const auto ready = program.ready();
        CHECK(ready["name"] == name);
        CHECK(fs::read_symlink(name) == ready["path"].get<std::string>());
        program.signal(number);
        CHECK(program.wait() == 0);
        CHECK_FALSE(fs::exists(fs::symlink_status(name)));
    }
}

TEST_CASE("a name in use is refused, a name left by a killed program taken over") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    for (int tries = 0;; ++tries) {
        Program first({"run", "--pty=" + name});
        first.ready();
        CHECK(run({"run", "--pty=" + name}).code == 4);
        first.signal(SIGKILL);
        CHECK(first.wait() == 1000 + SIGKILL);
        REQUIRE(fs::is_symlink(name));
        const Result second = run({"run", "-q", "--pty=" + name, "--duration", "0.1s"});
        if (second.code == 0) {
            break;
        }
        // The number of the first one's pseudo-terminal may at once be somebody else's: the name is in use
        // again.
        REQUIRE(contains(second.errors, "somebody may be using it"));
        REQUIRE(tries < 20);
        fs::remove(name);
    }
}

TEST_CASE("the boot burst comes to whoever opens the line first, paced, and requests are answered") {
    Program program({"run", "-q"});
    Peer peer(program.ready()["path"]);
    for (const char* code : {"L3 ", "L1 ", "L2 ", "L3 ", "L9 ", "L7 begin", "L7 P0", "L7 P1", "L7 end",
                             "L22 ", "L24 P3", "L24 P3", "L24 P3", "L24 P3", "L23 ", "L23 "}) {
        CHECK(peer.lines().next().starts_with(std::string("N-0 ") + code));
    }
    CHECK(contains(peer.ask("M104 S200", "/200.0"), "T0:"));
    CHECK(program.stop() == 0);
    CHECK(peer.lines().find("(end)") == "(end)");
}

TEST_CASE("three requests in one write, one request in thirty") {
    Live live;
    live.peer.say(frame("M104 S201") + frame("M140 S51") + frame("M104 S202"));
    CHECK(contains(live.peer.lines().next(), "/201.0"));
    CHECK(contains(live.peer.lines().next(), "/51.0"));
    CHECK(contains(live.peer.lines().next(), "/202.0"));
    const std::string request = frame("M104 S123") + frame("M104 S124");
    REQUIRE(request.size() > 30);
    for (const char c : request)
        live.peer.say({&c, 1});
    CHECK(contains(live.peer.lines().find("/123.0"), "L2"));
    CHECK(contains(live.peer.lines().find("/124.0"), "L2"));
}

TEST_CASE("bad input is survived, and the next good request answered") {
    Live live;
    live.peer.say("N-0 M104 S200*1\r\nN-0 M104 S200\r\n*\n**\r\r\r\nN-0 *\nM105\n");
    live.peer.say(std::string("\0\0\0N-0\0 \xFF\xFE\x80*12\n", 16));
    live.peer.say(frame("G28 X") + frame("M290 Z") + frame("M2107 S99") + frame("M2135 P-1") + frame("M23") +
                  frame("M20 file:SD1:/../..") + frame("M104 Snan") + frame("M9999") + frame("Q1"));
    live.peer.say(std::string(200'000, 'N'));
    live.peer.say("\r\n");
    CHECK(contains(live.peer.ask("M104 S222", "/222.0"), "L2"));
    CHECK(live.program.stop() == 0);
}

TEST_CASE("the screen may go and come back; the printer goes on") {
    Program program({"run", "--no-pacing", "--json"});
    const std::string path = program.ready()["path"];
    {
        Peer peer(path);
        CHECK(contains(peer.ask("M104 S222", "/222.0"), "L2"));
    }
    CHECK(contains(program.out().find("was closed at its other end"), "waiting"));
    for (int i = 0; i < 3; ++i) {
        Peer peer(path);
        CHECK(contains(peer.ask("M105", "/222.0"), "L2"));
    }
    CHECK(program.stop() == 0);
}

TEST_CASE("a socket on a free port; a client may go, and the next one come") {
    Program program({"run", "--no-pacing", "-q", "--tcp", "127.0.0.1:0"});
    const auto ready = program.ready();
    CHECK(ready["link"] == "tcp");
    const std::string path = ready["path"];
    CHECK(path.starts_with("127.0.0.1:"));
    CHECK_FALSE(path.ends_with(":0"));
    {
        Peer peer(path);
        CHECK(contains(peer.ask("M104 S222", "/222.0"), "L2"));
    }
    // The board may turn a client away that comes before it has seen the last one go.
    std::string answer;
    for (int i = 0; i < 1000 && !contains(answer, "L2"); ++i) {
        Peer peer(path);
        answer = peer.ask("M105", "/222.0");
    }
    CHECK(contains(answer, "L2"));
    CHECK(run({"run", "--tcp", path}).code == 4);
    CHECK(program.stop() == 0);
}

TEST_CASE("a screen that never reads holds up nothing") {
    Live live;
    std::string requests;
    for (int i = 0; i < 100; ++i)
        requests += frame("M105");
    for (int i = 0; i < 100; ++i)
        live.peer.say(requests);
    live.peer.say(frame("M140 S77"));
    // It has all been taken in; what did not fit on the line is lost, and the line works on.
    std::string answer;
    for (int i = 0; i < 100'000 && !contains(answer, "/77.0") && answer != "(silence)"; ++i) {
        if (i % 50 == 0) {
            live.peer.say(frame("M105"));
        }
        answer = live.peer.lines().next();
    }
    CHECK(contains(answer, "/77.0"));
    CHECK(live.program.stop() == 0);
    CHECK_FALSE(live.program.errors().ends_with(", lost 0.\n"));
}

TEST_CASE("the EEPROM outlives the program") {
    const TemporaryFolder folder;
    const Args args{"--eeprom", folder.file("eeprom")};
    {
        Live live(args);
        CHECK(contains(live.peer.ask("M92 X91.5", "L24 P0"), "91.5"));
        live.peer.say(frame("M500"));
        CHECK(contains(live.peer.ask("M104 S222", "/222.0"), "L2"));
        live.program.signal(SIGKILL);
        live.program.wait();
    }
    {
        Live live(args);
        CHECK(contains(live.peer.ask("M2140 S0", "L24 P0"), "91.5"));
        CHECK(live.program.stop() == 0);
    }
    std::ofstream(folder.file("eeprom"), std::ios::app) << "edited\n";
    Live live(args);
    CHECK_FALSE(contains(live.peer.ask("M2140 S0", "L24 P0"), "91.5"));
    CHECK(contains(live.program.errors(), "is broken"));
    CHECK(fs::exists(folder.file("eeprom.broken")));
}

TEST_CASE("a recording holds the whole talk") {
    const TemporaryFolder folder;
    const std::string file = folder.file("talk.jsonl");
    Live live({"--record", file});
    CHECK(live.program.stop() == 0);
    const auto lines = record::load_recording(file);
    REQUIRE(lines.size() > 17);
    CHECK(lines.front().bytes.starts_with("N-0 L3 "));
    std::size_t at = 0;
    while (at < lines.size() && lines[at].from != record::RecordedLine::From::screen)
        ++at;
    REQUIRE(at + 1 < lines.size());
    CHECK(lines[at].bytes + "\r\n" == frame("M104 S111"));
    CHECK(contains(lines[at + 1].bytes, "/111.0"));
    for (std::size_t i = 1; i < lines.size(); ++i)
        CHECK(lines[i].t >= lines[i - 1].t);
}

void write(const std::string& file, std::string_view text) {
    std::ofstream(file + ".tmp") << text;
    fs::rename(file + ".tmp", file);
}

TEST_CASE("a folder is the SD card") {
    const TemporaryFolder folder;
    fs::create_directory(folder.file("sub"));
    std::ofstream(folder.file("cube.gcode")) << "G28\n";
    Live live({"--sd", folder.file("")});
    CHECK(contains(live.peer.ask("M20 LCD", "begin file list"), "L7"));
    CHECK(contains(live.peer.lines().next(), "L7 P0 cube.gcode"));
    CHECK(contains(live.peer.lines().next(), "L7 P1 sub"));
}

TEST_CASE("another folder is the U-disk, where the board has a port for one") {
    const TemporaryFolder folder;
    fs::create_directory(folder.file("card"));
    fs::create_directory(folder.file("stick"));
    std::ofstream(folder.file("card/cube.gcode")) << "G28\n";
    std::ofstream(folder.file("stick/vase.gcode")) << "G28\n";
    const std::string profile = folder.file("mine.json");
    write(profile, R"({"name": "mine", "extends": "geeetech-a30t", "machine": {"udisk_port": true}})");
    Live live({"--profile", profile, "--sd", folder.file("card"), "--udisk", folder.file("stick")});
    live.peer.say(frame("M2115 S1"));
    CHECK(contains(live.peer.ask("M20 LCD", "begin file list"), "L7"));
    CHECK(contains(live.peer.lines().next(), "L7 P0 vase.gcode"));
    CHECK(contains(live.peer.lines().next(), "L7 end"));
    live.peer.say(frame("M2115 S0"));
    CHECK(contains(live.peer.ask("M20 LCD", "begin file list"), "L7"));
    CHECK(contains(live.peer.lines().next(), "L7 P0 cube.gcode"));
    CHECK(live.program.stop() == 0);
    const Result missing = run({"run", "--profile", profile, "--udisk", folder.file("missing")});
    CHECK(missing.code == 3);
    CHECK(contains(missing.errors, "cannot be the U-disk"));
}

TEST_CASE("a changed profile is taken over while it runs; a wrong one is told of and left alone") {
    const TemporaryFolder folder;
    const std::string file = folder.file("mine.json");
    const auto profile = [](std::string_view words) {
        return R"({"name": "mine", "extends": "geeetech-a30t", "frames": {"L2": ")" + std::string(words) +
               "\"}}";
    };
    write(file, profile("L2 first"));
    Program program({"run", "--no-pacing", "--json", "--profile", file});
    const auto ready = program.ready();
    CHECK(ready["profile"] == "mine");
    Peer peer(ready["path"]);
    CHECK(peer.ask("M105", "first") + "\r\n" == frame("L2 first"));
    write(file, profile("L2 {no.such.field}"));
    CHECK(contains(program.out().find("stays in force"), "error"));
    CHECK(contains(program.out().find("no.such.field"), "error"));
    peer.lines().drop();
    CHECK(peer.ask("M105", "L2") + "\r\n" == frame("L2 first"));
    write(file, profile("L2 second"));
    CHECK(contains(program.out().find("is in force"), "info"));
    CHECK(peer.ask("M105", "second") + "\r\n" == frame("L2 second"));
    CHECK(program.stop() == 0);
}

TEST_CASE("the log on stdout is JSON, each line of it") {
    Program program({"run", "--json", "--speed", "max", "--duration", "10min"});
    program.ready();
    int from_board = 0;
    for (std::string line = program.out().next(); line != "(end)"; line = program.out().next()) {
        REQUIRE(line != "(silence)");
        const auto json = nlohmann::json::parse(line);
        CHECK(json["t"].is_number());
        from_board += json.value("from", "") == "board" ? 1 : 0;
    }
    CHECK(from_board > 100);
    CHECK(program.wait() == 0);
}

TEST_CASE("a day at full speed is over at once, and the same seed gives the same day") {
    const TemporaryFolder folder;
    std::vector<std::string> days;
    for (const char* seed : {"7", "7", "8"}) {
        const std::string file = folder.file("day" + std::to_string(days.size()));
        const Result result =
            run({"run", "-q", "--speed", "max", "--duration", "24h", "--seed", seed, "--record", file});
        CHECK(result.code == 0);
        CHECK(contains(result.errors, "After 86400.000 s"));
        std::ifstream in(file, std::ios::binary);
        days.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    CHECK(days[0].size() > 1'000'000);
    CHECK(days[0] == days[1]);
}

TEST_CASE("nobody needs to read stdout") {
    const Args args{"run", "--json", "--speed", "max", "--duration", "1min"};
    CHECK(Program(args, Program::Stdout::closed).wait() == 0);
    CHECK(Program(args, Program::Stdout::broken).wait() == 0);
    Program unread({"run", "--json", "--speed", "max", "--duration", "10h"});
    CHECK(unread.wait() == 0);
}

TEST_CASE("a full disk ends the recording, not the board") {
    const Result result = run({"run", "-q", "--speed", "max", "--duration", "1min", "--record", "/dev/full"});
    CHECK(result.code == 0);
    CHECK(contains(result.errors, "the recording /dev/full ends here"));
}

}  // namespace
}  // namespace fauxboard::e2e
