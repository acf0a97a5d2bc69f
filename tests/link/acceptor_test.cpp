#include "emulator/link/acceptor.h"

#include <sys/socket.h>
#include <sys/un.h>

#include "emulator/link/local_path.h"
#include "tests/link/helpers.h"

namespace fauxboard::link::test {
namespace {

TEST_CASE("acceptor: when none can be taken it says so once for each try, and takes the client later") {
    const TemporaryFolder folder;
    EventLoop loop;
    // Nobody can be taken from a socket that does not listen yet. (Running out of descriptors, the common
    // reason, would take the sanitizers' own away.)
    UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    REQUIRE(fd);
    const int listening = fd.get();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = folder.file("socket");
    REQUIRE(name.size() < sizeof address.sun_path);
    name.copy(static_cast<char*>(address.sun_path), name.size());
    REQUIRE(::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    std::vector<UniqueFd> clients;
    std::vector<std::string> troubles;
    Acceptor acceptor(
        loop, [&](UniqueFd client) { clients.push_back(std::move(client)); },
        [&](std::string_view why) { troubles.emplace_back(why); });
    acceptor.start(std::move(fd));
    for (int i = 0; i < 5; ++i)
        run_ready(loop);
    CHECK(clients.empty());
    CHECK(troubles == std::vector<std::string>{"Invalid argument"});
    REQUIRE(::listen(listening, 1) == 0);
    const UniqueFd client = connect_local(name);
    CHECK(run_until(loop, [&] { return clients.size() == 1; }));
    CHECK(troubles.size() == 1);
    acceptor.stop();
    loop.run();  // nothing is left to wait for
}

TEST_CASE("acceptor: may be stopped from inside its call") {
    const TemporaryFolder folder;
    EventLoop loop;
    LocalPath path;
    UniqueFd listening = path.listen(folder.file("socket"));
    std::unique_ptr<Acceptor> acceptor;
    int taken = 0;
    acceptor = std::make_unique<Acceptor>(
        loop,
        [&](UniqueFd) {
            ++taken;
            acceptor->stop();
        },
        [](std::string_view why) { FAIL_CHECK(why); });
    acceptor->start(std::move(listening));
    const UniqueFd one = connect_local(folder.file("socket"));
    const UniqueFd two = connect_local(folder.file("socket"));
    loop.run();
    CHECK(taken == 1);
}

}  // namespace
}  // namespace fauxboard::link::test
