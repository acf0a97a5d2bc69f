// What a name on the line means, and what it must never mean.

#include "emulator/machine/storage.h"

#include <doctest/doctest.h>

#include <random>

using namespace fauxboard::machine;
using std::string;

namespace {

string cleaned(std::string_view folder, std::string_view name) {
    string out = "unset";
    return clean_path(folder, name, out) ? out : "refused";
}

/// root: a.gco, "x*5", Sub/{b.gco, Deep/{c.gco}}, Main/{m.gco}
std::vector<BuiltInEntry> tree() {
    return {{"a.gco", false, "12345", {}},
            {"x*5", false, "1", {}},
            {"Sub", true, {}, {{"b.gco", false, "123", {}}, {"Deep", true, {}, {{"c.gco", false, "", {}}}}}},
            {"Main", true, {}, {{"m.gco", false, "1", {}}}}};
}

struct Bench {
    std::vector<BuiltInEntry> root = tree();
    BuiltInVolume volume{root};
    Storage storage;
    Bench() { storage.attach(0, &volume); }
    std::vector<string> names(unsigned limit = 64) {
        std::vector<CardEntry> entries;
        storage.listing(entries, limit);
        std::vector<string> out;
        for (const CardEntry& entry : entries) {
            out.push_back(entry.name + (entry.folder ? "/" : ""));
        }
        return out;
    }
};

}  // namespace

TEST_CASE("clean_path: names are relative to the folder, or to the root when a disk or a slash leads") {
    CHECK(cleaned("", "a.gco") == "a.gco");
    CHECK(cleaned("Sub", "b.gco") == "Sub/b.gco");
    CHECK(cleaned("Sub", "/b.gco") == "b.gco");
    CHECK(cleaned("Sub", "SD1:/b.gco") == "b.gco");
    CHECK(cleaned("Sub", "SD:b/c") == "b/c");
    CHECK(cleaned("", "UDISK:/x") == "x");
    CHECK(cleaned("Sub", "Deep//c.gco") == "Sub/Deep/c.gco");
    CHECK(cleaned("Sub", "./Deep/./c.gco/") == "Sub/Deep/c.gco");
    CHECK(cleaned("Sub", "") == "Sub");
    CHECK(cleaned("Sub", "/") == "");
    CHECK(cleaned("Sub", "SD1:") == "");
    CHECK(cleaned("", "...") == "...");
    CHECK(cleaned("", "..a/b..") == "..a/b..");
    CHECK(cleaned("", "a b \xe9\xff") == "a b \xe9\xff");
    CHECK(cleaned("", "folder/long:name") == "folder/long:name");
}

TEST_CASE("clean_path: nothing leads out of the root") {
    for (const string name : {"..", "../", "/..", "../..", "SD1:/..", "SD1:..", "a/..", "a/../b", "a/../../b",
                              "./..", "//..//", "Sub/../..", "../../../../etc/passwd", "/../etc/passwd",
                              "SD1:/../../etc", "UDISK:/..", "SD1:SD1:/..", "a/./../b"}) {
        CAPTURE(name);
        CHECK(cleaned("", name) == "refused");
        CHECK(cleaned("Sub/Deep", name) == "refused");
    }
}

TEST_CASE("clean_path: control characters and lengths beyond 255 are refused") {
    for (int c = 0; c < 32; ++c) {
        CHECK(cleaned("", string("a") + static_cast<char>(c) + "b") == "refused");
    }
    CHECK(cleaned("", string(254, 'x')) == string(254, 'x'));
    CHECK(cleaned("", string(300, 'x')) == "refused");
    CHECK(cleaned(string(200, 'f'), string(100, 'x')) == "refused");
    CHECK(cleaned("", string(1000000, '/')) == "refused");
}

TEST_CASE("clean_path: what comes out of any bytes is a clean path") {
    std::mt19937 random(1);
    constexpr std::string_view letters = "./:\\ab \x01\xff*SD1~";
    for (int i = 0; i < 200000; ++i) {
        string name;
        for (std::size_t n = random() % 24; n != 0; --n) {
            name += letters[random() % letters.size()];
        }
        const string out = cleaned(random() % 2 == 0 ? "" : "Sub", name);
        CAPTURE(name);
        REQUIRE_FALSE(out.starts_with('/'));
        REQUIRE_FALSE(out.ends_with('/'));
        REQUIRE(out.find("//") == string::npos);
        REQUIRE(("/" + out + "/").find("/../") == string::npos);
        REQUIRE(("/" + out + "/").find("/./") == string::npos);
        REQUIRE(out.find('\x01') == string::npos);
    }
}

TEST_CASE("storage: the root, a folder with its way back, and the way back") {
    Bench bench;
    CHECK(bench.names() == std::vector<string>{"a.gco", "x*5", "Sub/", "Main/"});
    CHECK(bench.storage.enter("SD1:/Sub"));
    CHECK(bench.names() == std::vector<string>{"Main/Sub/", "b.gco", "Deep/"});
    CHECK(bench.storage.enter("Deep"));
    CHECK(bench.storage.folder() == "Sub/Deep");
    CHECK(bench.names() == std::vector<string>{"Main/Deep/", "c.gco"});
    CHECK(bench.storage.enter("SD1:/Main/Deep"));
    CHECK(bench.storage.folder() == "Sub");
    CHECK(bench.storage.enter("Main/Sub"));
    CHECK(bench.storage.folder().empty());
}

TEST_CASE("storage: a folder that is really called Main can be entered and left") {
    Bench bench;
    CHECK(bench.storage.enter("SD1:/Main"));
    CHECK(bench.names() == std::vector<string>{"Main/Main/", "m.gco"});
    CHECK(bench.storage.enter("SD1:/Main/Main"));
    CHECK(bench.storage.folder().empty());
}

TEST_CASE("storage: what cannot be entered leaves the folder as it is") {
    Bench bench;
    REQUIRE(bench.storage.enter("Sub"));
    for (const char* name : {"a.gco", "b.gco", "nowhere", "..", "../..", "SD1:/..", "/nowhere", "Main",
                             "Main/Deep", "Main/", "Main/Sub/x", "sub"}) {
        CAPTURE(name);
        CHECK_FALSE(bench.storage.enter(name));
        CHECK(bench.storage.folder() == "Sub");
    }
    CHECK(bench.storage.enter("/"));
    CHECK(bench.storage.folder().empty());
}

TEST_CASE("storage: lists end at the limit, the way back included") {
    Bench bench;
    CHECK(bench.names(2).size() == 2);
    CHECK(bench.names(0).empty());
    bench.storage.enter("Sub");
    CHECK(bench.names(1) == std::vector<string>{"Main/Sub/"});
}

TEST_CASE("storage: a name means a file of the folder; a checksum kept in it is taken off if need be") {
    Bench bench;
    CHECK(bench.storage.find("a.gco").kind == Volume::Kind::file);
    CHECK(bench.storage.find("a.gco").bytes == 5);
    CHECK(bench.storage.find("a.gco*82").path == "a.gco");
    CHECK(bench.storage.find("a.gco*").path == "a.gco");
    CHECK(bench.storage.find("x*5").path == "x*5");
    CHECK(bench.storage.find("x*5*99").path == "x*5");
    CHECK(bench.storage.find("a.gco*8x").kind == Volume::Kind::missing);
    CHECK(bench.storage.find("Sub").kind == Volume::Kind::folder);
    CHECK(bench.storage.find("b.gco").kind == Volume::Kind::missing);
    CHECK(bench.storage.find("Sub/b.gco").path == "Sub/b.gco");
    bench.storage.enter("Sub");
    CHECK(bench.storage.find("b.gco").path == "Sub/b.gco");
    CHECK(bench.storage.find("/a.gco").path == "a.gco");
    for (const char* name : {"", "*", "*5", "..", "/", "SD1:", "a.gco/", "b.gco/x", "../a.gco"}) {
        CAPTURE(name);
        CHECK(bench.storage.find(name).kind == Volume::Kind::missing);
    }
}

TEST_CASE("storage: disks come and go") {
    Bench bench;
    bench.storage.enter("Sub");
    bench.storage.attach(0, nullptr);
    CHECK(bench.storage.state(0) == DiskState::removed);
    CHECK_FALSE(bench.storage.usable(0));
    CHECK(bench.names().empty());
    CHECK(bench.storage.find("a.gco").kind == Volume::Kind::missing);
    CHECK_FALSE(bench.storage.enter("Sub"));
    bench.storage.attach(0, &bench.volume);
    CHECK(bench.storage.folder().empty());
    CHECK(bench.names().size() == 4);
    bench.storage.set_state(0, DiskState::failed);
    CHECK_FALSE(bench.storage.usable(0));
    CHECK(bench.names().empty());
}

TEST_CASE("storage: a card put out of use stays in its slot") {
    Bench bench;
    bench.storage.release(0);
    CHECK(bench.storage.state(0) == DiskState::removed);
    CHECK(bench.names().empty());
    bench.storage.mount(0);
    CHECK(bench.names().size() == 4);
    bench.storage.attach(0, nullptr);
    bench.storage.mount(0);
    CHECK_FALSE(bench.storage.usable(0));
    bench.storage.attach(0, &bench.volume);
    bench.storage.set_state(0, DiskState::failed);
    bench.storage.mount(0);
    bench.storage.release(0);
    CHECK(bench.storage.state(0) == DiskState::failed);
}

TEST_CASE("storage: the other disk has a root of its own") {
    Bench bench;
    bench.storage.enter("Sub");
    CHECK(bench.storage.choose(1));
    CHECK(bench.storage.chosen() == 1);
    CHECK(bench.names().empty());
    bench.storage.attach(1, &bench.volume);
    CHECK(bench.names().size() == 4);
    CHECK_FALSE(bench.storage.choose(2));
    CHECK_FALSE(bench.storage.choose(-1));
    CHECK(bench.storage.choose(0));
    CHECK(bench.storage.folder().empty());
}

TEST_CASE("storage: names lose their quotes and the colon of an absolute path") {
    for (const char* name :
         {"a b.ctb", "'a b.ctb'", "\"a b.ctb\"", "':a b.ctb'", ":'a b.ctb'", ":a b.ctb", "  'a b.ctb'  "}) {
        CAPTURE(name);
        CHECK(bare_name(name) == "a b.ctb");
    }
    CHECK(bare_name("it's.ctb") == "it's.ctb");
    CHECK(bare_name("'it's.ctb'") == "it's.ctb");
    CHECK(bare_name("/dir/a.ctb") == "/dir/a.ctb");
    for (const char* nothing : {"", "'", "''", ":", " : '", "\"\""}) {
        CAPTURE(nothing);
        CHECK(bare_name(nothing).empty());
    }
}
