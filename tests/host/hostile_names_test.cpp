// One list of hostile names through every request that takes one, on a board whose card is a real folder:
// nothing outside of it is read, made, changed or removed.

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "emulator/board/board.h"
#include "emulator/host/folder_card.h"
#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/link/helpers.h"
#include "tests/support/hostile_names.h"
#include "tests/support/printers.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;
using board::Channel;

constexpr std::string_view secret = "G28 ; nobody may see this, nor print it\n";

/// A folder with files, and within it the card, full of traps.
struct Trap {
    link::test::TemporaryFolder outside;
    std::string card = outside.file("card");

    Trap() {
        put("secret.gco", secret);
        fs::create_directories(outside.file("other"));
        put("other/secret.gco", secret);
        fs::create_directories(card + "/sub");
        put("card/inside.gco", "G28\n");
        fs::create_symlink(outside.file("secret.gco"), card + "/link");
        fs::create_symlink("../secret.gco", card + "/link.temp");
        fs::create_symlink("../../secret.gco", card + "/sub/link");
        fs::create_symlink(outside.file("other"), card + "/folder_link");
        fs::create_symlink("loop", card + "/loop");
        fs::create_symlink(outside.file("made.gco"), card + "/dangling");
        fs::create_hard_link(outside.file("secret.gco"), card + "/hard");
        REQUIRE(::mkfifo((card + "/pipe").c_str(), 0600) == 0);
    }
    void put(const std::string& name, std::string_view text) const {
        std::ofstream out(outside.file(name), std::ios::binary);
        out << text;
        REQUIRE(out.good());
    }
    static std::string read(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// All that is outside of the card, with its content.
    std::map<std::string, std::string> seen_outside() const {
        std::map<std::string, std::string> all;
        for (auto at = fs::recursive_directory_iterator(outside.file(""));
             at != fs::recursive_directory_iterator(); ++at) {
            if (at->path() == card) {
                at.disable_recursion_pending();
            }
            all[at->path().string()] = at->is_regular_file() ? read(at->path()) : "(no file)";
        }
        return all;
    }
    /// The traps themselves, each as what it is.
    std::string traps() const {
        std::string out;
        for (const char* name :
             {"link", "link.temp", "sub/link", "folder_link", "loop", "dangling", "pipe"}) {
            const auto type = fs::symlink_status(card + "/" + name).type();
            out += type == fs::file_type::symlink ? "link " : type == fs::file_type::fifo ? "pipe " : "gone ";
        }
        return out;
    }
};

/// A board with that card; both of its lines.
struct Bench {
    FolderCard card;
    board::Board board;
    machine::SimTime now{0};

    explicit Bench(const Trap& trap)
        : card(trap.card),
          board(load_profile_by_name("geeetech-a30t"), machine::Services{&card, nullptr, nullptr, nullptr},
                {false, 1, nullptr}) {
        board.connect(Channel::host, true);
        board.power_on(now);
        pass(5);
    }
    /// What both sides are told meanwhile.
    std::string pass(double seconds) {
        std::string said;
        const machine::SimTime end = now + machine::from_seconds(seconds);
        const auto take = [&] {
            said.append(board.output()).append(board.output(Channel::host));
            board.clear_output();
        };
        take();
        for (machine::SimTime due = board.advance(end); due <= end; due = board.advance(end)) {
            take();
        }
        take();
        now = end;
        return said;
    }
    std::string screen(const std::string& body) {
        board.receive(now, protocol::frame(body));
        return pass(0.3);
    }
    std::string host(const std::string& line) {
        board.receive(now, line + "\n", Channel::host);
        return pass(0.3);
    }
    void stop() {
        screen("M2103");
        host("M29");
        screen("M20 file:/");
    }
};

bool tells_secret(const std::string& said) {
    return said.find("nobody may see") != std::string::npos;
}

TEST_CASE("hostile names: nothing outside is selected, printed or listed") {
    const Trap trap;
    const auto before = trap.seen_outside();
    Bench bench(trap);
    for (const std::string& name : testing::hostile_names(trap.outside.file("secret.gco"))) {
        CAPTURE(name);
        for (const bool by_screen : {true, false}) {
            const std::string said = by_screen ? bench.screen("M23 " + name) : bench.host("M23 " + name);
            CHECK_FALSE(tells_secret(said));
            bench.screen("M24");
            // "hard" is a file of the card as well as of what is outside, and no program can tell.
            const std::string path(bench.board.machine().job.path());
            CHECK((path.empty() || path == "hard" || path.find("secret") == std::string::npos));
            if (path != "hard") {
                CHECK(bench.board.machine().job.file_bytes() != secret.size());
            }
            bench.stop();
        }
        const std::string listed = bench.screen("M20 file:" + name);
        CHECK(listed.find("other") == std::string::npos);
        CHECK(listed.find("secret.gco") == std::string::npos);
        const std::string& folder = bench.board.machine().storage.folder();
        CHECK((folder.empty() || folder == "sub"));
        bench.stop();
    }
    CHECK(trap.seen_outside() == before);
}

TEST_CASE("hostile names: nothing outside is made, changed or removed") {
    const Trap trap;
    const auto before = trap.seen_outside();
    const std::string traps = trap.traps();
    Bench bench(trap);
    int written = 0;
    for (const std::string& name : testing::hostile_names(trap.outside.file("secret.gco"))) {
        CAPTURE(name);
        const std::string began = bench.host("M28 " + name);
        bench.host("M117 an intruder");
        const std::string ended = bench.host("M29");
        CHECK_FALSE(tells_secret(began));
        written += ended.find("Done saving file.") != std::string::npos ? 1 : 0;
        CHECK_FALSE(
            testing::filament_printer(bench.board.machine()).host.writing(machine::HostSide::usb_port));
        CHECK(trap.seen_outside() == before);
        bench.host("M30 " + name);
        CHECK(trap.seen_outside() == before);
        CHECK(trap.traps() == traps);
        bench.stop();
    }
    CHECK(written > 10);  // odd names, and harmless ones within the card
    CHECK(Trap::read(trap.card + "/inside.gco") == "G28\n");
    // The board is as it was.
    CHECK(bench.host("M105").find("ok T:") != std::string::npos);
    CHECK(bench.host("M30 inside.gco").find("File deleted:inside.gco") != std::string::npos);
    CHECK_FALSE(fs::exists(trap.card + "/inside.gco"));
}

}  // namespace
}  // namespace fauxboard::host
