#include "emulator/host/profile_watch.h"

#include <fstream>

#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;
using link::test::run_until;

struct Watched {
    link::test::TemporaryFolder folder;
    std::string file = folder.file("board.json");
    link::EventLoop loop;
    int changes = 0;
    ProfileWatch watch{loop, [this] { ++changes; }};

    Watched() {
        write(file);
        watch.watch({file});
        REQUIRE(watch.works());
    }
    static void write(const std::string& name) { std::ofstream(name) << "{}"; }
    bool heard() {
        const bool any = run_until(loop, [this] { return changes > 0; });
        const int count = std::exchange(changes, 0);
        return any && count == 1;
    }
};

TEST_CASE_FIXTURE(Watched, "a file written in place, renamed into place, removed and made anew") {
    write(file);
    CHECK(heard());
    write(folder.file("other"));
    fs::rename(folder.file("other"), file);
    CHECK(heard());
    fs::remove(file);
    write(file);
    CHECK(heard());
}

TEST_CASE_FIXTURE(Watched, "a series of changes is one") {
    for (int i = 0; i < 100; ++i)
        write(file);
    CHECK(heard());
}

TEST_CASE_FIXTURE(Watched, "other files of the folder do not matter, and those before neither") {
    const std::string next = folder.file("next.json");
    write(next);
    watch.watch({next});
    write(file);
    write(folder.file("unrelated"));
    write(next);
    CHECK(heard());
    write(file);
    write(next);
    CHECK(heard());
}

TEST_CASE_FIXTURE(Watched, "a file behind a symlink is heard of") {
    const std::string name = folder.file("name.json");
    fs::create_symlink(file, name);
    watch.watch({name});
    write(file);
    CHECK(heard());
}

TEST_CASE("files that are not there are not heard of, and harm nobody") {
    link::EventLoop loop;
    ProfileWatch watch(loop, [] {});
    watch.watch({"/missing/board.json", ""});
    CHECK_FALSE(watch.works());
}

}  // namespace
}  // namespace fauxboard::host
