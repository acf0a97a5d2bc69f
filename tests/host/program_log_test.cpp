// The program's log of its own doings, and the files that it is kept in.

#include "emulator/host/program_log.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "emulator/link/host_error.h"
#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

using namespace std::chrono_literals;
using board::Channel;
using board::Level;
using board::Verdict;
using link::test::contains;
namespace fs = std::filesystem;

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

std::vector<std::string> lines_of(const std::string& file) {
    std::istringstream in(text_of(file));
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);) {
        out.push_back(line);
    }
    return out;
}

void put(const std::string& file, std::string_view text) {
    std::ofstream(file, std::ios::binary) << text;
}

LogFile::Options options(const std::string& path, bool json = false) {
    return {path, 4096, 3, ProgramLog::head(json)};
}

/// One of each that may be told.
void do_all(ProgramLog& log) {
    log.on_sent(1s, Channel::main, "L1 X0");
    log.on_received(1s, Channel::main, "M105", Verdict::accepted);
    log.on_event(1s, machine::events().front());
    log.on_received(2s, Channel::main, "M9003 \"home\",\"secret\"\x1b", Verdict::bad_frame);
    log.on_deed(3s, Channel::main, {2, fault::Direction::to_screen, "drop", "L1 X0"});
    log.on_world(4s, "filament in");
    log.on_fault(5s, "fault 2 is on the line");
    log.on_link(6s, link::LinkState::up, "somebody came");
    log.on_notice(7s, Level::warning, "taken as 250");
    log.on_notice(8s, Level::error, "no more\nroom");
}

TEST_CASE("each level tells what is its own, and of all lines none that was simply said") {
    const std::pair<LogLevel, std::size_t> expected[] = {{LogLevel::trace, 8}, {LogLevel::debug, 7},
                                                         {LogLevel::info, 5},  {LogLevel::warning, 2},
                                                         {LogLevel::error, 1}, {LogLevel::off, 0}};
    for (const auto& row : expected) {
        const LogLevel level = row.first;
        CAPTURE(level_name(level));
        const link::test::TemporaryFolder folder;
        LogFile file(options(folder.file("log")), {});
        ProgramLog log(file, {level, false, ""});
        do_all(log);
        CHECK(lines_of(folder.file("log")).size() == row.second + 1);
        CHECK(log_level(level_name(level)) == level);
    }
    CHECK_FALSE(log_level("loud"));
}

TEST_CASE("a line has the calendar's time, the board's, level, kind and words; nothing steers a terminal") {
    const link::test::TemporaryFolder folder;
    LogFile file(options(folder.file("log")), {});
    ProgramLog log(file, {LogLevel::trace, false, ""});
    do_all(log);
    const auto lines = lines_of(folder.file("log"));
    REQUIRE(lines.size() == 9);
    CHECK(lines[0] == "# fauxboard's log");
    REQUIRE(lines[4].size() > 27);
    CHECK(lines[4].substr(4, 1) == "-");
    CHECK(lines[4].substr(26, 1) == "Z");
    CHECK(lines[4].substr(27) == "      4.000000  info     done     filament in");
    CHECK(contains(lines[2], "debug    refused  bad frame from screen: M9003 \"home\",\"***\""));
    CHECK_FALSE(contains(text_of(folder.file("log")), "secret"));
    CHECK_FALSE(contains(text_of(folder.file("log")), "\x1b"));
    CHECK(contains(lines[3], "fault 2: drop to screen: L1 X0"));
    CHECK(contains(lines[8], "no more\\x0Aroom"));
    struct stat info {};
    REQUIRE(::stat(folder.file("log").c_str(), &info) == 0);
    CHECK((info.st_mode & 0777) == 0600);
}

TEST_CASE("as JSON, and of several boards") {
    const link::test::TemporaryFolder folder;
    LogFile file(options(folder.file("log"), true), {});
    ProgramLog log(file, {LogLevel::info, true, "left"});
    do_all(log);
    const auto lines = lines_of(folder.file("log"));
    REQUIRE(lines.size() == 6);
    CHECK(nlohmann::json::parse(lines[0])["log"] == "fauxboard");
    const auto done = nlohmann::json::parse(lines[1]);
    CHECK(done["t"] == 4.0);
    CHECK(done["level"] == "info");
    CHECK(done["what"] == "done");
    CHECK(done["text"] == "filament in");
    CHECK(done["board"] == "left");
    CHECK(nlohmann::json::parse(lines[5])["text"] == "no more\nroom");
}

TEST_CASE("a file is followed by the next at its size, and the oldest goes") {
    const link::test::TemporaryFolder folder;
    const std::string path = folder.file("log");
    LogFile file(options(path), {});
    for (int i = 0; i < 1000; ++i) {
        file.write("line " + std::to_string(i) + " " + std::string(40, '.'));
    }
    std::vector<std::string> all;
    for (const char* end : {".2", ".1", ""}) {
        CHECK(fs::file_size(path + end) <= 4096);
        const auto lines = lines_of(path + end);
        REQUIRE(lines.size() > 1);
        CHECK(lines[0] == LogFile::text_mark);
        all.insert(all.end(), lines.begin() + 1, lines.end());
    }
    CHECK_FALSE(fs::exists(path + ".3"));
    REQUIRE(all.size() > 100);
    for (std::size_t i = 0; i < all.size(); ++i) {  // the last of them, none lost in between
        CHECK(all[i].starts_with("line " + std::to_string(1000 - all.size() + i) + " "));
    }
}

TEST_CASE("one file alone begins anew") {
    const link::test::TemporaryFolder folder;
    LogFile file({folder.file("log"), 4096, 1, std::string(LogFile::text_mark)}, {});
    for (int i = 0; i < 200; ++i) {
        file.write(std::string(50, 'x'));
    }
    CHECK(fs::file_size(folder.file("log")) <= 4096);
    CHECK_FALSE(fs::exists(folder.file("log.1")));
}

TEST_CASE("it goes on where a former run ended; another form begins a file of its own") {
    const link::test::TemporaryFolder folder;
    const std::string path = folder.file("log");
    { LogFile(options(path), {}).write("one"); }
    { LogFile(options(path), {}).write("two"); }
    CHECK(lines_of(path) == std::vector<std::string>{"# fauxboard's log", "one", "two"});
    { LogFile(options(path, true), {}).write("{}"); }
    CHECK(lines_of(path).size() == 2);
    CHECK(lines_of(path + ".1").size() == 3);
}

TEST_CASE("what is not ours is never written over, nor shared") {
    const link::test::TemporaryFolder folder;
    const std::string path = folder.file("log");
    put(path, "{\"a profile\": 1}");
    CHECK_THROWS_WITH_AS(LogFile(options(path), {}), doctest::Contains("is no log of fauxboard's"),
                         link::HostError);
    fs::remove(path);
    put(path + ".2", "mine");
    CHECK_THROWS_WITH_AS(LogFile(options(path), {}), doctest::Contains("log.2 is no log"), link::HostError);
    fs::remove(path + ".2");
    std::vector<std::string> troubles;
    LogFile file(options(path), [&](std::string_view text) { troubles.emplace_back(text); });
    CHECK_THROWS_WITH_AS(LogFile(options(path), {}), doctest::Contains("Another fauxboard writes"),
                         link::HostError);
    put(path + ".1", "came later");
    for (int i = 0; i < 1000; ++i) {
        file.write(std::string(50, 'x'));
    }
    const bool untouched = text_of(path + ".1") == "came later";
    CHECK(untouched);
    CHECK(fs::file_size(path) <= 4096);
    REQUIRE(troubles.size() == 1);
    CHECK(contains(troubles[0], "ends here"));
    CHECK_THROWS_AS(LogFile(options("/missing/log"), {}), link::HostError);
}

TEST_CASE("a full disk loses lines, says so once, and holds up nobody") {
    std::vector<std::string> troubles;
    LogFile file(options("/dev/full"), [&](std::string_view text) { troubles.emplace_back(text); });
    for (int i = 0; i < 100; ++i) {
        file.write("text");
    }
    REQUIRE(troubles.size() == 1);
    CHECK(contains(troubles[0], "takes no more"));
}

TEST_CASE("a pipe needs a reader; one that does not read loses whole lines, whose number is told") {
    const link::test::TemporaryFolder folder;
    const std::string path = folder.file("pipe");
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    CHECK_THROWS_WITH_AS(LogFile(options(path), {}), doctest::Contains("a pipe that nobody reads"),
                         link::HostError);
    const link::UniqueFd reader(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    std::vector<std::string> troubles;
    LogFile file(options(path), [&](std::string_view text) { troubles.emplace_back(text); });
    for (int i = 0; i < 5000; ++i) {
        file.write(std::string(50, 'x'));
    }
    CHECK(troubles.size() == 1);
    std::string text = link::test::take(reader.get());
    file.write("at last");
    text += link::test::take(reader.get());
    CHECK(contains(text, "lines were left out here"));
    CHECK(text.ends_with("at last\n"));
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        const bool known = line == std::string(50, 'x') || line == LogFile::text_mark || line == "at last" ||
                           line.ends_with("lines were left out here: they could not be written");
        CHECK(known);
    }
}

}  // namespace
}  // namespace fauxboard::host
