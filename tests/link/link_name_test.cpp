#include "emulator/link/link_name.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;
namespace fs = std::filesystem;

TEST_CASE("a link name is made and removed") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    const std::string target = folder.file("terminal");
    std::ofstream(target) << "x";
    {
        LinkName link;
        link.create(name, target);
        CHECK(fs::read_symlink(name) == target);
    }
    CHECK_FALSE(fs::is_symlink(name));
}

TEST_CASE("a file, or a link to something that exists, is never replaced") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    const std::string other = folder.file("other");
    std::ofstream(other) << "precious";
    LinkName link;
    SUBCASE("file") {
        std::ofstream(name) << "precious";
        CHECK(contains(link_error([&] { link.create(name, "/dev/pts/99999"); }), "not a symlink"));
        CHECK(fs::is_regular_file(name));
    }
    SUBCASE("folder") {
        fs::create_directory(name);
        CHECK(contains(link_error([&] { link.create(name, "/dev/pts/99999"); }), "not a symlink"));
    }
    SUBCASE("link in use") {
        fs::create_symlink(other, name);
        CHECK(contains(link_error([&] { link.create(name, "/dev/pts/99999"); }), other));
        CHECK(fs::read_symlink(name) == other);
    }
    link.remove();
    CHECK(fs::exists(name));
}

TEST_CASE("a link to nowhere, or left behind for the same terminal, is taken over") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    const std::string target = folder.file("terminal");
    std::ofstream(target) << "x";
    SUBCASE("nowhere") {
        fs::create_symlink(folder.file("gone"), name);
    }
    SUBCASE("same") {
        fs::create_symlink(target, name);
    }
    LinkName link;
    link.create(name, target);
    CHECK(fs::read_symlink(name) == target);
    link.remove();
    CHECK_FALSE(fs::is_symlink(name));
    CHECK(std::distance(fs::directory_iterator(fs::path(name).parent_path()), fs::directory_iterator()) == 1);
}

TEST_CASE("a link that somebody turned elsewhere meanwhile is left alone") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    LinkName link;
    link.create(name, folder.file("ours"));
    fs::remove(name);
    fs::create_symlink(folder.file("theirs"), name);
    link.remove();
    CHECK(fs::read_symlink(name) == folder.file("theirs"));
}

TEST_CASE("a link in a folder that does not exist says so") {
    const TemporaryFolder folder;
    LinkName link;
    CHECK(contains(link_error([&] { link.create(folder.file("no/screen"), "/x"); }), "No such file"));
}
