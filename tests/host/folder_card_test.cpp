#include "emulator/host/folder_card.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <fstream>
#include <limits>
#include <optional>

#include "emulator/link/host_error.h"
#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;
using Kind = machine::Volume::Kind;
using link::test::TemporaryFolder;

struct Card {
    TemporaryFolder outside;
    std::string root = outside.file("card");
    Card() { fs::create_directory(root); }

    void file(const std::string& name, std::string_view text = "x") const {
        std::ofstream out(root + "/" + name, std::ios::binary);
        out << text;
        REQUIRE(out.good());
    }
    void folder(const std::string& name) const { fs::create_directories(root + "/" + name); }
    std::vector<std::string> list(std::string_view path = "") const {
        std::vector<machine::CardEntry> entries;
        std::vector<std::string> names;
        if (!FolderCard(root).list(path, entries)) {
            return {"(none)"};
        }
        for (const machine::CardEntry& entry : entries)
            names.push_back(entry.name + (entry.folder ? "/" : ":" + std::to_string(entry.bytes)));
        return names;
    }
    Kind look(std::string_view path) const {
        std::uint64_t bytes = 0;
        return FolderCard(root).look(path, bytes);
    }
    /// What is read from `offset` on, at most `most` bytes; "(none)" when there is no such file.
    std::string read(std::string_view path, std::uint64_t offset = 0, std::size_t most = 64) const {
        std::string bytes(most, '?');
        const auto got = card().read(path, offset, bytes);
        return got ? bytes.substr(0, *got) : "(none)";
    }
    /// The card the tests of reading share: it was there before what is done to the folder.
    const FolderCard& card() const {
        if (!card_) {
            card_.emplace(root);
        }
        return *card_;
    }

  private:
    mutable std::optional<FolderCard> card_;
};

using Names = std::vector<std::string>;

TEST_CASE_FIXTURE(Card, "files first, then folders, each by name") {
    folder("b-folder");
    folder("a-folder");
    file("z.gcode", "12345");
    file("B.gcode");
    file("a.gcode", "");
    file("a-folder/inner.gcode", "1234567");
    CHECK(list() == Names{"B.gcode:1", "a.gcode:0", "z.gcode:5", "a-folder/", "b-folder/"});
    CHECK(list("a-folder") == Names{"inner.gcode:7"});
    CHECK(list("b-folder").empty());
    std::uint64_t bytes = 0;
    CHECK(FolderCard(root).look("a-folder/inner.gcode", bytes) == Kind::file);
    CHECK(bytes == 7);
    CHECK(look("a-folder") == Kind::folder);
    CHECK(look("") == Kind::folder);
}

TEST_CASE_FIXTURE(Card, "symlinks are not there, wherever they lead and wherever they stand in a path") {
    std::ofstream(outside.file("secret")) << "secret";
    fs::create_directory(outside.file("elsewhere"));
    std::ofstream(outside.file("elsewhere/secret")) << "secret";
    file("real.gcode");
    folder("sub");
    fs::create_symlink(outside.file("secret"), root + "/file");
    fs::create_symlink(outside.file("elsewhere"), root + "/folder");
    fs::create_symlink("real.gcode", root + "/inside");
    fs::create_symlink("..", root + "/sub/up");
    CHECK(list() == Names{"real.gcode:1", "sub/"});
    CHECK(list("sub").empty());
    for (const char* path : {"file", "folder", "folder/secret", "inside", "sub/up", "sub/up/real.gcode"}) {
        CAPTURE(std::string(path));
        CHECK(look(path) == Kind::missing);
        CHECK(list(path) == Names{"(none)"});
    }
}

TEST_CASE_FIXTURE(Card, "paths that mean to leave the folder lead nowhere") {
    std::ofstream(outside.file("secret")) << "secret";
    folder("sub");
    for (const char* path : {"..", "../secret", "sub/../../secret", "/etc/passwd", "//etc", ".", "sub/.",
                             "sub//x", "./sub", "sub/..", "\n", "a\tb"}) {
        CAPTURE(std::string(path));
        CHECK(look(path) == Kind::missing);
        CHECK(list(path) == Names{"(none)"});
    }
    CHECK(look(std::string_view("sub\0x", 5)) == Kind::missing);
    CHECK(look(std::string(10'000, 'x')) == Kind::missing);
    CHECK(look(std::string(5'000, '/')) == Kind::missing);
}

TEST_CASE_FIXTURE(Card, "pipes, sockets and devices are not there, and asking does not hang") {
    REQUIRE(::mkfifo((root + "/pipe").c_str(), 0600) == 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    REQUIRE((root + "/socket").copy(address.sun_path, sizeof address.sun_path - 1) == root.size() + 7);
    const link::UniqueFd socket(::socket(AF_UNIX, SOCK_STREAM, 0));
    REQUIRE(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    if (::mknod((root + "/device").c_str(), S_IFCHR | 0600, (1 << 8) | 3) != 0) {
        MESSAGE("not allowed to make a device; tried without");
    }
    file("a.gcode");
    CHECK(list() == Names{"a.gcode:1"});
    CHECK(look("pipe") == Kind::missing);
    CHECK(list("pipe") == Names{"(none)"});
    CHECK(look("socket") == Kind::missing);
    CHECK(look("device") == Kind::missing);
}

TEST_CASE_FIXTURE(Card, "names are bytes; those that would break the line are left out") {
    file("caf\xC3\xA9.gcode");  // UTF-8
    file("caf\xE9.gcode");      // Latin-1
    file("with blank.gcode");
    file("star*12.gcode");
    file("line\nend.gcode");
    file("line\rend.gcode");
    file("bell\a.gcode");
    file("delete\x7F.gcode");
    CHECK(list() == Names{"caf\xC3\xA9.gcode:1", "caf\xE9.gcode:1", "star*12.gcode:1", "with blank.gcode:1"});
    CHECK(look("caf\xE9.gcode") == Kind::file);
    CHECK(look("line\nend.gcode") == Kind::missing);
}

TEST_CASE_FIXTURE(Card, "of a huge folder the first entries by name are shown") {
    for (int i = 0; i < 5000; ++i)
        file("f" + std::to_string(10'000 + i), "");
    folder("a-folder");
    const Names names = list();
    REQUIRE(names.size() == FolderCard::max_entries);
    CHECK(names.front() == "f10000:0");
    CHECK(names.back() == "a-folder/");
    CHECK(look("f14999") == Kind::file);  // there all the same
}

TEST_CASE_FIXTURE(Card, "a folder that vanishes is an empty card, and may come back") {
    file("a.gcode");
    const FolderCard card(root);
    std::vector<machine::CardEntry> entries;
    fs::remove_all(root);
    CHECK_FALSE(card.list("", entries));
    CHECK(entries.empty());
    std::uint64_t bytes = 0;
    CHECK(card.look("a.gcode", bytes) == Kind::missing);
    fs::create_directory(root);
    file("b.gcode");
    CHECK(card.list("", entries));
    CHECK(entries.size() == 1);
}

TEST_CASE_FIXTURE(Card, "a file is read from anywhere, as much as there is room for or left") {
    folder("sub");
    file("a.gcode", std::string("G28\0G1\n", 7));
    file("sub/b.gcode", "inner");
    file("empty.gcode", "");
    CHECK(read("a.gcode") == std::string("G28\0G1\n", 7));
    CHECK(read("a.gcode", 4, 2) == "G1");
    CHECK(read("a.gcode", 6) == "\n");
    CHECK(read("a.gcode", 2, 0).empty());
    CHECK(read("sub/b.gcode", 1) == "nner");
    CHECK(read("empty.gcode").empty());
}

TEST_CASE_FIXTURE(Card, "beyond the end of a file there is nothing, however far") {
    file("a.gcode", "12345");
    constexpr auto farthest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    for (const std::uint64_t offset : {5ULL, 6ULL, 1ULL << 32U, 1ULL << 40U}) {
        CAPTURE(offset);
        CHECK(read("a.gcode", offset).empty());
    }
    // What no file can hold is either the end or a refusal, never bytes.
    for (const std::uint64_t offset : {farthest - 1, farthest, farthest + 1, ~std::uint64_t{0}}) {
        CAPTURE(offset);
        const std::string bytes = read("a.gcode", offset);
        CHECK((bytes.empty() || bytes == "(none)"));
    }
    CHECK(read("a.gcode", farthest + 1) == "(none)");
    CHECK(read("a.gcode", 3) == "45");  // and all is well after that
}

TEST_CASE_FIXTURE(Card, "a file that vanishes, shrinks or grows while it is read") {
    file("a.gcode", "12345");
    CHECK(read("a.gcode", 0, 2) == "12");
    file("a.gcode", "123");
    CHECK(read("a.gcode", 2) == "3");
    CHECK(read("a.gcode", 4).empty());
    file("a.gcode", "12345678");
    CHECK(read("a.gcode", 4) == "5678");
    fs::remove(root + "/a.gcode");
    CHECK(read("a.gcode", 4) == "(none)");
    file("a.gcode", "back");
    CHECK(read("a.gcode") == "back");
    fs::remove_all(root);
    CHECK(read("a.gcode") == "(none)");
}

TEST_CASE_FIXTURE(Card, "what takes a file's place and is no file is not read, and does not hang") {
    std::ofstream(outside.file("secret")) << "secret";
    fs::create_directory(outside.file("elsewhere"));
    std::ofstream(outside.file("elsewhere/a.gcode")) << "secret";
    folder("sub");
    file("a.gcode", "mine");
    file("sub/a.gcode", "mine");
    CHECK(read("a.gcode") == "mine");
    CHECK(read("sub/a.gcode") == "mine");

    fs::remove(root + "/a.gcode");
    fs::create_symlink(outside.file("secret"), root + "/a.gcode");
    CHECK(read("a.gcode") == "(none)");
    fs::remove(root + "/a.gcode");
    REQUIRE(::mkfifo((root + "/a.gcode").c_str(), 0600) == 0);
    CHECK(read("a.gcode") == "(none)");
    fs::remove(root + "/a.gcode");
    folder("a.gcode");
    CHECK(read("a.gcode") == "(none)");
    fs::remove_all(root + "/sub");
    fs::create_symlink(outside.file("elsewhere"), root + "/sub");
    CHECK(read("sub/a.gcode") == "(none)");
}

TEST_CASE_FIXTURE(Card, "paths that lead nowhere are not read") {
    std::ofstream(outside.file("secret")) << "secret";
    folder("sub");
    for (const char* path : {"", "..", "../secret", "sub", "sub/../../secret", "/etc/passwd", "a\tb"}) {
        CAPTURE(std::string(path));
        CHECK(read(path) == "(none)");
    }
}

TEST_CASE_FIXTURE(Card, "a file that may not be read is seen but unreadable") {
    file("locked.gcode");
    fs::permissions(root + "/locked.gcode", fs::perms::none);
    if (::access((root + "/locked.gcode").c_str(), R_OK) == 0) {
        MESSAGE("this user may read everything; skipped");
        return;
    }
    CHECK(look("locked.gcode") == Kind::unreadable);
    CHECK(read("locked.gcode") == "(none)");
    CHECK(list() == Names{"locked.gcode:1"});
}

TEST_CASE_FIXTURE(Card, "what is no folder is refused at the start") {
    file("a.gcode");
    REQUIRE(::mkfifo((root + "/pipe").c_str(), 0600) == 0);
    for (const char* bad : {"/missing", "/a.gcode", "/pipe"}) {
        CAPTURE(std::string(bad));
        CHECK_THROWS_AS(FolderCard(root + bad), link::HostError);
    }
    CHECK_THROWS_AS(FolderCard(""), link::HostError);
}

std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST_CASE_FIXTURE(Card, "writing: made, added to, renamed over another, removed") {
    folder("sub");
    file("old.ctb", "old");
    FolderCard card(root);
    CHECK(card.create("sub/new.temp"));
    CHECK(card.append("sub/new.temp", 0, "abc"));
    CHECK_FALSE(card.append("sub/new.temp", 0, "abc"));  // only at the end
    CHECK_FALSE(card.append("sub/new.temp", 4, "abc"));
    CHECK(card.append("sub/new.temp", 3, std::string_view("d\0e", 3)));
    CHECK(text_of(root + "/sub/new.temp") == std::string("abcd\0e", 6));
    CHECK(card.rename("sub/new.temp", "old.ctb"));
    CHECK(text_of(root + "/old.ctb") == std::string("abcd\0e", 6));
    CHECK(list("sub").empty());
    CHECK(card.create("old.ctb"));  // emptied
    CHECK(list() == Names{"old.ctb:0", "sub/"});
    CHECK(card.remove("old.ctb"));
    CHECK_FALSE(card.remove("old.ctb"));
    CHECK(list() == Names{"sub/"});
}

TEST_CASE_FIXTURE(Card, "writing: names that mean to leave the folder, or are none, write nothing") {
    folder("sub");
    file("a.ctb", "a");
    std::ofstream(outside.file("secret")) << "secret";
    FolderCard card(root);
    for (const std::string& name :
         {std::string(""), std::string("."), std::string(".."), std::string("../made"),
          std::string("../secret"), std::string("sub/../../made"), std::string("/made"),
          std::string("//made"), std::string("sub/"), std::string("sub//made"), std::string("./made"),
          std::string("missing/made"), std::string("a.ctb/made"), std::string("new\nline"),
          std::string("nul\0x", 5), std::string("\x7F"), std::string(300, 'x'), std::string(5'000, '/')}) {
        CAPTURE(name);
        CHECK_FALSE(card.create(name));
        CHECK_FALSE(card.append(name, 0, "x"));
        CHECK_FALSE(card.rename("a.ctb", name));
        CHECK_FALSE(card.rename(name, "b.ctb"));
        CHECK_FALSE(card.remove(name));
    }
    CHECK(list() == Names{"a.ctb:1", "sub/"});
    CHECK(text_of(outside.file("secret")) == "secret");
    CHECK_FALSE(fs::exists(outside.file("made")));
}

TEST_CASE_FIXTURE(Card,
                  "writing: symlinks, folders, pipes and hard links out of the folder stay as they are") {
    std::ofstream(outside.file("secret")) << "secret";
    fs::create_directory(outside.file("elsewhere"));
    fs::create_symlink(outside.file("secret"), root + "/link");
    fs::create_symlink(outside.file("dangling"), root + "/dangling");
    fs::create_symlink(outside.file("elsewhere"), root + "/folder");
    fs::create_hard_link(outside.file("secret"), root + "/hard");
    REQUIRE(::mkfifo((root + "/pipe").c_str(), 0600) == 0);
    folder("sub");
    file("a.ctb", "a");
    FolderCard card(root);
    for (const char* name : {"link", "dangling", "folder", "folder/made", "pipe", "sub"}) {
        CAPTURE(std::string(name));
        CHECK_FALSE(card.create(name));
        CHECK_FALSE(card.append(name, 0, "x"));
        CHECK_FALSE(card.append(name, 6, "x"));
        CHECK_FALSE(card.rename("a.ctb", name));
        CHECK_FALSE(card.rename(name, "b.ctb"));
        CHECK_FALSE(card.remove(name));
    }
    CHECK(fs::is_symlink(root + "/link"));
    CHECK_FALSE(fs::exists(outside.file("dangling")));
    CHECK(fs::is_empty(outside.file("elsewhere")));
    CHECK(card.create("hard"));
    CHECK(card.append("hard", 0, "over"));
    CHECK(text_of(outside.file("secret")) == "secret");
}

TEST_CASE_FIXTURE(Card, "writing: a card that vanished takes nothing") {
    FolderCard card(root);
    REQUIRE(card.create("a"));
    fs::remove_all(root);
    CHECK_FALSE(card.append("a", 0, "x"));
    CHECK_FALSE(card.rename("a", "b"));
    CHECK_FALSE(card.create("a"));
    CHECK_FALSE(card.remove("a"));
    CHECK_FALSE(fs::exists(root));
}

}  // namespace
}  // namespace fauxboard::host
