// The relatives of what people who wanted to break it did (broke_once_test.cpp): the same kinds of input, at
// other commands, files, channels and signals.

#include <fcntl.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/e2e/program.h"
#include "tests/support/dlp_bench.h"

namespace fauxboard::e2e {
namespace {

namespace fs = std::filesystem;

void put(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

constexpr const char* short_script =
    R"({"name": "play", "profile": "geeetech-a30t", "steps": [{"wait": "1s"}]})";

TEST_CASE("whatever is written into a pipe that nobody reads is refused, and not waited for") {
    const TemporaryFolder folder;
    fs::create_directory(folder.file("panel"));
    for (const char* name : {"pipe", "pipe.pcapng", "panel/panel.jsonl"}) {
        REQUIRE(::mkfifo(folder.file(name).c_str(), 0600) == 0);
    }
    put(folder.file("play.json"), short_script);
    put(folder.file("talk.jsonl"), "{\"t\": 1.0, \"from\": \"screen\", \"line\": \"N-0 M105*10\"}\n");
    testing::PanelPws wishes;
    wishes.layers = 1;
    put(folder.file("model.pws"), testing::make_panel_pws(wishes));
    const std::string pipe = folder.file("pipe");
    const Args dlp{"run", "--profile", "mks-dlp", "--duration", "1s", "--speed", "max"};
    const auto with = [](Args args, const std::string& option, const std::string& value) {
        args.insert(args.end(), {option, value});
        return args;
    };
    const Args script{"run", "-q", "--script", folder.file("play.json"), "--speed", "max"};
    for (const Args& args :
         {with(dlp, "--spi", pipe), with(dlp, "--spi", folder.file("pipe.pcapng")),
          with(dlp, "--panel", folder.file("panel")), with(script, "--report", pipe),
          with(script, "--junit", pipe), Args{"replay", folder.file("talk.jsonl"), "--plot", pipe},
          Args{"sliced", folder.file("model.pws"), "--layer", "0", "--png", pipe},
          Args{"tap", "pty", "pty", "--record", pipe}, Args{"tap", "pty", "pty", "--pcapng", pipe},
          Args{"screen", "--tcp", ":1", "tour", "--junit", pipe},
          Args{"screen", "--tcp", ":1", "tour", "--record", pipe}}) {
        CAPTURE(args.front());
        CAPTURE(args.back());
        const Result result = run(args);
        CHECK(result.code == bad_input);
        CHECK(contains(result.errors, "is a pipe that nobody reads"));
    }
}

TEST_CASE("a file that fails while it is read, or has no end, is a sentence everywhere") {
    const TemporaryFolder folder;
    fs::create_symlink("/proc/self/mem", folder.file("broken.acfg"));
    fs::create_symlink("/dev/zero", folder.file("endless.acfg"));
    REQUIRE(::mkfifo(folder.file("pipe.acfg").c_str(), 0600) == 0);
    std::ofstream(folder.file("huge.acfg")).close();
    fs::resize_file(folder.file("huge.acfg"), 50'000'000'000);
    for (const char* name : {"broken", "endless", "pipe", "huge"}) {
        CAPTURE(name);
        CHECK(run({"check", folder.file(std::string(name) + ".acfg")}).code == bad_input);
    }
    fs::create_symlink("/proc/self/mem", folder.file("talk.jsonl"));
    for (const Args& args :
         {Args{"replay", folder.file("talk.jsonl")}, Args{"replay", "--compare", folder.file("talk.jsonl")},
          Args{"decode", folder.file("talk.jsonl")}}) {
        const Result result = run(args);
        CHECK(result.code == bad_input);
        CHECK(contains(result.errors, "read"));
        CHECK_FALSE(contains(result.errors, "a bug"));
    }
}

TEST_CASE("what is no file is a sentence in every command that reads files") {
    const TemporaryFolder folder;
    REQUIRE(::mkfifo(folder.file("pipe").c_str(), 0600) == 0);
    fs::create_directory(folder.file("folder"));
    for (const std::string& file : {folder.file("pipe"), folder.file("folder"), std::string("/dev/zero"),
                                    std::string("/proc/self/mem")}) {
        for (const Args& args :
             {Args{"check"}, Args{"replay"}, Args{"replay", "--compare"}, Args{"sliced"}, Args{"fleet"},
              Args{"soak"}, Args{"soak", "geeetech-a30t", "--scenario"}, Args{"run", "--script"},
              Args{"run", "--profile"}, Args{"decode", "--profile"}, Args{"decode", "--screen"},
              Args{"describe", "--schema"}, Args{"screen", "--tcp", ":1", "show", "--screen"}}) {
            Args with = args;
            with.push_back(file);
            CAPTURE(file);
            CAPTURE(args.back());
            const Result result = run(with);
            CHECK(result.code == bad_input);
            CHECK_FALSE(contains(result.errors, "a bug"));
        }
        if (file != folder.file("pipe")) {  // which is a stream there
            CHECK(run({"decode", file}).code == bad_input);
        }
    }
}

TEST_CASE("two who would write one file: the second is told") {
    const TemporaryFolder folder;
    const std::string chip = folder.file("chip");
    const std::string talk = folder.file("talk.jsonl");
    const std::string panel = folder.file("panel");
    Program first({"run", "-q", "--profile", "mks-dlp", "--eeprom", chip, "--panel", panel});
    first.ready();
    Program recorder({"run", "-q", "--record", talk});
    recorder.ready();
    const auto second = [](const std::string& option, const std::string& value) {
        return Args{"run",        "-q", "--profile", option == "--record" ? "geeetech-a30t" : "mks-dlp",
                    "--duration", "1s", "--speed",   "max",
                    option,       value};
    };
    check_mistakes({{second("--eeprom", chip), bad_input, "is in use by a board that runs"},
                    {second("--panel", panel), bad_input, "is being written by another"},
                    {second("--record", talk), bad_input, "is being written by another"}});
    CHECK(first.stop() == 0);
    CHECK(recorder.stop() == 0);
    CHECK(run(second("--eeprom", chip)).code == 0);
    put(folder.file("fleet.json"), R"({"boards": [{"profile": "mks-dlp", "name": "a", "eeprom": ")" + chip +
                                       R"("}, {"profile": "mks-dlp", "name": "b", "eeprom": ")" + chip +
                                       R"("}]})");
    const Result fleet = run({"fleet", folder.file("fleet.json"), "--duration", "1s"});
    CHECK(fleet.code == bad_input);
    CHECK(contains(fleet.errors, "the EEPROM of a"));
}

TEST_CASE("any signal that asks to end takes every name with it, from boards, fleets and taps") {
    const TemporaryFolder folder;
    put(folder.file("fleet.json"),
        R"({"boards": [{"profile": "geeetech-a30t", "pty": ")" + folder.file("one") + R"("}]})");
    for (const int number : {SIGALRM, SIGXCPU, SIGIO, SIGPWR, SIGVTALRM, SIGRTMIN + 3, SIGQUIT, SIGUSR1}) {
        CAPTURE(number);
        Program board({"run", "-q", "--profile", "mks-dlp", "--spi", "pty=" + folder.file("wires"),
                       "--control", folder.file("control")});
        board.ready();
        Program fleet({"fleet", folder.file("fleet.json"), "-q"});
        fleet.ready();
        for (Program* const each : {&board, &fleet}) {
            each->signal(number);
            CHECK(each->wait() == 0);
        }
        for (const char* name : {"wires", "control", "one"}) {
            CHECK_FALSE(fs::exists(fs::symlink_status(folder.file(name))));
        }
    }
}

TEST_CASE("a page or a fleet that others can reach is warned of as well") {
    const TemporaryFolder folder;
    constexpr const char* warning = "can be reached from other computers";
    const Args board{"run", "-q", "--duration", "1s", "--speed", "max"};
    for (const auto& [option, value] :
         {std::pair{"--web", "=0.0.0.0:0/abcdefgh12345678"}, std::pair{"--udp", "=0.0.0.0:0"},
          std::pair{"--tcp", "=[::]:0"}, std::pair{"--host-tcp", "=0.0.0.0:0"}}) {
        Args args = board;
        args.push_back(std::string(option) + value);
        CAPTURE(args.back());
        CHECK(contains(run(args).errors, warning));
    }
    put(folder.file("fleet.json"), R"({"boards": [{"profile": "geeetech-a30t", "tcp": "0.0.0.0:0"}]})");
    CHECK(contains(run({"fleet", folder.file("fleet.json"), "--duration", "0.1s"}).errors, warning));
    CHECK_FALSE(contains(run({"run", "-q", "--web", "--duration", "1s", "--speed", "max"}).errors, warning));
}

}  // namespace
}  // namespace fauxboard::e2e
