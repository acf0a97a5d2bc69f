// The panel and fleets of the real program: what they tell, what they refuse, and that each board is there.

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <fstream>
#include <set>

#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

/// The answer of the panel at that address to one request for `what`.
std::string fetch(const std::string& address, const std::string& what) {
    const std::size_t colon = address.rfind(':');
    const std::size_t slash = address.find('/', colon);
    const std::string port = address.substr(colon + 1, slash - colon - 1);
    const UniqueFd fd(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(connect(fd.get(), reinterpret_cast<sockaddr*>(&to), sizeof to) == 0);
    const std::string request = "GET " + address.substr(slash) + what +
                                " HTTP/1.1\r\nHost: 127.0.0.1:" + port + "\r\nConnection: close\r\n\r\n";
    REQUIRE(send(fd.get(), request.data(), request.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(request.size()));
    std::string answer;
    std::array<char, 4096> some{};
    for (ssize_t got = 0; (got = read(fd.get(), some.data(), some.size())) > 0;) {
        answer.append(some.data(), static_cast<std::size_t>(got));
    }
    return answer;
}

TEST_CASE("run --web tells an address of this computer, with a secret, and serves the page there") {
    Program board({"run", "--web"});
    const auto ready = board.ready();
    const std::string address = ready.at("web");
    CHECK(address.starts_with("http://127.0.0.1:"));
    CHECK(address.size() > 45);
    CHECK(contains(fetch(address, ""), "no real printer here"));
    CHECK(contains(fetch(address, "boards"), "geeetech-a30t"));
    CHECK(
        fetch(address.substr(0, address.rfind('/', address.size() - 2) + 1), "").starts_with("HTTP/1.1 404"));
    CHECK(contains(board.errors(), address));
    Peer peer(ready.at("path"));
    CHECK(contains(peer.ask("M105", "L2 B:"), "L2 B:"));
    CHECK(board.stop() == 0);
}

TEST_CASE("the address is new each time, unless it is the user's") {
    Program first({"run", "--web"});
    Program second({"run", "--web", "127.0.0.1:0/my-desk-screen"});
    const std::string one = first.ready().at("web");
    const std::string two = second.ready().at("web");
    CHECK(one != two);
    CHECK(two.ends_with("/my-desk-screen/"));
}

TEST_CASE("a fleet: every board is there on a line of its own, and all go at once") {
    TemporaryFolder folder;
    const std::string file = folder.file("fleet.json");
    std::ofstream(file) << R"({"boards": [{"profile": "geeetech-a30t", "count": 5, "pty": ")"
                        << folder.file("left-{n}")
                        << R"("}, {"profile": "elegoo-mars-pro", "tcp": "127.0.0.1:0"}]})";
    Program fleet({"fleet", file, "--web"});
    const auto ready = fleet.ready();
    REQUIRE(ready.at("boards").size() == 6);
    std::set<std::string> paths;
    for (std::size_t i = 0; i < 5; ++i) {
        const auto& board = ready["boards"][i];
        CHECK(board.at("name") == "geeetech-a30t-" + std::to_string(i + 1));
        CHECK(board.at("pty") == folder.file("left-" + std::to_string(i + 1)));
        CHECK(paths.insert(board.at("path")).second);
        Peer peer(folder.file("left-" + std::to_string(i + 1)));
        CHECK(contains(peer.ask("M105", "L2 B:"), "L2 B:"));
    }
    CHECK(ready["boards"][5].at("link") == "tcp");
    CHECK(contains(fetch(ready.at("web"), "boards"), "elegoo-mars-pro"));
    CHECK(fleet.stop() == 0);
    CHECK(open(folder.file("left-1").c_str(), O_RDWR | O_NOCTTY) == -1);
}

TEST_CASE("a fleet: a ready line that is longer than its pipe comes whole") {
    TemporaryFolder folder;
    const std::string file = folder.file("fleet.json");
    std::ofstream(file) << R"({"boards": [{"profile": "geeetech-a30t", "count": 200}]})";
    Program fleet({"fleet", file, "--quiet"}, Program::Stdout::narrow_pipe);
    CHECK(fleet.ready().at("boards").size() == 200);
    CHECK(fleet.stop() == 0);
}

TEST_CASE("what cannot be is refused with a sentence") {
    TemporaryFolder folder;
    const std::string file = folder.file("fleet.json");
    std::ofstream(file) << R"({"boards": [{"profile": "geeetech-a30x"}]})";
    const std::vector<Mistake> mistakes{
        {{"run", "--web", "nonsense"}, usage, "nonsense"},
        {{"run", "--web", "127.0.0.1:0/short"}, no_port, "12 to 64"},
        {{"fleet"}, usage, "FILE"},
        {{"fleet", "/missing.json"}, bad_input, "/missing.json"},
        {{"fleet", file}, bad_input, "did you mean \"geeetech-a30"},
        {{"fleet", file, "--speed", "max"}, usage, "expected a number"},
        {{"replay", "--plot", "/missing/x.svg", "/missing.jsonl"}, bad_input, "/missing.jsonl"},
    };
    check_mistakes(mistakes);
}

}  // namespace
}  // namespace fauxboard::e2e
