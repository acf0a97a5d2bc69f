// Whose socket it is, who may open it, and that it goes.

#include "emulator/link/local_path.h"

#include <sys/socket.h>
#include <sys/stat.h>

#include <fstream>
#include <optional>

#include "emulator/link/local_listener.h"
#include "tests/link/helpers.h"

namespace fauxboard::link::test {
namespace {

mode_t mode_of(const std::string& path) {
    struct stat found {};
    REQUIRE(::lstat(path.c_str(), &found) == 0);
    return found.st_mode;
}

bool exists(const std::string& path) {
    return std::filesystem::exists(std::filesystem::symlink_status(path));
}

TEST_CASE("the socket is for its user only, whatever the umask, and goes with its owner") {
    const TemporaryFolder folder;
    const std::string name = folder.file("control");
    for (const mode_t mask : {0U, 022U, 0777U}) {
        const mode_t before = ::umask(mask);
        {
            LocalPath path;
            const UniqueFd fd = path.listen(name);
            CHECK(S_ISSOCK(mode_of(name)));
            CHECK((mode_of(name) & 07777U) == 0600U);
            CHECK(connect_local(name));
        }
        CHECK(::umask(before) == mask);
        CHECK_FALSE(exists(name));
    }
}

TEST_CASE("a socket in use is refused, one that a dead program left is replaced") {
    const TemporaryFolder folder;
    const std::string name = folder.file("control");
    LocalPath first;
    std::optional<UniqueFd> fd(first.listen(name));
    LocalPath second;
    CHECK(contains(link_error([&] { second.listen(name); }), "is in use"));
    CHECK(connect_local(name));
    fd.reset();  // as when the program dies: the name stays
    CHECK(contains(link_error([&] { connect_local(name); }), "Nobody listens"));
    const UniqueFd other = second.listen(name);
    CHECK(connect_local(name));
    second.remove();
    CHECK_FALSE(exists(name));
}

TEST_CASE("a name that somebody else took meanwhile stays") {
    const TemporaryFolder folder;
    const std::string name = folder.file("control");
    LocalPath first;
    const UniqueFd fd = first.listen(name);
    std::filesystem::remove(name);
    LocalPath second;
    const UniqueFd other = second.listen(name);
    first.remove();
    CHECK(connect_local(name));
}

TEST_CASE("a socket whose queue is full is in use") {
    const TemporaryFolder folder;
    const std::string name = folder.file("control");
    LocalPath owner;
    const UniqueFd fd = owner.listen(name);
    REQUIRE(::listen(fd.get(), 0) == 0);
    const UniqueFd waiting = connect_local(name);
    LocalPath second;
    CHECK(contains(link_error([&] { second.listen(name); }), "is in use"));
}

TEST_CASE("what is no socket stays as it is") {
    const TemporaryFolder folder;
    const std::string name = folder.file("precious");
    std::ofstream(name) << "data";
    LocalPath path;
    CHECK(contains(link_error([&] { path.listen(name); }), "is not a socket; choose another path"));
    const std::string dangling = folder.file("link");
    std::filesystem::create_symlink("nowhere", dangling);
    CHECK(contains(link_error([&] { path.listen(dangling); }), "is not a socket"));
    CHECK(contains(link_error([&] { path.listen(folder.file("")); }), "is not a socket"));
    path.remove();
    std::string text;
    std::ifstream(name) >> text;
    CHECK(text == "data");
    CHECK(contains(link_error([&] { connect_local(name); }), name));
}

TEST_CASE("names that cannot be, and folders that are not there") {
    const TemporaryFolder folder;
    LocalPath path;
    CHECK(contains(link_error([&] { path.listen(""); }), "shorter path"));
    CHECK(contains(link_error([&] { path.listen(folder.file(std::string(200, 'x'))); }), "shorter path"));
    CHECK(contains(link_error([&] { path.listen("/missing/control"); }), "cannot be made: No such file"));
    CHECK(contains(link_error([&] { connect_local(folder.file("none")); }), "run --control"));
}

TEST_CASE("a listener takes all who come, until it is closed") {
    const TemporaryFolder folder;
    const std::string name = folder.file("control");
    EventLoop loop;
    std::vector<UniqueFd> clients;
    LocalListener listener(
        loop, [&](UniqueFd socket) { clients.push_back(std::move(socket)); }, [](std::string_view) {});
    listener.open(name);
    std::vector<UniqueFd> fds;
    for (int i = 0; i < 100; ++i)
        fds.push_back(connect_local(name));
    CHECK(run_until(loop, [&] { return clients.size() == 100; }));
    listener.close();
    CHECK_FALSE(exists(name));
    run_ready(loop);
    CHECK_FALSE(link_error([&] { connect_local(name); }).empty());
}

}  // namespace
}  // namespace fauxboard::link::test
