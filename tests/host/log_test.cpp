#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "emulator/host/json_log.h"
#include "emulator/host/line_log.h"
#include "emulator/host/recorder.h"
#include "emulator/link/host_error.h"
#include "emulator/record/recording.h"
#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

using namespace std::chrono_literals;
using board::Channel;
using board::Level;
using board::Verdict;
using link::test::contains;

/// A pipe to write a log to; what() reads what has come.
struct Pipe {
    link::UniqueFd in;
    link::UniqueFd out;
    Pipe() {
        std::array<int, 2> ends{};
        REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
        in.reset(ends[0]);
        out.reset(ends[1]);
        REQUIRE(::fcntl(ends[0], F_SETFL, O_NONBLOCK) == 0);
    }
    std::string take() const { return link::test::take(in.get()); }
};

std::size_t count_lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_CASE("a line of the log has time, direction, bytes and words, and no colours off a terminal") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    LineLog log(out, Detail::normal, 100);
    log.on_received(12'345'678us, Channel::main, "N-0 M104 S200*74", Verdict::accepted);
    const std::string text = pipe.take();
    CHECK(text.starts_with("    12.346  screen → board  N-0 M104 S200*74"));
    CHECK(contains(text, "nozzle: target 200 °C"));
    CHECK_FALSE(contains(text, "\x1b"));
}

TEST_CASE("a code that only the profile knows is said to be its own") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    LineLog log(out, Detail::normal, 100);
    log.on_received(1s, Channel::main, "M2999 S3", Verdict::accepted);
    CHECK(contains(pipe.take(), "unknown \"M2999 S3\""));
    log.ask([](Channel, const protocol::DecodedLine& line) {
        return std::string(line.code_text == "M2999" ? "M2999: the profile's own" : "");
    });
    log.on_received(1s, Channel::main, "M2999 S3", Verdict::accepted);
    CHECK(contains(pipe.take(), "M2999: the profile's own"));
    log.on_received(1s, Channel::main, "M2998", Verdict::accepted);
    CHECK(contains(pipe.take(), "unknown \"M2998\""));
}

TEST_CASE("what a fault did to a line, and what was done from outside, stand in both logs") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    LineLog log(out, Detail::normal, 100);
    JsonLog json(out);
    const fault::Deed deed{3, fault::Direction::to_board, "drop", "N-0 M105*10"};
    log.on_deed(1s, Channel::main, deed);
    CHECK(contains(pipe.take(), "fault 3         drop from screen: N-0 M105*10"));
    log.on_world(1s, "filament out");
    CHECK(contains(pipe.take(), "done            filament out"));
    json.on_deed(1s, Channel::main, deed);
    json.on_world(2s, "filament out");
    std::istringstream lines(pipe.take());
    std::string line;
    std::getline(lines, line);
    CHECK(nlohmann::json::parse(line) ==
          nlohmann::json{
              {"t", 1.0}, {"fault", 3}, {"kind", "drop"}, {"from", "screen"}, {"line", "N-0 M105*10"}});
    std::getline(lines, line);
    CHECK(nlohmann::json::parse(line) == nlohmann::json{{"t", 2.0}, {"done", "filament out"}});
    LineLog quiet(out, Detail::quiet, 100);
    quiet.on_deed(1s, Channel::main, deed);
    quiet.on_world(1s, "filament out");
    CHECK(pipe.take().empty());
}

TEST_CASE("on a terminal a line of the log is as wide as that, and whole when verbose") {
    const link::test::OtherPty terminal;
    const link::UniqueFd held = link::test::open_terminal(terminal.path);
    const winsize size{24, 70, 0, 0};
    REQUIRE(::ioctl(held.get(), TIOCSWINSZ, &size) == 0);
    TextOutput out(held.get());
    REQUIRE(out.columns() == 70);
    CHECK(TextOutput(Pipe().out.get()).columns() == 0);
    const std::string note = "größer: " + std::string(100, 'x');
    LineLog(out, Detail::normal, 100).on_notice(0s, Level::info, note);
    const std::string cut = link::test::take(terminal.master.get());
    CHECK(contains(cut, "größer: xxx"));
    CHECK(contains(cut, "…"));
    CHECK_FALSE(contains(cut, std::string(40, 'x')));
    LineLog(out, Detail::verbose, 100).on_notice(0s, Level::info, note);
    CHECK(contains(link::test::take(terminal.master.get()), std::string(100, 'x')));
}

TEST_CASE("bytes that a terminal would obey are shown as numbers") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    LineLog log(out, Detail::normal, 100);
    log.on_received(0us, Channel::host, "M117 \x1b[2J\xE9\x7F", Verdict::bad_frame);
    log.on_sent(0us, board::Channel::main, "L9 SN:\xFF;");
    const std::string text = pipe.take();
    CHECK(contains(text, "host → board"));
    CHECK(contains(text, "\\x1B[2J\\xE9\\x7F"));
    CHECK(contains(text, "refused: bad frame"));
    CHECK(contains(text, "\\xFF"));
    CHECK_FALSE(contains(text, "\x1b"));
}

TEST_CASE("levels") {
    const auto lines = [](Detail detail) {
        const Pipe pipe;
        TextOutput out(pipe.out.get());
        LineLog log(out, detail, 100);
        log.on_sent(0us, board::Channel::main, "L1");
        log.on_link(0us, link::LinkState::up, "here");
        for (const Level level : {Level::debug, Level::info, Level::warning, Level::error})
            log.on_notice(0us, level, "text");
        return count_lines(pipe.take());
    };
    CHECK(lines(Detail::quiet) == 2);
    CHECK(lines(Detail::normal) == 5);
    CHECK(lines(Detail::verbose) == 6);
}

TEST_CASE("what is told of the program's own doings has a level of its own, apart from the talk") {
    const auto text = [](Detail detail, LogLevel least) {
        const Pipe pipe;
        TextOutput out(pipe.out.get());
        LineLog log(out, detail, 100);
        log.tell_own(least);
        log.on_sent(0us, board::Channel::main, "L1");
        log.on_event(0us, machine::events().front());
        log.on_world(0us, "filament in");
        log.on_notice(0us, Level::error, "text");
        return pipe.take();
    };
    CHECK(contains(text(Detail::quiet, LogLevel::info), "filament in"));
    CHECK_FALSE(contains(text(Detail::quiet, LogLevel::info), "L1"));
    CHECK(count_lines(text(Detail::quiet, LogLevel::off)) == 0);
    CHECK(count_lines(text(Detail::normal, LogLevel::error)) == 2);
    CHECK(count_lines(text(Detail::normal, LogLevel::trace)) == 4);
}

TEST_CASE("a flood is cut short, and its size is told") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    LineLog log(out, Detail::normal, 100);
    std::size_t shown = 0;
    for (int i = 0; i < 100'000; ++i) {  // ten seconds of 10 000 bad lines each
        log.on_received(SimTime(i * 100), Channel::main, "nonsense", Verdict::bad_frame);
        shown += count_lines(pipe.take());
    }
    CHECK(shown > 400);
    CHECK(shown < 1500);
    log.finish(10s);
    CHECK(contains(pipe.take(), "lines left out of this log"));
    log.on_sent(60s, board::Channel::main, "L1");
    CHECK(count_lines(pipe.take()) == 1);
}

TEST_CASE("a reader that does not read loses lines, whole ones, and holds up nobody") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    JsonLog log(out);
    for (int i = 0; i < 10'000; ++i)
        log.on_sent(SimTime(i), board::Channel::main, "N-0 L1 X0.000 Y0.000 Z0.000 F0*13");
    CHECK(out.left_out() > 1000);
    const std::uint64_t left_out = out.left_out();
    std::string all = pipe.take();
    log.on_sent(1s, board::Channel::main, "L1");
    all += pipe.take();
    std::istringstream text(all);
    std::uint64_t told = 0;
    nlohmann::json last;
    for (std::string line; std::getline(text, line);) {
        last = nlohmann::json::parse(line);
        told += last.value("left_out", std::uint64_t{0});
    }
    CHECK(told == left_out);
    CHECK(last["line"] == "L1");
}

TEST_CASE("a closed output is borne") {
    Pipe pipe;
    pipe.in.reset();
    const auto old = std::signal(SIGPIPE, SIG_IGN);
    TextOutput out(pipe.out.get());
    CHECK_FALSE(out.write("text\n"));
    TextOutput nowhere(-1);
    CHECK_FALSE(nowhere.write("text\n"));
    std::signal(SIGPIPE, old);
}

TEST_CASE("JSON lines hold any bytes") {
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    JsonLog log(out);
    log.on_received(1'500'000us, Channel::main, "M117 \"\xE9\\\x01", Verdict::queue_full);
    log.on_notice(2s, Level::warning, "odd bytes: \xFF");
    log.on_link(3s, link::LinkState::waiting, "gone");
    std::istringstream text(pipe.take());
    std::string line;
    REQUIRE(std::getline(text, line));
    auto json = nlohmann::json::parse(line);
    CHECK(json["t"] == 1.5);
    CHECK(json["from"] == "screen");
    CHECK(json["line"] == "M117 \"\u00e9\\\u0001");
    CHECK(json["refused"] == "queue full");
    REQUIRE(std::getline(text, line));
    CHECK(nlohmann::json::parse(line)["level"] == "warning");
    REQUIRE(std::getline(text, line));
    CHECK(nlohmann::json::parse(line)["link"] == "waiting");
}

TEST_CASE("a recording holds every line of the wire and can be loaded at any moment") {
    const link::test::TemporaryFolder folder;
    const std::string file = folder.file("talk.jsonl");
    Recorder recorder(file, {});
    recorder.on_received(1'000'001us, Channel::main, "N-0 M105*10", Verdict::accepted);
    recorder.on_received(2s, Channel::host, "M115", Verdict::accepted);
    recorder.on_sent(3s, board::Channel::main, "L9 SN:\xFF");
    recorder.on_world(4s, R"({"heater.target":{"heater":"bed","c":60.0}})");
    recorder.on_deed(5s, Channel::main, {1, fault::Direction::to_screen, "drop", "L9"});
    recorder.on_fault(6s, "fault p1, jam, begins");
    const auto lines = record::load_recording(file);
    REQUIRE(lines.size() == 6);
    CHECK(lines[4].from == record::RecordedLine::From::fault);
    CHECK(lines[4].bytes == "fault 1: drop to screen: L9");
    CHECK(lines[5].bytes == "fault p1, jam, begins");
    CHECK(lines[3].from == record::RecordedLine::From::world);
    CHECK(lines[3].bytes == R"({"heater.target":{"heater":"bed","c":60.0}})");
    CHECK(lines[0].t == 1'000'001us);
    CHECK(lines[0].from == record::RecordedLine::From::screen);
    CHECK(lines[1].from == record::RecordedLine::From::host);
    CHECK(lines[2].bytes == "L9 SN:\xFF");
    CHECK(recorder.lines() == 6);
}

TEST_CASE("a full disk ends the recording once, and nothing else") {
    std::vector<std::string> troubles;
    Recorder recorder("/dev/full", [&](SimTime, std::string_view text) { troubles.emplace_back(text); });
    for (int i = 0; i < 10; ++i)
        recorder.on_sent(1s, board::Channel::main, "L1");
    CHECK(troubles.size() == 1);
    CHECK(recorder.lines() == 0);
    CHECK_THROWS_AS(Recorder("/missing/talk.jsonl", {}), link::HostError);
}

TEST_CASE("a recording into a pipe needs a reader, and waits for none") {
    const link::test::TemporaryFolder folder;
    const std::string file = folder.file("pipe");
    REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
    CHECK_THROWS_WITH_AS(Recorder(file, {}), doctest::Contains("a pipe that nobody reads"), link::HostError);
    const link::UniqueFd reader(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    std::vector<std::string> troubles;
    Recorder recorder(file, [&](SimTime, std::string_view text) { troubles.emplace_back(text); });
    for (int i = 0; i < 3000; ++i)
        recorder.on_sent(SimTime(i), board::Channel::main, "N-0 L1 X0.000 Y0.000 Z0.000 F0*13");
    CHECK(troubles.empty());  // more than the pipe holds, less than may wait
    std::string text = link::test::take(reader.get());
    recorder.on_sent(4s, board::Channel::main, "L2");
    text += link::test::take(reader.get());
    std::istringstream lines(text.substr(0, text.rfind('\n') + 1));
    CHECK(record::load_recording(lines, "pipe").size() > 1000);
    for (int i = 0; i < 30'000; ++i)
        recorder.on_sent(SimTime(i), board::Channel::main, "N-0 L1 X0.000 Y0.000 Z0.000 F0*13");
    REQUIRE(troubles.size() == 1);
    CHECK(contains(troubles[0], "who reads the pipe does not keep up"));
}

TEST_CASE("the end of a recording waits for a pipe's reader, and tells when it is not whole") {
    const link::test::TemporaryFolder folder;
    const std::string file = folder.file("pipe");
    REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
    const link::UniqueFd reader(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    std::vector<std::string> troubles;
    const auto fill = [&](Recorder& recorder) {
        for (int i = 0; i < 3000; ++i)  // more than the pipe holds
            recorder.on_sent(SimTime(i), board::Channel::main, "N-0 L1 X0.000 Y0.000 Z0.000 F0*13");
    };
    const auto trouble = [&](SimTime, std::string_view text) { troubles.emplace_back(text); };
    {
        Recorder recorder(file, trouble);
        fill(recorder);
        std::size_t taken = 0;
        std::thread slow([&] {
            for (std::size_t more = 1; more != 0; taken += more) {
                pollfd entry{.fd = reader.get(), .events = POLLIN, .revents = 0};
                more = ::poll(&entry, 1, 10'000) > 0 ? link::test::take(reader.get()).size() : 0;
            }
        });
        recorder.finish(4s);
        slow.join();
        CHECK(troubles.empty());
        CHECK(taken > 3000 * 60);
    }
    Recorder recorder(file, trouble);
    fill(recorder);
    recorder.finish(5s);  // whom nobody reads on
    REQUIRE(troubles.size() == 1);
    CHECK(contains(troubles[0], "is not whole: who reads the pipe does not keep up"));
}

TEST_CASE("a password that the line sets is in no log and no recording") {
    const link::test::TemporaryFolder folder;
    const std::string file = folder.file("talk.jsonl");
    const Pipe pipe;
    TextOutput out(pipe.out.get());
    LineLog log(out, Detail::verbose, 0);
    JsonLog json(out);
    Recorder recorder(file, {});
    const std::vector<LiveObserver*> all{&log, &json, &recorder};
    for (LiveObserver* each : all) {
        each->on_received(1s, Channel::main, "M9003 \"home\",\"secret\"", Verdict::accepted);
        each->on_datagram(2s, 1, true, "M9005 \"home\",\"secret\"\r\n");
    }
    const std::string text = pipe.take();
    CHECK(contains(text, "M9003"));
    CHECK_FALSE(contains(text, "secret"));
    const auto lines = record::load_recording(file);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].bytes == "M9003 \"home\",\"***\"");
    CHECK(lines[1].bytes == "M9005 \"home\",\"***\"\r\n");
}

}  // namespace
}  // namespace fauxboard::host
