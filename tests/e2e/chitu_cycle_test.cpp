// A resin board as a whole, by the real program: a file goes up by UDP over a bad network, is printed by
// requests over a pseudo-terminal, and comes down again; all of it is recorded, explained, and replayed.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "tests/e2e/program.h"
#include "tests/e2e/raw_peer.h"
#include "tests/link/udp_helpers.h"
#include "tests/support/resin_file.h"
#include "tests/support/transfer_client.h"

namespace fauxboard::e2e {
namespace {

using link::test::UdpClient;
using testing::TransferClient;

constexpr std::uint64_t file_bytes = 1'000'000;

/// Layers first, then anything.
struct File {
    File() {
        testing::ResinFile wishes;
        wishes.layers = 6;
        wishes.bottom_layers = 1;
        wishes.exposure_s = 20;
        wishes.bottom_exposure_s = 60;
        const testing::MadeResinFile made = testing::make_resin_file(wishes);
        ends.assign(made.layer_ends.begin(), made.layer_ends.end());
        bytes = made.bytes + testing::pattern(made.bytes.size(), file_bytes - made.bytes.size());
    }
    bool is_place(unsigned long place) const {
        return place == 0 || std::find(ends.begin(), ends.end(), place) != ends.end();
    }
    std::string bytes;
    std::vector<unsigned long> ends;
};

struct Status {
    unsigned long place = 9;
    unsigned long bytes = 9;
    unsigned long halted = 9;
};

class Serial {
  public:
    explicit Serial(const std::string& path) : peer_(path) {}
    /// The answer without the ok behind it that comes of a word of ours.
    std::string ask(const std::string& line) {
        peer_.say(line + "\r\nM5002\r\n");
        return peer_.until("0x350041 0x4d485001 0x20393150\r\n");
    }
    Status status() {
        const std::string said = ask("M4000");
        Status out;
        const std::size_t at = said.find(" D:");
        REQUIRE(at != std::string::npos);
        REQUIRE(std::sscanf(said.c_str() + at, " D:%lu/%lu/%lu ", &out.place, &out.bytes, &out.halted) == 3);
        return out;
    }
    /// Asks until it is so. The program's clock runs; a print that stands still hangs the test, and nothing
    /// else does.
    template <class Test>
    Status wait_for(Test&& test) {
        while (true) {
            const Status now = status();
            if (test(now)) {
                return now;
            }
        }
    }

  private:
    RawPeer peer_;
};

std::string read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void print_it(Serial& serial, const File& file) {
    const std::string total = std::to_string(file_bytes);
    CHECK(contains(serial.ask("M20"), "\r\nbox one.ctb " + total + "\r\n"));
    CHECK(serial.ask("M4006") == "ok 'none'\r\n");
    CHECK(serial.ask("M6030 'box one.ctb'") == "ok N:0\r\n");
    CHECK(serial.ask("M4006") == "ok 'box one.ctb'\r\n");
    Status now = serial.wait_for([&](const Status& s) {
        CHECK(s.bytes == file_bytes);
        CHECK(s.halted == 0);
        CHECK(file.is_place(s.place));
        return s.place != 0;
    });
    CHECK(serial.ask("M25") == "ok N:0\r\n");
    now = serial.wait_for([](const Status& s) { return s.halted == 1; });
    CHECK(file.is_place(now.place));
    CHECK(serial.ask("M27") ==
          "SD printing byte " + std::to_string(now.place) + "/" + total + "\r\nok N:0\r\n");
    CHECK(serial.ask("M24") == "ok N:0\r\n");
    CHECK(serial.status().halted == 0);
    const unsigned long before = now.place;
    serial.wait_for([&](const Status& s) { return s.place > before; });
    CHECK(serial.ask("M33") == "ok N:0\r\n");
    now = serial.status();
    CHECK(now.place == 0);
    CHECK(now.bytes == 0);
    CHECK(now.halted == 1);
    CHECK(serial.ask("M27") == "Error:It's not printing now!\r\nok N:0\r\n");

    CHECK(serial.ask("M6030 'box one.ctb'") == "ok N:0\r\n");
    unsigned long last = 0;
    serial.wait_for([&](const Status& s) {
        CHECK(file.is_place(s.place));
        CHECK((s.place >= last || s.bytes == 0));
        last = s.place;
        return s.bytes == 0;
    });
    CHECK(serial.ask("M27") == "Error:It's not printing now!\r\nok N:0\r\n");
    CHECK(serial.ask("M4006") == "ok 'box one.ctb'\r\n");
    CHECK(serial.ask("M114") == "ok C: X:0.000000 Y:0.000000 Z:155.000000 E:0.000000\r\n");
}

TEST_CASE("a resin print from the network to its end: up, listed, paused, stopped, printed, and down again") {
    const File file;
    TemporaryFolder folder;
    const std::string card = folder.file("card");
    std::filesystem::create_directory(card);
    const std::string record = folder.file("talk.jsonl");
    Program program({"run", "--profile", "elegoo-mars-pro", "--udp", ":0", "--sd", card, "--speed", "200",
                     "--record", record, "-q"});
    const auto ready = program.ready();
    const UdpClient socket(ready["udp"]);
    TransferClient client(
        {[&](std::string_view bytes) { socket.send(bytes); }, [&] { return socket.receive(patience_ms); }},
        {0.02, 5});
    const auto content = [&](std::uint64_t at, std::size_t size) {
        return file.bytes.substr(static_cast<std::size_t>(at), size);
    };
    REQUIRE(client.upload("box one.ctb", file_bytes, content) == "");
    CHECK(client.damaged + client.lost + client.repeated > 5);
    CHECK(read_file(card + "/box one.ctb") == file.bytes);
    Serial serial(ready["path"]);
    print_it(serial, file);
    std::string back;
    CHECK(client.download("box one.ctb", file_bytes, [&](std::string_view bytes) { back += bytes; }) == "");
    CHECK(back == file.bytes);
    CHECK(program.stop() == 0);

    const std::string words = run({"decode", record}).out;
    for (const char* word : {"network → board", "piece of a file: 1280 bytes from 0 on", "; damaged",
                             "board → network", "ok 1000000/1000000", "Done saving file!"}) {
        CAPTURE(word);
        CHECK(contains(words, word));
    }
    const std::string second = folder.file("second");
    std::filesystem::create_directory(second);
    const Result replayed = run({"replay", "--profile", "elegoo-mars-pro", "--sd", second, record});
    CHECK(replayed.code == 0);
    CHECK(read_file(second + "/box one.ctb") == file.bytes);
    CHECK(contains(replayed.out, "\"from\": \"module\", \"peer\": 1, \"datagram\": \"ok\\r\\n\""));
    CHECK(contains(replayed.out, "SD printing byte "));
    CHECK(run({"replay", "--sd", folder.file("nowhere"), record}).code == bad_input);
}

TEST_CASE("logs call the other end of a resin board's line what its profile calls it") {
    Program program({"run", "--profile", "elegoo-mars-pro"});
    RawPeer peer(program.ready()["path"]);
    peer.say("M4004\r\n");
    peer.until("ok C:0\r\n");
    CHECK(program.stop() == 0);
    CHECK(contains(program.errors(), "host → board"));
    CHECK(contains(program.errors(), "board → host"));
    CHECK_FALSE(contains(program.errors(), "screen"));
}

TEST_CASE("a resin board meets faults of its line and of its network by the command line") {
    TemporaryFolder folder;
    std::ofstream(folder.file("a.ctb")) << "abc";
    Program program({"run", "--profile", "elegoo-mars-pro", "--udp", ":0", "--sd", folder.file(""), "--fault",
                     "stray_ok:to_screen,number=80,after=8", "--fault", "chunk_damaged:share=100", "-q"});
    const auto ready = program.ready();
    RawPeer peer(ready["path"]);
    peer.say("M4004\r\nM4004\r\n");
    CHECK(contains(peer.until("ok C:0\r\n") + peer.until("ok C:0\r\n"), "ok N:80\r\n"));
    const UdpClient socket(ready["udp"]);
    socket.send("M28 b.ctb");
    CHECK(socket.receive(patience_ms) == "ok N:0\r\n");
    const std::string whole("abc\0\0\0\0\x60\x83", 9);
    socket.send(whole);
    CHECK(socket.receive(patience_ms) == "resend 0\r\n");
    socket.send("M4012 I1 T3");
    CHECK(socket.receive(patience_ms) == "ok 0/0\r\n");
}

TEST_CASE("a resin board's network and settings are in its EEPROM file") {
    TemporaryFolder folder;
    const std::string eeprom = folder.file("eeprom");
    const auto ask = [&](const std::string& request) {
        Program program({"run", "--profile", "elegoo-mars-pro", "--eeprom", eeprom, "-q"});
        Serial serial(program.ready()["path"]);
        const std::string answer = serial.ask(request);
        CHECK(program.stop() == 0);
        return answer;
    };
    ask("M9003 \"attic net\",\"secret\"\r\nU100 'attic'\r\nM8026 I140\r\nM8500");
    const std::string kept = read_file(eeprom);
    for (const char* part : {"attic net", "secret", "140"}) {
        CAPTURE(part);
        CHECK(contains(kept, part));
    }
    CHECK(contains(ask("M99999"), " NAME:attic\r\n"));
    CHECK(contains(ask("M4001"), "T:0/0/0/140/1"));
}

}  // namespace
}  // namespace fauxboard::e2e
