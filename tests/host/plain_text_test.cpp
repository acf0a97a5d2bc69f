// What may reach a terminal: texts that would steer it, and outputs that do not read.

#include "emulator/host/plain_text.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <termios.h>

#include <algorithm>

#include "emulator/host/line_log.h"
#include "emulator/host/text_output.h"
#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

using link::test::contains;

struct Case {
    const char* from;
    const char* shown;
};

TEST_CASE("plain text: whatever steers a terminal is spelled out, all else stays") {
    const Case cases[] = {
        {"M117 \x1b[2J", "M117 \\x1B[2J"},  // ESC
        {"a\rb\bc\ad\x7f", "a\\x0Db\\x08c\\x07d\\x7F"},
        {"\xc2\x9b"
         "31m",
         "\\xC2\\x9B31m"},  // CSI of one character
        {"\x9b"
         "31m",
         "\\x9B31m"},  // and of one byte
        {"\xe2\x80\xae"
         "gpj.exe",
         "\\xE2\\x80\\xAEgpj.exe"},             // right to left
        {"\xe2\x81\xa6x", "\\xE2\\x81\\xA6x"},  // isolates
        {"Käse → 200 °C", "Käse → 200 °C"},
        {"\xc3", "\\xC3"},  // cut off
        {"\xc0\xaf\xed\xa0\x80\xf4\x90\x80\x80",
         "\\xC0\\xAF\\xED\\xA0\\x80\\xF4\\x90\\x80\\x80"},  // no UTF-8
        {"tab\tand\nline", "tab\tand\nline"},
        {"", ""},
    };
    for (const Case& each : cases) {
        CHECK(plain_text(each.from) == each.shown);
    }
    CHECK(plain_line("one\ntwo") == "one\\x0Atwo");
    CHECK(plain_text(std::string_view("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("plain text: every byte, alone and behind others, gives text that stays as it is") {
    for (int first = 0; first < 256; ++first) {
        for (int second = 0; second < 256; ++second) {
            const std::string bytes{static_cast<char>(first), static_cast<char>(second), 'x'};
            const std::string shown = plain_line(bytes);
            CHECK(plain_line(shown) == shown);
            CHECK(std::none_of(shown.begin(), shown.end(), [](char c) {
                const auto byte = static_cast<unsigned char>(c);
                return (byte < 0x20 && byte != '\t') || byte == 0x7F;
            }));
        }
    }
}

TEST_CASE("styled lines: colours are ours alone") {
    CHECK(StyledLine(true).add("\x1b[5m", Ink::error, 8).end().bytes() == "\x1b[31m\\x1B[5m \x1b[0m\n");
    CHECK(StyledLine(false).add("ä", Ink::error, 3).add("|").bytes() == "ä  |");
}

/// A terminal of which nobody reads the other side.
struct DeafTerminal {
    link::test::OtherPty pty;
    link::UniqueFd fd = link::UniqueFd(::open(pty.path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));  // blocks
    std::string take() const { return link::test::take(pty.master.get()); }
};

/// Writes until nothing goes any more, then goes on for a while: that it returns at all is the test.
void flood(TextOutput& out) {
    const std::string line(400, 'x');
    for (int i = 0; i < 2000; ++i) {
        out.write(line + "\n");
    }
    CHECK(out.left_out() > 100);
}

TEST_CASE("a terminal that stops reading loses lines, whole ones, and holds up nobody") {
    const DeafTerminal terminal;
    REQUIRE(terminal.fd);
    const int flags = ::fcntl(terminal.fd.get(), F_GETFL);
    TextOutput out(terminal.fd.get());
    flood(out);
    CHECK(::fcntl(terminal.fd.get(), F_GETFL) == flags);  // others who have it open are not touched
    std::string text;
    for (std::string more = terminal.take(); !more.empty(); more = terminal.take()) {
        text += more;
        out.flush();
    }
    CHECK(out.write("last\n"));
    text += terminal.take();
    CHECK(contains(text, "last"));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.ends_with('\r')) line.pop_back();
        CHECK((line == std::string(400, 'x') || line == "last"));
    }
}

TEST_CASE("a socket and a pipe that stop reading hold up nobody either") {
    std::array<int, 2> ends{};
    REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0);
    const link::UniqueFd reader(ends[0]);
    const link::UniqueFd writer(ends[1]);
    TextOutput to_socket(writer.get());
    flood(to_socket);
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    const link::UniqueFd pipe_reader(ends[0]);
    const link::UniqueFd pipe_writer(ends[1]);
    TextOutput to_pipe(pipe_writer.get());
    flood(to_pipe);
}

TEST_CASE("a line that must come waits for room, in front of all others") {
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    const link::UniqueFd reader(ends[0]);
    const link::UniqueFd writer(ends[1]);
    REQUIRE(::fcntl(reader.get(), F_SETFL, O_NONBLOCK) == 0);
    TextOutput filler(writer.get());
    while (filler.write(std::string(4095, '.') + "\n")) {
    }
    TextOutput out(writer.get());
    out.keep("ready {}\n");
    CHECK_FALSE(out.flush());
    CHECK_FALSE(out.write("lost\n"));
    link::test::take(reader.get());
    CHECK(out.flush());
    CHECK(out.write("next\n"));
    CHECK(link::test::take(reader.get()) == "ready {}\nnext\n");
    CHECK(out.error() == 0);
    TextOutput full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
    full.keep("ready {}\n");
    CHECK(full.error() == ENOSPC);
}

TEST_CASE("no flood of lines keeps an error from being said, and no flood of warnings") {
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    const link::UniqueFd reader(ends[0]);
    const link::UniqueFd writer(ends[1]);
    REQUIRE(::fcntl(reader.get(), F_SETFL, O_NONBLOCK) == 0);
    TextOutput out(writer.get());
    LineLog log(out, Detail::normal, 100);
    for (int i = 0; i < 2000; ++i) {
        log.on_received(SimTime(i), board::Channel::main, "M105", board::Verdict::accepted);
        log.on_notice(SimTime(i), board::Level::warning, "M999 is not in the profile; ignored");
        link::test::take(reader.get());
    }
    log.on_notice(SimTime(2000), board::Level::error, "the EEPROM could not be saved\x1b[2J\nforged");
    const std::string text = link::test::take(reader.get());
    CHECK(contains(text, "error           the EEPROM could not be saved\\x1B[2J\\x0Aforged\n"));
}

}  // namespace
}  // namespace fauxboard::host
