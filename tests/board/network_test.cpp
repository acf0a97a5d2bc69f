// A resin board by datagrams: requests and their answers, files up and down, everything a network does to
// them.

#include <doctest/doctest.h>

#include <deque>
#include <string>

#include "protocol/chitu_chunk.h"
#include "tests/support/board_driver.h"
#include "tests/support/sliced_file.h"
#include "tests/support/transfer_client.h"

namespace fauxboard::testing {
namespace {

using namespace std::chrono_literals;
using Texts = std::vector<std::string>;
using machine::SimTime;

constexpr std::uint64_t alice = 11;
constexpr std::uint64_t bob = 12;

struct Network {
    MemoryDisk disk;
    board::Board board;
    SimTime now{0};
    SimTime
        pause;  ///< between requests: a 4.4.3 board hangs when they come too fast, of which other tests are
    std::deque<std::pair<std::uint64_t, std::string>> answers;

    explicit Network(std::string_view profile = "elegoo-mars-pro")
        : board(shipped_profile(profile), services(), {}), pause(profile == "chitu-4.4.3" ? 25ms : 1ms) {
        disk.set_room(100'000'000);
        board.power_on(now);
        pass(3s);
    }

    machine::Services services() {
        machine::Services made;
        made.sd = &disk;
        return made;
    }
    void pass(SimTime time) {
        now += time;
        while (board.advance(now) <= now) {
            board.clear_output();
        }
        board.clear_output();
    }
    void send(std::uint64_t peer, std::string_view bytes) {
        board.receive_datagram(now, peer, bytes);
        board.take_datagrams(
            [&](std::uint64_t to, std::string_view answer) { answers.emplace_back(to, answer); });
        pass(pause);
    }
    /// All answers, which are all for the one who asked; their line ends as they are.
    Texts ask(std::string_view bytes, std::uint64_t peer = alice) {
        answers.clear();
        send(peer, bytes);
        Texts texts;
        for (const auto& [to, text] : answers) {
            CHECK(to == peer);
            texts.push_back(text);
        }
        return texts;
    }
    TransferClient client(TransferClient::Trouble trouble = {}, std::uint64_t peer = alice) {
        return {{[this, peer](std::string_view bytes) {
                     answers.clear();
                     send(peer, bytes);
                 },
                 [this] {
                     const std::string answer = answers.empty() ? "" : answers.front().second;
                     if (!answers.empty()) answers.pop_front();
                     return answer;
                 }},
                trouble};
    }
    std::string content(std::string_view path) const {
        const std::string* const found = disk.content(path);
        return found == nullptr ? "(none)" : *found;
    }
};

std::string noise(std::size_t size, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::string bytes(size, '\0');
    for (char& byte : bytes) {
        byte = static_cast<char>(random() & 0xFF);
    }
    return bytes;
}

TEST_CASE(
    "network: a request may end in any way; each line of the answer is its own datagram to the one who "
    "asked") {
    Network net;
    const Texts version{"ok V4.3.3_LCDC\n"};
    for (const std::string& request :
         {std::string("M4002"), std::string("M4002\0", 6), std::string("M4002\0\0", 7),
          std::string("M4002\r\n"), std::string("M4002\n")}) {
        CHECK(net.ask(request, bob) == version);
    }
    net.disk.put("b.ctb", std::string(1234, 'b'));
    net.disk.put("a.ctb", "a");
    CHECK(net.ask("M20") ==
          Texts{"Begin file list\r\n", "a.ctb 1\r\n", "b.ctb 1234\r\n", "End file list\r\n", "ok N:0\r\n"});
    const Texts found = net.ask("M99999");
    REQUIRE(found.size() == 1);
    CHECK(found[0].starts_with("ok MAC:"));
    CHECK(net.ask("").empty());
    CHECK(net.ask(std::string("\0\0\r\n", 4)).empty());
    CHECK(net.ask(std::string(5000, 'x')).size() <= 1);
    CHECK(net.board.output().empty());  // nothing of it on the line
}

TEST_CASE("network: a file goes up over a bad line and comes down the same, listed with its exact size") {
    for (const char* profile : {"elegoo-mars-pro", "elegoo-saturn", "anycubic-photon", "chitu-4.4.3"}) {
        CAPTURE(std::string(profile));
        Network net(profile);
        const std::string file = noise(1'000'003, 5);
        TransferClient client = net.client({0.2, 7});
        CHECK(client.upload("part one.ctb", file.size(),
                            [&](std::uint64_t at, std::size_t size) { return file.substr(at, size); }) == "");
        CHECK(client.lost > 20);
        CHECK(client.damaged > 10);
        CHECK(client.repeated > 10);
        CHECK(net.content("part one.ctb") == file);
        CHECK(net.content("part one.ctb.temp") == "(none)");
        const Texts list = net.ask("M20");
        CHECK(std::find(list.begin(), list.end(), "part one.ctb 1000003\r\n") != list.end());
        std::string back;
        CHECK(client.download("part one.ctb", file.size(), [&](std::string_view bytes) { back += bytes; }) ==
              "");
        CHECK(back == file);
    }
}

TEST_CASE("network: answers to pieces, in both forms of resend") {
    const auto talk = [](Network& net, const std::string& resend) {
        CHECK(net.ask("M28 a.ctb") == Texts{"ok N:0\r\n"});
        CHECK(net.ask(chunk(0, std::string(1280, 'x'))) == Texts{"ok\r\n"});
        CHECK(net.ask(chunk(0, std::string(1280, 'x'))) == Texts{resend});  // its answer was lost
        CHECK(net.ask(chunk(2560, "late")) == Texts{resend});
        std::string damaged = chunk(1280, "abc");
        damaged[1] = 'x';
        CHECK(net.ask(damaged) == Texts{resend});
        damaged = chunk(1280, "abc");
        damaged.back() = '\x03';  // not even its mark
        CHECK(net.ask(damaged) == Texts{resend});
        CHECK(net.ask(chunk(1280, "abc").substr(2)) == Texts{resend});
        CHECK(net.ask(chunk(1280, "abc")) == Texts{"ok\r\n"});
        CHECK(net.ask("M4012 I1 T0") == Texts{"ok 1283/1283\r\n"});
        CHECK(net.ask("M4000").size() == 1);  // answered, not stored
    };
    Network mars;
    talk(mars, "resend 1280\r\n");
    CHECK(mars.ask("M29") == Texts{"Done saving file!\r\n", "ok N:0\r\n"});
    CHECK(mars.content("a.ctb") == std::string(1280, 'x') + "abc");
    Network saturn("elegoo-saturn");
    talk(saturn, "resend 1280,offset error:1280\r\n");
    CHECK(saturn.ask("M29") == Texts{"Done saving file!\r\n", "ok N:0\r\n"});
    Network photon("anycubic-photon");
    talk(photon, "resend 1280\r\n");
    CHECK(photon.ask("M29") == Texts{"ok N:0\r\n"});
}

TEST_CASE("network: a piece that nobody waits for is no acknowledged request") {
    Network net;
    CHECK(net.ask(chunk(0, "abc")) == Texts{"Error:no file is opened!\r\n"});
    CHECK(net.ask("M29") == Texts{"Error:no file is opened!\r\n", "ok N:0\r\n"});
}

TEST_CASE("network: one transfer at a time; others are told which, and still answered what they ask") {
    Network net;
    net.disk.put("old.ctb", "old");
    CHECK(net.ask("M28 a.ctb", alice) == Texts{"ok N:0\r\n"});
    CHECK(net.ask(chunk(0, "abc"), alice) == Texts{"ok\r\n"});
    const std::string refused = "Error!File: a.ctb is opened\r\n";
    for (const std::string& request :
         {std::string("M28 b.ctb"), std::string("M29"), std::string("M6032 'old.ctb'")}) {
        CAPTURE(request);
        CHECK(net.ask(request, bob) == Texts{refused, "ok N:0\r\n"});
    }
    CHECK(net.ask("M22", bob) == Texts{refused});
    CHECK(net.ask(chunk(3, "xyz"), bob) == Texts{refused});
    CHECK(net.ask("M4002", bob) == Texts{"ok V4.3.3_LCDC\n"});
    CHECK(net.ask(chunk(3, "def"), alice) == Texts{"ok\r\n"});
    CHECK(net.ask("M29", alice).size() == 2);
    CHECK(net.content("a.ctb") == "abcdef");
    CHECK(net.ask("M28 b.ctb", bob) == Texts{"ok N:0\r\n"});
    net.pass(machine::Transfer::idle_limit);
    CHECK(net.ask("M28 c.ctb", alice) == Texts{"ok N:0\r\n"});  // bob is gone
    CHECK(net.ask("M29", alice).size() == 2);
    CHECK(net.content("c.ctb").empty());
    CHECK(net.content("b.ctb.temp") == "(none)");
}

TEST_CASE("network: half an upload never replaces a whole file") {
    Network net;
    net.disk.put("old.ctb", "old content");
    CHECK(net.ask("M28 old.ctb").size() == 1);
    CHECK(net.ask(chunk(0, "new")).size() == 1);
    CHECK(net.ask("M22") == Texts{"ok N:0\r\n"});
    CHECK(net.content("old.ctb") == "old content");
    CHECK(net.ask("M28 old.ctb").size() == 1);
    CHECK(net.ask(chunk(0, "new")).size() == 1);
    net.board.power_on(net.now);
    net.pass(3s);
    CHECK(net.content("old.ctb") == "old content");
    CHECK(net.ask("M28 ../old.ctb") == Texts{"Error:write data\r\n", "ok N:0\r\n"});
    net.disk.set_room(11 + 3 + 4);
    CHECK(net.ask("M28 old.ctb").size() == 1);
    CHECK(net.ask(chunk(0, "newnewnew")) == Texts{"Error:write data\r\n"});
    CHECK(net.content("old.ctb") == "old content");
}

TEST_CASE("network: blocks begin at any byte; what cannot be read is said") {
    Network net;
    const std::string file = noise(5000, 6);
    net.disk.put("f.ctb", file);
    CHECK(net.ask("M3000") == Texts{"Error:no file is opened!\r\n"});
    for (const char* request : {"M6032 'f.ctb'", "M6032 :'f.ctb'", "M6032 \"f.ctb\"", "M6032 ':f.ctb'"}) {
        CAPTURE(std::string(request));
        CHECK(net.ask(request) == Texts{"ok L:5000\r\n"});
    }
    CHECK(net.ask("M3000") == Texts{chunk(0, file.substr(0, 1280))});
    CHECK(net.ask("M3000") == Texts{chunk(1280, file.substr(1280, 1280))});
    CHECK(net.ask("M3001 I96") == Texts{chunk(96, file.substr(96, 1280))});
    CHECK(net.ask("M3000") == Texts{chunk(1376, file.substr(1376, 1280))});
    CHECK(net.ask("M3000 I4999") == Texts{chunk(4999, file.substr(4999))});
    for (const char* request : {"M3000", "M3001 I5000", "M3001 I-1", "M3001 I99999999999999999999"}) {
        CAPTURE(std::string(request));
        CHECK(net.ask(request) == Texts{"Error:read data\r\n"});
    }
    CHECK(net.ask("M3001 I0") == Texts{chunk(0, file.substr(0, 1280))});
    CHECK(net.ask("M6032 'missing'") ==
          Texts{"Error:File is not existed or empty, file /missing\r\n", "ok N:0\r\n"});
}

TEST_CASE("network: M30 removes, and names what it removed") {
    Network net;
    net.disk.put("test.txt", "x");
    CHECK(net.ask("M30 test.txt") == Texts{"File deleted :TEST.TXT\r\n", "ok N:0\r\n"});
    CHECK(net.ask("M30 test.txt") == Texts{"Delete failed :TEST.TXT\r\n", "ok N:0\r\n"});
    CHECK(net.content("test.txt") == "(none)");
}

TEST_CASE("network: what is not taken is bounded, and then requests are lost") {
    Network net;
    net.disk.put("f", noise(5000, 1));
    net.board.receive_datagram(net.now, alice, "M6032 'f'");
    for (int i = 0; i < 1000; ++i) {
        net.board.receive_datagram(net.now, alice, "M3001 I0");
    }
    std::size_t bytes = 0;
    net.board.take_datagrams([&](std::uint64_t, std::string_view answer) { bytes += answer.size(); });
    CHECK(bytes >= board::NetworkOutbox::limit);
    CHECK(bytes < board::NetworkOutbox::limit + 2000);
    CHECK(net.board.counters().requests_lost > 900);
    CHECK(net.ask("M4002").size() == 1);
}

TEST_CASE("network: on the line, M28 and M29 say more") {
    BoardDriver::Setup setup;
    MemoryDisk disk;
    disk.set_room(1000);
    setup.services.sd = &disk;
    BoardDriver serial("elegoo-mars-pro", setup);
    serial.run_for(3);
    const auto from = serial.bytes().size();
    serial.feed("M28 test.txt\r\n");
    serial.run_for(0.5);
    CHECK(serial.bytes().substr(from) == "Delete failed :TEST.TXT\r\nok N:0\r\n");
    const auto then = serial.bytes().size();
    serial.feed("M29\r\n");
    serial.run_for(0.5);
    CHECK(serial.bytes().substr(then) == "Done saving file!\r\n// TEST.TXT\r\nok N:0\r\n");
    REQUIRE(disk.content("test.txt") != nullptr);
    CHECK(disk.content("test.txt")->empty());
}

}  // namespace
}  // namespace fauxboard::testing
