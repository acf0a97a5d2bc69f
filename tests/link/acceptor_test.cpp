#include "emulator/link/acceptor.h"

#include <sys/resource.h>

#include "emulator/link/local_path.h"
#include "tests/link/helpers.h"

namespace fauxboard::link::test {
namespace {

/// No more descriptors for this process, as long as this lives.
class NoDescriptors {
  public:
    NoDescriptors() {
        REQUIRE(::getrlimit(RLIMIT_NOFILE, &before_) == 0);
        const UniqueFd lowest(::open("/dev/null", O_RDONLY | O_CLOEXEC));
        const rlimit none{static_cast<rlim_t>(lowest.get()), before_.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
    }
    ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
    NoDescriptors(const NoDescriptors&) = delete;
    NoDescriptors& operator=(const NoDescriptors&) = delete;

  private:
    rlimit before_{};
};

TEST_CASE("acceptor: out of descriptors it says so once for each try, and takes the client later") {
    const TemporaryFolder folder;
    EventLoop loop;
    LocalPath path;
    UniqueFd listening = path.listen(folder.file("socket"));
    std::vector<UniqueFd> clients;
    std::vector<std::string> troubles;
    Acceptor acceptor(
        loop, [&](UniqueFd fd) { clients.push_back(std::move(fd)); },
        [&](std::string_view why) { troubles.emplace_back(why); });
    acceptor.start(std::move(listening));
    const UniqueFd client = connect_local(folder.file("socket"));
    {
        const NoDescriptors none;
        for (int i = 0; i < 5; ++i)
            run_ready(loop);
        CHECK(clients.empty());
        CHECK(troubles == std::vector<std::string>{"Too many open files"});
    }
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
