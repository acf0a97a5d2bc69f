#include "tests/calls/short_life.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "emulator/host/eeprom_file.h"
#include "tests/support/dlp_bench.h"
#include "tests/support/transfer_client.h"

namespace fauxboard::calls {
namespace {

namespace fs = std::filesystem;
using link::UniqueFd;
using nlohmann::json;

/// Nothing is ever waited for that long in a passing test.
constexpr int patience_ms = 20'000;
/// An answer that does not come in that time was lost to the failing call.
constexpr int answer_ms = 40;
constexpr std::string_view part = "M104 S60\nG28\nG1 X10\nG1 X20\n";
constexpr std::size_t upload_bytes = 4000;
constexpr std::size_t cells_bytes = 2048;

void put(const std::string& file, std::string_view text) {
    std::ofstream(file, std::ios::binary) << text;
}

constexpr std::string_view play_script = R"({
  "name": "play", "profile": "geeetech-a30t",
  "steps": [ { "do": "eeprom.save" }, { "wait": "2s" }, { "request": "M105" }, { "wait": "3s" } ]
})";
constexpr std::string_view show_script = R"({
  "name": "show", "profile": "mks-dlp",
  "steps": [ { "wait": { "event": "board.ready" } }, { "do": { "uvtest.image": { "n": 2 } } },
             { "do": { "uvtest.display": { "on": true } } }, { "wait": "2s" }, { "do": "uvtest.leave" },
             { "do": { "print.start": { "path": "model.pws" } } },
             { "wait": { "event": "print.finished" }, "within": "5min" } ]
})";

/// {0} is the folder. Who is visited is told to end then, and ends in any case: where no call ever comes back
/// with an event, nobody is told anything.
constexpr std::array<const char*, life_count> command_lines{
    "run --script {0}play.json --speed max --tcp :0 --udp :0 --host-tcp :0 --sd {0}sd --eeprom {0}eeprom "
    "--record {0}talk.jsonl --control {0}control",
    "run --profile {0}own.json --duration 1s --tcp :0 --udp :0 --host-pty={0}usb --sd {0}sd --eeprom "
    "{0}eeprom "
    "--record {0}talk.jsonl --control {0}control",
    "run --profile elegoo-mars-pro --duration 3s --no-pacing --tcp :0 --udp :0 --sd {0}sd "
    "--record {0}talk.jsonl --web=127.0.0.1:0/short-life-here",
    "run --script {0}show.json --speed max --udisk {0}stick --panel {0}shown --eeprom {0}cells --spi "
    "{0}wires "
    "--control {0}control",
    "fleet {0}fleet.json --duration 3s --web=127.0.0.1:0/short-life-here"};

std::string fleet_file(const link::test::TemporaryFolder& folder) {
    return json{
        {"boards",
         {{{"profile", "geeetech-a30t"}, {"tcp", ":0"}, {"eeprom", folder.file("eeprom")}},
          {{"profile", "elegoo-mars-pro"}, {"tcp", ":0"}, {"udp", ":0"}, {"sd", folder.file("sd")}},
          {{"profile", "mks-dlp"}, {"eeprom", folder.file("cells")}, {"udisk", folder.file("stick")}}}}}
        .dump();
}

/// Connected to that port of this computer, or to nothing: it may be gone already.
UniqueFd reach(const std::string& where, int type) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(where.c_str() + where.rfind(':') + 1)));
    UniqueFd fd(::socket(AF_INET, type | SOCK_CLOEXEC, 0));
    const bool there = ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    return there ? std::move(fd) : UniqueFd{};
}

void say(const UniqueFd& fd, std::string_view bytes) {
    (void)!::send(fd.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

std::string hear(const UniqueFd& fd) {
    std::array<char, 4096> room{};
    pollfd entry{.fd = fd.get(), .events = POLLIN, .revents = 0};
    const ssize_t got = ::poll(&entry, 1, answer_ms) > 0 ? ::recv(fd.get(), room.data(), room.size(), 0) : 0;
    return {room.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
}

/// The object of the `ready` line; null when there is none.
json ready_line(int out) {
    std::string line;
    pollfd entry{.fd = out, .events = POLLIN, .revents = 0};
    for (char c = 0; c != '\n' && ::poll(&entry, 1, patience_ms) > 0 && ::read(out, &c, 1) == 1;) {
        line += c;
    }
    return json::parse(line.substr(std::min(line.find('{'), line.size())), nullptr, false);
}

int wait(pid_t pid) {
    const UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
    pollfd entry{.fd = process.get(), .events = POLLIN, .revents = 0};
    if (::poll(&entry, 1, patience_ms) <= 0) {
        ::kill(pid, SIGKILL);
        ::waitpid(pid, nullptr, 0);
        return hung;
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    return WIFSIGNALED(status) ? killed + WTERMSIG(status) : WEXITSTATUS(status);
}

bool lines_are_whole(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!json::accept(line) || lines.eof()) {
            return false;
        }
    }
    return true;
}

bool picture_is_whole(const std::string& png) {
    constexpr std::string_view last = "IEND\xae\x42\x60\x82";
    return png.size() > last.size() && png.ends_with(last);
}

}  // namespace

const char* to_string(Life life) {
    constexpr std::array names{"played", "met", "uploaded", "shown", "fleet"};
    static_assert(names.size() == life_count);
    return names[static_cast<std::size_t>(life)];
}

ShortLife::ShortLife(Life life) : life_(life) {
    for (const char* folder : {"sd", "stick"}) {
        fs::create_directory(folder_.file(folder));
    }
    put(folder_.file("sd/part.gco"), part);
    put(folder_.file("own.json"), R"({"name": "own", "extends": "geeetech-a30t"})");
    put(folder_.file("play.json"), play_script);
    put(folder_.file("show.json"), show_script);
    put(folder_.file("fleet.json"), fleet_file(folder_));
    if (life == Life::shown || life == Life::fleet) {
        testing::PanelPws wishes;
        wishes.layers = 1;
        put(folder_.file("stick/model.pws"), testing::make_panel_pws(wishes));
    }
}

std::vector<std::string> ShortLife::arguments() const {
    std::istringstream line(
        fmt::format(fmt::runtime(command_lines[static_cast<std::size_t>(life_)]), folder_.file("")));
    return {std::istream_iterator<std::string>(line), {}};
}

void ShortLife::become(const FailingCall& failing, int out, int errors) const {
    ::setenv("LD_PRELOAD", FAUXBOARD_FAILING_CALLS, 1);
    ::setenv("FAIL_CALL", failing.name, 1);
    ::setenv("FAIL_NTH", std::to_string(failing.nth).c_str(), 1);
    ::setenv("FAIL_ERROR", std::to_string(failing.error).c_str(), 1);
    ::setenv("FAIL_EVER", failing.ever ? "1" : "0", 1);
    ::setenv("FAIL_MARK", folder_.file("mark").c_str(), 1);
    std::vector<std::string> args = arguments();
    args.insert(args.begin(), FAUXBOARD_PROGRAM);
    std::vector<char*> words;
    for (std::string& arg : args) {
        words.push_back(arg.data());
    }
    words.push_back(nullptr);
    ::dup2(::open("/dev/null", O_RDWR), 0);
    ::dup2(out, 1);
    ::dup2(errors, 2);
    ::execv(words[0], words.data());
    ::_exit(127);
}

LifeEnd ShortLife::run(const FailingCall& failing) {
    fs::remove(folder_.file("mark"));
    for (const char* made : {"sd/up.ctb", "talk.jsonl", "wires"}) {
        fs::remove(folder_.file(made));
    }
    fs::remove_all(folder_.file("shown"));
    acknowledged_ = false;
    const UniqueFd errors(::open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    const UniqueFd out(ends[0]);
    UniqueFd program_out(ends[1]);
    const pid_t pid = ::fork();
    if (pid == 0) {
        become(failing, program_out.get(), errors.get());
    }
    program_out.reset();
    if (life_ != Life::played && life_ != Life::shown) {
        visit(pid, out.get());
    }
    LifeEnd end;
    end.code = wait(pid);
    peers_.clear();
    end.happened = fs::exists(folder_.file("mark"));
    end.said.resize(4096);
    const ssize_t size = ::pread(errors.get(), end.said.data(), end.said.size(), 0);
    end.said.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    end.acknowledged = acknowledged_;
    end.missing = missing_file();
    end.torn = torn_file();
    return end;
}

void ShortLife::visit(pid_t pid, int out) {
    const json ready = ready_line(out);
    std::vector<json> boards;
    if (ready.is_object()) {
        boards =
            ready.contains("boards") ? ready["boards"].get<std::vector<json>>() : std::vector<json>{ready};
    }
    for (const json& board : boards) {
        if (board.value("link", "") == "tcp") {
            peers_.push_back(reach(board.value("path", ""), SOCK_STREAM));
            say(peers_.back(), "N-0 M105*10\r\nM4002\r\n");
            hear(peers_.back());
        }
        if (board.contains("udp")) {
            life_ == Life::met ? static_cast<void>(peers_.push_back(reach(board["udp"], SOCK_DGRAM)))
                               : upload(board["udp"]);
            say(peers_.back(), "M4002");
            hear(peers_.back());
        }
    }
    if (ready.is_object() && ready.contains("web")) {
        const std::string address = ready["web"];
        const std::string host = address.substr(7, address.find('/', 7) - 7);
        peers_.push_back(reach(host, SOCK_STREAM));
        say(peers_.back(), fmt::format("GET {}boards HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
                                       address.substr(address.find('/', 7)), host));
        hear(peers_.back());
    }
    ::kill(pid, SIGTERM);
}

void ShortLife::upload(const std::string& udp) {
    peers_.push_back(reach(udp, SOCK_DGRAM));
    const UniqueFd& socket = peers_.back();
    int silent = 0;
    bool saved = false;  // the ok comes after an error, too
    testing::TransferClient client({[&](std::string_view bytes) { say(socket, bytes); },
                                    [&] {
                                        const std::string answer = hear(socket);
                                        // Who is silent for good is given up before the client does.
                                        silent = answer.empty() ? silent + 1 : 0;
                                        saved = saved || answer.starts_with("Done saving file");
                                        return silent > 5 ? std::string("gone") : answer;
                                    }},
                                   {});
    client.upload("up.ctb", upload_bytes,
                  [](std::uint64_t at, std::size_t size) { return testing::pattern(at, size); });
    acknowledged_ = saved;
}

std::string ShortLife::content(const std::string& name) const {
    std::ifstream in(folder_.file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string ShortLife::missing_file() const {
    static constexpr std::array<std::string_view, life_count> made{
        "eeprom eeprom.job talk.jsonl", "eeprom.job talk.jsonl", "sd/up.ctb talk.jsonl",
        "cells wires shown/panel.jsonl shown/000002.png", "eeprom.job cells sd/up.ctb"};
    std::istringstream names{std::string(made[static_cast<std::size_t>(life_)])};
    for (std::string name; names >> name;) {
        if (!fs::exists(folder_.file(name))) {
            return name;
        }
    }
    return {};
}

std::string ShortLife::torn_file() const {
    if (const std::string eeprom = content("eeprom"); !eeprom.empty() && !host::eeprom_image(eeprom)) {
        return "the EEPROM is broken";
    }
    if (fs::exists(folder_.file("cells")) && content("cells").size() != cells_bytes) {
        return "the chip's file is not as long as the chip";
    }
    if (content("sd/part.gco") != part) {
        return "part.gco is not as it was";
    }
    const bool there = fs::exists(folder_.file("sd/up.ctb"));
    if (there ? content("sd/up.ctb") != testing::pattern(0, upload_bytes) : acknowledged_) {
        return there ? "half an upload has its name" : "an upload that was acknowledged is not there";
    }
    for (const char* lines : {"talk.jsonl", "shown/panel.jsonl"}) {
        if (!lines_are_whole(content(lines))) {
            return fmt::format("{} has half a line", lines);
        }
    }
    std::error_code none;
    for (fs::directory_iterator at(folder_.file("shown"), none), end; !none && at != end; ++at) {
        if (at->path().extension() == ".png" &&
            !picture_is_whole(content("shown/" + at->path().filename().string()))) {
            return "half a picture: " + at->path().filename().string();
        }
    }
    return {};
}

}  // namespace fauxboard::calls
