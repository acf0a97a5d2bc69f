// The wires to the UV panel as the real program gives them: into a file, and to somebody who answers.

#include <sys/socket.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "emulator/dlp/spi_frames.h"
#include "emulator/link/inet_socket.h"
#include "tests/e2e/program.h"
#include "tests/e2e/raw_peer.h"
#include "tests/support/dlp_bench.h"

namespace fauxboard::e2e {
namespace {

using dlp::ChipSelect;
using dlp::SpiKind;
using dlp::SpiRecord;
using nlohmann::json;

/// A stick with a print of so few layers.
void make_stick(const TemporaryFolder& folder) {
    std::filesystem::create_directory(folder.file("stick"));
    testing::PanelPws wishes;
    wishes.layers = 2;
    std::ofstream(folder.file("stick/model.pws"), std::ios::binary) << testing::make_panel_pws(wishes);
}

std::string script_of(const TemporaryFolder& folder, const std::string& check) {
    std::ofstream(folder.file("print.json")) << R"({"name": "print", "profile": "mks-dlp", "steps": [
        { "wait": { "event": "board.ready" } },
        { "do": { "print.start": { "path": "model.pws" } } },
        { "wait": { "event": "print.finished" }, "within": "1h", "real": "2min" },
        { "check": )" + check + "}]}";
    return folder.file("print.json");
}

std::vector<SpiRecord> records_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    dlp::SpiSplitter splitter;
    splitter.feed(std::string(std::istreambuf_iterator<char>(in), {}));
    std::vector<SpiRecord> out;
    while (auto record = splitter.next())
        out.push_back(std::move(*record));
    CHECK(splitter.skipped() + splitter.waiting() == 0);
    return out;
}

/// The other end: an FPGA that takes each packet at its second try, and has version 5.
class Model {
  public:
    explicit Model(const std::string& address, bool with_controllers = false) {
        const link::SocketAddress where = link::resolve(address, SOCK_STREAM).front();
        fd_.reset(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        REQUIRE(::connect(fd_.get(), where.get(), where.size()) == 0);
        say({SpiKind::pin, ChipSelect::fpga, true, 0, dlp::SimTime{0}, {}});
        say({SpiKind::in, ChipSelect::fpga, false, 0, dlp::SimTime{0}, {}});
        if (with_controllers) say({SpiKind::in, ChipSelect::left, false, 0, dlp::SimTime{0}, {}});
    }
    /// Answers until the other end closes.
    void serve() {
        std::array<char, 65536> room{};
        for (ssize_t count = 0; (count = ::read(fd_.get(), room.data(), room.size())) > 0;) {
            splitter_.feed({room.data(), static_cast<std::size_t>(count)});
            while (const auto record = splitter_.next())
                take(*record);
        }
    }
    std::size_t packets = 0;
    std::size_t repeats = 0;
    std::atomic<bool> has_ids{true};

  private:
    void take(const SpiRecord& record) {
        if (record.kind == SpiKind::out && record.chip != ChipSelect::fpga &&
            record.data.starts_with(static_cast<char>(dlp::id_register)) && has_ids) {
            say({SpiKind::in, record.chip, false, record.number, dlp::SimTime{0}, {0, 0, '\x28', '\x28'}});
        }
        if (record.kind != SpiKind::out || record.chip != ChipSelect::fpga) return;
        if (record.data.size() == dlp::packet_bytes) {
            ++packets;
            const bool again = record.data == last_;
            repeats += again ? 1 : 0;
            last_ = again ? std::string() : record.data;
            say({SpiKind::pin, ChipSelect::fpga, again, record.number, dlp::SimTime{0}, {}});
        } else if (record.data[0] == '\0') {
            command_ = record.data[2];
        } else {
            const auto byte = static_cast<char>(command_ | 5);
            say({SpiKind::in, ChipSelect::fpga, false, record.number, dlp::SimTime{0}, {0, 0, byte}});
        }
    }
    void say(const SpiRecord& record) {
        const std::string bytes = dlp::spi_bytes(record);
        ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }

    UniqueFd fd_;
    dlp::SpiSplitter splitter_;
    std::string last_;
    int command_ = 0;
};

TEST_CASE("run --spi FILE, and decode: every packet and command by its name") {
    const TemporaryFolder folder;
    make_stick(folder);
    const std::string file = folder.file("wires.spi");
    const Result result = run({"run", "--script", script_of(folder, R"({ "watch.broken": 0 })"), "--speed",
                               "max", "--udisk", folder.file("stick"), "--spi", file});
    INFO(result.errors);
    REQUIRE(result.code == 0);
    CHECK(contains(result.out, R"("spi":{"link":"file","path":")" + file + "\"}"));
    const auto records = records_of(file);
    // The test image, then two layers; each layer between "off" and "show".
    std::size_t lines = 0;
    std::size_t shows = 0;
    dlp::SimTime before{0};
    for (const SpiRecord& record : records) {
        lines += record.data.size() == dlp::packet_bytes ? 1U : 0U;
        shows += record.kind == SpiKind::out && record.data == std::string("\0\0\xC0", 3) ? 1U : 0U;
        CHECK(record.at >= before);
        before = record.at;
    }
    CHECK(lines == 3 * 2560);
    CHECK(shows == 2);
    const Result words = run({"decode", file});
    CHECK(words.code == 0);
    CHECK(contains(words.out, "board  fpga   command    C0: bank 0, scan on, SDRAM on\n"));
    CHECK(contains(words.out, "panel  fpga   read back  C2: bank 0, scan on, SDRAM on, version 2\n"));
    CHECK(contains(words.out, "board  fpga   line       bank 0, line 2559: 0 lit, checksum A495 good\n"));
    CHECK(contains(words.out, "board  left   register   29 = 0000: display on\n"));
    const Result told = run({"decode", "--json", file});
    const json first = json::parse(told.out.substr(0, told.out.find('\n')));
    CHECK(first == json{{"t", 0.3},
                        {"from", "board"},
                        {"chip", "fpga"},
                        {"number", 1},
                        {"what", "command"},
                        {"words", "20: bank 2, scan off, SDRAM off"},
                        {"wrong", false},
                        {"bytes", "000020"}});
    std::ofstream(file, std::ios::binary | std::ios::app) << "half";
    CHECK(run({"decode", file}).code == failed);
}

TEST_CASE("run --spi HOST:PORT: a model at the other end says what the pin and the command byte are") {
    const TemporaryFolder folder;
    make_stick(folder);
    Program board({"run", "--script",
                   script_of(folder, R"({ "fpga.retries": { "min": 5120 }, "fpga.failed_lines": 0,
                                                            "fpga.failed_commands": 0, "print.bad_layers": 0 })"),
                   "--speed", "40", "--udisk", folder.file("stick"), "--spi", "127.0.0.1:0"});
    const json ready = board.ready();
    CHECK(ready["spi"]["link"] == "tcp");
    Model model(ready["spi"]["path"].get<std::string>());
    std::thread serving([&] { model.serve(); });
    const int code = board.wait();
    serving.join();
    INFO(board.errors());
    CHECK(code == 0);
    CHECK(model.repeats >= 5120);
    CHECK(model.packets == model.repeats * 2);
}

TEST_CASE("run --spi HOST:PORT: who plays the controllers and does not give their ids has no panel") {
    const TemporaryFolder folder;
    Program board(
        {"run", "--profile", "mks-dlp", "-q", "--spi", "127.0.0.1:0", "--control", folder.file("control")});
    const json ready = board.ready();
    const auto ctl = [&](Args words) {
        words.insert(words.begin(), {"ctl", folder.file("control")});
        return run(words).out;
    };
    Model model(ready["spi"]["path"].get<std::string>(), true);
    std::thread serving([&] { model.serve(); });
    ctl({"advance", "5s"});
    for (const bool there : {false, true, false}) {
        CAPTURE(there);
        model.has_ids = there;
        ctl({"do", "board.doze"});
        ctl({"do", "board.wake"});
        CHECK(contains(ctl({"get", "panel.powered"}), there ? "true" : "false"));
    }
    CHECK(board.stop() == 0);
    serving.join();
    CHECK(contains(board.errors(), "no longer says the ids of the controllers: they are missing."));
}

TEST_CASE("run --spi pty: whoever listens hears it, and what it says in vain does no harm") {
    const TemporaryFolder folder;
    Program board({"run", "--profile", "mks-dlp", "-q", "--speed", "20", "--spi",
                   "pty=" + folder.file("wires"), "--control", folder.file("control")});
    CHECK(board.ready()["spi"]["link"] == "pty");
    CHECK(run({"ctl", folder.file("control"), "advance", "3s"}).code == 0);
    RawPeer peer(folder.file("wires"));
    peer.say("\xA5\xA5 not a record");
    CHECK(run({"ctl", folder.file("control"), "do", "uvtest.display", R"({"on": true})"}).code == 0);
    CHECK(peer.until(std::string("\0\0\xD0", 3)) != "(silence)");
    CHECK(run({"ctl", folder.file("control"), "get", "panel.command"}).code == 0);
    CHECK(board.stop() == 0);
    CHECK_FALSE(std::filesystem::exists(folder.file("wires")));
}

TEST_CASE("run --spi: what cannot be is said") {
    const TemporaryFolder folder;
    check_mistakes(
        {{{"run", "--spi", folder.file("wires")}, bad_input, "has no UV panel: leave --panel and --spi out"},
         {{"run", "--profile", "mks-dlp", "--spi", folder.file("none/wires")},
          bad_input,
          "cannot be written to"},
         {{"run", "--profile", "mks-dlp", "--spi", "nowhere.invalid:1"}, no_port, "nowhere.invalid"}});
}

}  // namespace
}  // namespace fauxboard::e2e
