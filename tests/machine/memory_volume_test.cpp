// A disk in memory: reading, writing, and its bounds.

#include "emulator/machine/memory_volume.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

using namespace fauxboard::machine;

namespace {

std::vector<BuiltInEntry> two_files() {
    BuiltInEntry file;
    file.name = "a.txt";
    file.content = "content";
    BuiltInEntry folder;
    folder.name = "sub";
    folder.folder = true;
    folder.entries.push_back(file);
    return {file, folder};
}

std::string read_all(const Volume& disk, std::string_view path) {
    std::array<char, 64> room{};
    const auto size = disk.read(path, 0, room);
    return size ? std::string(room.data(), *size) : "(none)";
}

}  // namespace

TEST_CASE("memory volume: holds what it was made of, folders behind files") {
    const MemoryVolume disk(two_files());
    std::vector<CardEntry> root;
    REQUIRE(disk.list("", root));
    REQUIRE(root.size() == 2);
    CHECK(root[0].name == "a.txt");
    CHECK(root[0].bytes == 7);
    CHECK(root[1].folder);
    std::vector<CardEntry> inside;
    REQUIRE(disk.list("sub", inside));
    CHECK(inside.size() == 1);
    CHECK_FALSE(disk.list("nothing", inside));
    CHECK(read_all(disk, "sub/a.txt") == "content");
    std::uint64_t bytes = 0;
    CHECK(disk.look("sub", bytes) == Volume::Kind::folder);
    CHECK(disk.look("b", bytes) == Volume::Kind::missing);
    CHECK_FALSE(disk.fixed());
}

TEST_CASE("memory volume: files are made, grow, take names, and go") {
    MemoryVolume disk(two_files());
    CHECK(disk.create("new"));
    CHECK(disk.append("new", 0, "abc"));
    CHECK_FALSE(disk.append("new", 0, "abc"));  // not its end
    CHECK(disk.append("new", 3, "def"));
    CHECK(disk.rename("new", "a.txt"));
    CHECK(read_all(disk, "a.txt") == "abcdef");
    CHECK(read_all(disk, "new") == "(none)");
    CHECK(disk.create("a.txt"));
    CHECK(read_all(disk, "a.txt").empty());
    CHECK(disk.remove("a.txt"));
    CHECK_FALSE(disk.remove("a.txt"));
    CHECK_FALSE(disk.append("a.txt", 0, "x"));
    CHECK_FALSE(disk.rename("a.txt", "b"));
}

TEST_CASE("memory volume: no file where a folder is, or none") {
    MemoryVolume disk(two_files());
    CHECK_FALSE(disk.create("sub"));
    CHECK_FALSE(disk.create("none/x"));
    CHECK_FALSE(disk.create(""));
    CHECK_FALSE(disk.rename("a.txt", "sub"));
    CHECK_FALSE(disk.remove("sub"));
    CHECK(disk.create("sub/x"));
}

TEST_CASE("memory volume: it is as big as it says, and room comes back") {
    MemoryVolume disk;
    const std::string piece(1U << 20U, 'x');
    REQUIRE(disk.create("big"));
    std::uint64_t at = 0;
    while (disk.append("big", at, piece)) {
        at += piece.size();
    }
    CHECK(at == MemoryVolume::room);
    CHECK_FALSE(disk.append("big", at, "y"));
    CHECK(disk.create("big"));
    CHECK(disk.append("big", 0, "y"));
    std::size_t files = 1;
    while (disk.create("f" + std::to_string(files))) {
        ++files;
    }
    CHECK(files == MemoryVolume::most_files);
}

TEST_CASE("memory volume: a file renamed to its own name stays, and none becomes a folder") {
    MemoryVolume disk(two_files());
    REQUIRE(disk.append("a.txt", 7, "+"));
    CHECK(disk.rename("a.txt", "a.txt"));
    CHECK(read_all(disk, "a.txt") == "content+");
    CHECK_FALSE(disk.rename("a.txt", "sub"));
}
