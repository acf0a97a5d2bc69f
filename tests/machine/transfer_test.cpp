// Files on their way onto a disk and off it: what is lost, damaged, repeated, late, or somebody else's.

#include "emulator/machine/transfer.h"

#include <doctest/doctest.h>

#include <random>
#include <string>

#include "emulator/machine/storage.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::machine {
namespace {

using namespace std::chrono_literals;
using Outcome = Transfer::Outcome;
using testing::MemoryDisk;

constexpr Transfer::Peer alice = 1;
constexpr Transfer::Peer bob = 2;

struct Bench {
    MemoryDisk disk;
    Storage storage;
    Transfer transfer{storage};
    SimTime now{0};
    Bench() {
        disk.set_room(1'000'000);
        disk.put("old.ctb", "old content");
        storage.attach(0, &disk);
    }
    bool begin(std::string_view name, Transfer::Peer peer = alice) {
        return transfer.upload(now, peer, name);
    }
    bool piece(std::uint64_t offset, std::string_view bytes, bool intact = true,
               Transfer::Peer peer = alice) {
        return transfer.piece(now, peer, intact, offset, bytes);
    }
    bool finish(Transfer::Peer peer = alice) { return transfer.finish(now, peer); }
    std::string content(std::string_view path) const {
        const std::string* const found = disk.content(path);
        return found == nullptr ? "(none)" : *found;
    }
    std::string block(std::size_t most = 4, Transfer::Peer peer = alice) {
        std::string bytes(most, '?');
        std::size_t got = 0;
        if (!transfer.block(now, peer, bytes, got)) {
            return "(none)";
        }
        return bytes.substr(0, got);
    }
};

TEST_CASE_FIXTURE(Bench, "transfer: an upload is beside until it is finished, then it has its name") {
    CHECK(begin("new file.ctb"));
    CHECK_FALSE(transfer.existed());
    CHECK(transfer.name() == "new file.ctb");
    CHECK(piece(0, "abc"));
    CHECK(piece(3, "de"));
    CHECK(transfer.position() == 5);
    CHECK(content("new file.ctb") == "(none)");
    CHECK(content("new file.ctb.temp") == "abcde");
    CHECK(transfer.takes_from(alice));
    CHECK(finish());
    CHECK(content("new file.ctb") == "abcde");
    CHECK(content("new file.ctb.temp") == "(none)");
    CHECK_FALSE(transfer.takes_from(alice));
    CHECK_FALSE(piece(5, "f"));
    CHECK(transfer.outcome == Outcome::not_open);
    CHECK_FALSE(finish());
    CHECK(transfer.outcome == Outcome::not_open);
}

TEST_CASE_FIXTURE(Bench, "transfer: half an upload never replaces a whole file, however it ends") {
    const auto check_old = [&] { CHECK(content("old.ctb") == "old content"); };
    REQUIRE(begin("old.ctb"));
    CHECK(transfer.existed());
    REQUIRE(piece(0, "new"));
    check_old();
    SUBCASE("closed") {
        CHECK(transfer.close(now, alice));
        CHECK(content("old.ctb.temp") == "(none)");
        CHECK_FALSE(finish());
    }
    SUBCASE("the power goes") {
        transfer.power_on();
        CHECK_FALSE(finish());
        // What lies there may be somebody's file by now: it stays, and the next upload has another name.
        CHECK(begin("old.ctb"));
        CHECK(piece(0, "again"));
        CHECK(content("old.ctb.temp") == "new");
        CHECK(content("old.ctb.fauxboard-temp") == "again");
    }
    SUBCASE("the disk is full") {
        disk.set_room(15);
        CHECK_FALSE(piece(3, "too much"));
        CHECK(transfer.outcome == Outcome::write_failed);
        CHECK(transfer.position() == 3);
        CHECK(piece(3, "w"));
    }
    SUBCASE("the disk is pulled out") {
        storage.attach(0, nullptr);
        CHECK_FALSE(piece(3, "more"));
        CHECK(transfer.outcome == Outcome::write_failed);
        CHECK_FALSE(finish());
        CHECK(transfer.outcome == Outcome::write_failed);
        CHECK(transfer.mode() == Transfer::Mode::none);
    }
    SUBCASE("another disk is put in") {
        MemoryDisk other;
        other.set_room(100);
        storage.attach(0, &other);
        CHECK_FALSE(piece(3, "more"));
        CHECK_FALSE(finish());
        CHECK(other.content("old.ctb") == nullptr);
    }
    check_old();
}

TEST_CASE_FIXTURE(Bench, "transfer: pieces that are damaged, repeated, late or early are asked for again") {
    REQUIRE(begin("a"));
    const auto refused = [&](std::uint64_t offset, bool intact) {
        CHECK_FALSE(piece(offset, "xyz", intact));
        CHECK(transfer.outcome == Outcome::resend);
    };
    refused(0, false);
    refused(3, true);
    CHECK(piece(0, "abc"));
    refused(0, true);  // its acknowledgement was lost
    refused(2, true);
    refused(6, true);
    refused(0xFFFF'FFFF, true);
    refused(3, false);
    CHECK(transfer.position() == 3);
    CHECK(piece(3, "def"));
    CHECK(finish());
    CHECK(content("a") == "abcdef");
}

TEST_CASE_FIXTURE(Bench,
                  "transfer: a line that loses, spoils, repeats and mixes up gives the file all the same") {
    std::mt19937_64 random(3);
    std::string file(20'000, '\0');
    for (char& byte : file) {
        byte = static_cast<char>(random() & 0xFF);
    }
    REQUIRE(begin("a"));
    std::uint64_t at = 0;  // what the sender believes
    for (int sent = 0; at < file.size(); ++sent) {
        REQUIRE(sent < 10'000);
        const auto size = static_cast<std::size_t>(1 + random() % 97);
        const std::uint64_t offset = random() % 10 == 0 ? random() % file.size() : at;
        const std::uint64_t chance = random() % 10;
        if (chance == 0) {
            continue;  // lost on its way
        }
        piece(offset, std::string_view(file).substr(offset, size), chance != 1);
        if (chance != 2) {
            at = transfer.position();  // ok or resend: both tell where to go on; else the answer was lost
        }
    }
    CHECK(finish());
    CHECK(content("a") == file);
}

TEST_CASE_FIXTURE(Bench, "transfer: a second sender is refused until the first is done, or gone for long") {
    REQUIRE(begin("a"));
    REQUIRE(piece(0, "abc"));
    CHECK_FALSE(begin("b", bob));
    CHECK(transfer.outcome == Outcome::busy);
    CHECK_FALSE(transfer.takes_from(bob));
    CHECK_FALSE(piece(3, "x", true, bob));
    CHECK(transfer.outcome == Outcome::busy);
    CHECK_FALSE(finish(bob));
    CHECK_FALSE(transfer.close(now, bob));
    CHECK_FALSE(transfer.download(now, bob, "old.ctb"));
    CHECK(content("b.temp") == "(none)");
    CHECK(transfer.name() == "a");
    CHECK_FALSE(begin("b"));  // not even its own, before it has closed
    now += Transfer::idle_limit - 1us;
    CHECK_FALSE(begin("b", bob));
    CHECK(piece(3, "d"));
    now += Transfer::idle_limit - 1us;
    CHECK_FALSE(begin("b", bob));
    now += 1us;
    CHECK(begin("b", bob));
    CHECK(content("a.temp") == "(none)");
    CHECK_FALSE(piece(4, "e"));
    CHECK(transfer.outcome == Outcome::busy);
    CHECK(transfer.close(now, bob));
    CHECK(transfer.close(now, alice));
}

TEST_CASE_FIXTURE(Bench, "transfer: M28 whose answer was lost may come again") {
    REQUIRE(begin("a"));
    CHECK(begin("a"));
    CHECK(piece(0, "abc"));
    CHECK_FALSE(begin("a"));
    CHECK(transfer.outcome == Outcome::busy);
    CHECK(finish());
    CHECK(content("a") == "abc");
}

TEST_CASE_FIXTURE(Bench, "transfer: names that are none, and disks that cannot be written") {
    for (const char* name : {"", "/", "..", "../a", "a/../../b", "a/", "a\nb", "\x01"}) {
        CAPTURE(std::string(name));
        CHECK_FALSE(begin(name));
        CHECK(transfer.outcome == Outcome::no_name);
    }
    CHECK_FALSE(begin(std::string(300, 'x')));
    CHECK(transfer.outcome == Outcome::no_name);
    disk.set_room(0);
    CHECK_FALSE(begin("a"));
    CHECK(transfer.outcome == Outcome::write_failed);
    storage.set_state(0, DiskState::failed);
    CHECK_FALSE(begin("a"));
    CHECK(transfer.outcome == Outcome::no_disk);
    CHECK_FALSE(transfer.download(now, alice, "old.ctb"));
    CHECK(transfer.outcome == Outcome::no_disk);
}

TEST_CASE_FIXTURE(Bench, "transfer: a name with a star does not mean the file without it") {
    disk.put("x", "kept");
    REQUIRE(begin("x*5"));
    CHECK(piece(0, "new"));
    CHECK(finish());
    CHECK(content("x") == "kept");
    CHECK(content("x*5") == "new");
}

TEST_CASE_FIXTURE(Bench, "transfer: a download in blocks, from anywhere, to the byte") {
    CHECK(block() == "(none)");
    CHECK(transfer.outcome == Outcome::not_open);
    CHECK_FALSE(transfer.download(now, alice, "missing"));
    CHECK(transfer.outcome == Outcome::missing);
    REQUIRE(transfer.download(now, alice, "old.ctb"));
    CHECK(transfer.bytes() == 11);
    CHECK(block() == "old ");
    CHECK(transfer.position() == 4);
    CHECK(block() == "cont");
    CHECK(block() == "ent");
    CHECK(block() == "(none)");
    CHECK(transfer.outcome == Outcome::at_end);
    CHECK(transfer.seek(now, alice, 3));
    CHECK(block(2) == " c");
    CHECK_FALSE(transfer.seek(now, alice, 11));
    CHECK(transfer.outcome == Outcome::at_end);
    CHECK(transfer.position() == 5);
    CHECK(block(1) == "o");
    CHECK_FALSE(transfer.seek(now, bob, 0));
    CHECK(block(4, bob) == "(none)");
    CHECK(transfer.outcome == Outcome::busy);
    CHECK_FALSE(begin("b", bob));
    CHECK(transfer.download(now, alice, "old.ctb"));  // anew, as clients do
    CHECK(block() == "old ");
    disk.remove("old.ctb");
    CHECK(block() == "(none)");
    CHECK(transfer.outcome == Outcome::missing);
    CHECK(transfer.close(now, alice));
    CHECK(begin("b", bob));
}

TEST_CASE("transfer: no file grows beyond the bound") {
    struct Endless final : Volume {
        std::uint64_t size = 0;
        bool list(std::string_view, std::vector<CardEntry>&) const override { return false; }
        Kind look(std::string_view, std::uint64_t&) const override { return Kind::missing; }
        std::optional<std::size_t> read(std::string_view, std::uint64_t, std::span<char>) const override {
            return {};
        }
        bool create(std::string_view) override { return true; }
        bool append(std::string_view, std::uint64_t offset, std::string_view bytes) override {
            CHECK(offset == size);
            size += bytes.size();
            return true;
        }
    } disk;
    Storage storage;
    storage.attach(0, &disk);
    Transfer transfer(storage);
    REQUIRE(transfer.upload(SimTime{0}, alice, "a"));
    const std::string piece(1U << 20, 'x');
    while (transfer.piece(SimTime{0}, alice, true, transfer.position(), piece)) {
    }
    CHECK(transfer.outcome == Outcome::write_failed);
    CHECK(disk.size == Transfer::max_bytes);
}

TEST_CASE_FIXTURE(Bench, "storage: a file is written whole, or not at all; and removed") {
    CHECK(storage.write("old.ctb", "new content"));
    CHECK(content("old.ctb") == "new content");
    CHECK(content("old.ctb.temp") == "(none)");
    disk.set_room(20);
    CHECK_FALSE(storage.write("old.ctb", std::string(30, 'x')));
    CHECK(content("old.ctb") == "new content");
    CHECK_FALSE(storage.write("../a", "x"));
    CHECK(storage.remove("old.ctb"));
    CHECK(content("old.ctb") == "(none)");
    CHECK_FALSE(storage.remove("old.ctb"));
    storage.attach(0, nullptr);
    CHECK_FALSE(storage.write("a", "x"));
}

TEST_CASE("transfer: what the user has under the name of an unfinished file stays") {
    Bench bench;
    bench.disk.put("new.ctb.temp", "mine");
    REQUIRE(bench.begin("new.ctb"));
    REQUIRE(bench.piece(0, "content"));
    CHECK(*bench.disk.content("new.ctb.temp") == "mine");
    REQUIRE(bench.finish());
    CHECK(*bench.disk.content("new.ctb") == "content");
    CHECK(*bench.disk.content("new.ctb.temp") == "mine");
    REQUIRE(bench.begin("new.ctb"));  // and when it is given up
    REQUIRE(bench.transfer.close(bench.now, alice));
    CHECK(*bench.disk.content("new.ctb.temp") == "mine");
    CHECK(bench.storage.write("new.ctb", "by the board"));
    CHECK(*bench.disk.content("new.ctb.temp") == "mine");
}

}  // namespace
}  // namespace fauxboard::machine
