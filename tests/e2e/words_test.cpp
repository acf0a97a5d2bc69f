// What the program says of itself and of others, in a person's words and not in those of its libraries.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

/// The commands that the help of `path` lists.
std::vector<std::string> commands_below(const std::string& help) {
    std::vector<std::string> names;
    std::istringstream lines(help.substr(std::min(help.size(), help.find("Subcommands:"))));
    static const std::regex row("  ([a-z]+) .*");
    std::smatch found;
    for (std::string line; std::getline(lines, line) && !line.starts_with("Examples");) {
        if (std::regex_match(line, found, row)) {
            names.push_back(found[1]);
        }
    }
    return names;
}

TEST_CASE("no help has words that only the library of options knows") {
    static const std::regex leftovers(
        R"((\bTEXT\b|\bU?INT\b|\bFLOAT\b|\{false\}|\(\d+x\)|Value .* in range|:\{))");
    const std::vector<std::string> commands = commands_below(run({"--help"}).out);
    REQUIRE(commands.size() > 10);
    for (const std::string& command : commands) {
        const std::string help = run({command, "--help"}).out;
        CAPTURE(command);
        std::smatch found;
        CHECK_MESSAGE(!std::regex_search(help, found, leftovers), found.str());
        CHECK(contains(help, "Usage: fauxboard " + command));
    }
}

TEST_CASE("the help of a command of a command says all that has to be typed") {
    CHECK(contains(run({"ctl", "x", "get", "--help"}).out,
                   "Usage: fauxboard ctl PATH get [OPTIONS] [FIELD...]"));
    CHECK(contains(run({"ctl", "x", "fault", "add", "--help"}).out, "Usage: fauxboard ctl PATH fault add"));
    CHECK(contains(run({"screen", "press", "--help"}).out, "Usage: fauxboard screen press"));
}

TEST_CASE("a folder of FAUXBOARD_PROFILES that is of no use is told, and is none of those that are used") {
    const TemporaryFolder folder;
    const auto version = [](const std::string& folders) {
        ::setenv("FAUXBOARD_PROFILES", folders.c_str(), 1);
        Result result = run({"--version"});
        ::unsetenv("FAUXBOARD_PROFILES");
        return result;
    };
    const std::string empty = folder.file("empty");
    std::filesystem::create_directories(empty);
    const Result with_empty = version(empty);
    CHECK(contains(with_empty.errors, empty + ", which holds no profile"));
    const Result missing = version(folder.file("missing"));
    CHECK(contains(missing.errors, "missing, which is no folder; it is passed over"));
    CHECK_FALSE(contains(missing.out, "missing"));
    std::filesystem::create_directories(empty + "/screens");
    std::filesystem::copy_file(FAUXBOARD_SOURCE_DIR "/profiles/screens/geeetech-a30.json",
                               empty + "/screens/mine.json");
    const Result with_screen = version(empty);
    CHECK(with_screen.errors.empty());
    CHECK(contains(with_screen.out, empty));
}

TEST_CASE("send: who speaks as a host is called one, and a profile has words for its own codes") {
    Program host({"run", "-q", "--profile", "marlin", "--pty"});
    const Result asked = run({"send", "--bare", "--wait", "200", "--port", host.ready()["path"], "M105"});
    CHECK(contains(asked.out, "host → board    M105"));
    CHECK(contains(asked.out, "board → host    ok T:"));

    const TemporaryFolder folder;
    const std::string profile = folder.file("mine.json");
    std::ofstream(profile)
        << R"({"name": "mine", "extends": "geeetech-a30t", "requests": {"M2999": {"send": ["L2"]}}})";
    Program board({"run", "-q", "--no-pacing", "--profile", profile, "--pty"});
    const std::string path = board.ready()["path"];
    const Result own = run({"send", "--wait", "200", "--port", path, "--profile", profile, "M2999"});
    CHECK(contains(own.out, "screen → board  N-0 M2999*"));
    CHECK(contains(own.out, "M2999: the profile's own"));
    const Result unknown = run({"send", "--wait", "200", "--port", path, "M2999"});
    CHECK(contains(unknown.out, "M2999: in no table; a profile's own words come with --profile"));
    CHECK(run({"send", "--port", path, "--profile", "geeetech-a30x", "M2999"}).code == bad_input);
}

TEST_CASE("a fault of the printer from the start is told behind who it is") {
    const Result result = run({"run", "--pty", "--fault", "jam:at=1s", "--duration", "2s", "--speed", "max"});
    const std::size_t who = result.errors.find("This is fauxboard");
    const std::size_t done = result.errors.find("fault.set");
    REQUIRE(who != std::string::npos);
    REQUIRE(done != std::string::npos);
    CHECK(who < done);
}

TEST_CASE("ctl get leaves out what a board of another kind has") {
    const TemporaryFolder folder;
    const std::string control = folder.file("ctl");
    Program board({"run", "-q", "--pty", "--control", control});
    board.ready();
    const Result all = run({"ctl", control, "get"});
    CHECK(contains(all.out, "heaters.nozzle.target"));
    CHECK_FALSE(contains(all.out, "resin.z"));
    CHECK_FALSE(contains(all.out, "null"));
    CHECK(contains(run({"ctl", control, "get", "resin.z"}).out, "none: this board has no such thing"));
    CHECK(contains(run({"ctl", control, "send", "L99"}).errors, "it has L"));
}

}  // namespace
}  // namespace fauxboard::e2e
