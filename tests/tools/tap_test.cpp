// `fauxboard tap`, the real program.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "emulator/link/unique_fd.h"
#include "emulator/record/recording.h"
#include "tests/tools/program.h"

namespace fauxboard::test {
namespace {

using link::UniqueFd;

UniqueFd open_end(const std::string& path) {
    UniqueFd fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    REQUIRE(fd);
    return fd;
}

void say(const UniqueFd& fd, std::string_view text) {
    REQUIRE(::write(fd.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()));
}

/// As many bytes as `expected` has. The bound is only there so that a broken test ends.
std::string hear(const UniqueFd& fd, std::string_view expected) {
    constexpr int give_up_ms = 20'000;
    std::string heard;
    std::array<char, 4096> buffer{};
    pollfd entry{.fd = fd.get(), .events = POLLIN, .revents = 0};
    while (heard.size() < expected.size() && ::poll(&entry, 1, give_up_ms) > 0) {
        const ssize_t count = ::read(fd.get(), buffer.data(), buffer.size());
        if (count <= 0) {
            break;
        }
        heard.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return heard;
}

void talk(const UniqueFd& from, const UniqueFd& to, std::string_view text) {
    say(from, text);
    CHECK(hear(to, text) == text);
}

std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST_CASE("tap: between two ptys, with recording, capture and words; names gone at the end") {
    const TemporaryFolder folder;
    RunningProgram tap({"tap", "pty=" + folder.file("A"), "pty=" + folder.file("B"), "--record",
                        folder.file("tap.jsonl"), "--pcapng", folder.file("tap.pcapng"), "--decode"},
                       folder.file("log"));
    const std::string line = tap.read_line();
    REQUIRE(line.starts_with("ready {"));
    const auto ready = nlohmann::json::parse(line.substr(6));
    CHECK(ready["a"]["link"] == "pty");
    CHECK(ready["b"]["name"] == folder.file("B"));
    // The board is at A: the tap finds out.
    const UniqueFd board = open_end(ready["a"]["path"]);
    UniqueFd screen = open_end(folder.file("B"));
    talk(board, screen, "N-0 L21 P0 S0*63\r\n");
    talk(screen, board, std::string("log Geeetech LCD OK\r\n\0N-0 M2134 FW:V1.02.xx*84\r\n", 48));
    // The screen goes; the board goes on; another screen comes.
    screen.reset();
    screen = open_end(folder.file("B"));
    talk(screen, board, "N-0 M27*59\r\n");
    talk(board, screen, "N-0 L14 \xFF*0\r\n");
    CHECK(tap.end(SIGTERM) == 0);
    CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(folder.file("A"))));

    const auto recorded = record::load_recording(folder.file("tap.jsonl"));
    REQUIRE(recorded.size() == 5);
    CHECK(recorded[0].from == record::RecordedLine::From::board);
    CHECK(recorded[0].bytes == "N-0 L21 P0 S0*63");
    CHECK(recorded[1].from == record::RecordedLine::From::screen);
    CHECK(recorded[4].bytes == "N-0 L14 \xFF*0");
    CHECK(read(folder.file("tap.pcapng")).size() > 500);
    const std::string log = read(folder.file("log"));
    CHECK(log.find("board → screen  N-0 L21 P0 S0*63                      question to the screen") !=
          std::string::npos);
    CHECK(log.find("A → B 31 bytes read, 31 passed on, 0 lost, 2 lines; B → A 60 bytes read, 60 passed on, "
                   "0 lost, 3 lines; passed on") != std::string::npos);
}

TEST_CASE("tap: what cannot be is told by the exit code") {
    CHECK(run_program("tap pty").code == 2);
    CHECK(run_program("tap pty pty --board C").code == 2);
    CHECK(run_program("tap pty pty --duration soon").code == 2);
    CHECK(run_program("tap pty pty --record /no/such/folder/x").code == 3);
    CHECK(run_program("tap pty pty --pcapng /no/such/folder/x").code == 3);
    CHECK(run_program("tap pty /dev/no-such-port").code == 4);
    CHECK(run_program("tap pty=/tmp/x pty=/tmp/x").code == 4);
    CHECK(run_program("tap pty tcp-listen:nowhere").code == 4);
    const Outcome ended = run_program("tap pty pty --duration 1ms");
    CHECK(ended.code == 0);
    CHECK(ended.out.find("nothing passed on") != std::string::npos);
}

}  // namespace
}  // namespace fauxboard::test
