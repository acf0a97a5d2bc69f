// The real program on a real UDP port.

#include <fstream>
#include <random>

#include "tests/e2e/program.h"
#include "tests/link/udp_helpers.h"
#include "tests/support/transfer_client.h"

namespace fauxboard::e2e {
namespace {

using link::test::UdpClient;
using testing::TransferClient;

/// The bytes of a file that is nowhere: a number of each eight bytes, mixed.
std::string content(std::uint64_t offset, std::size_t size) {
    std::string bytes;
    bytes.reserve(size + 16);
    for (std::uint64_t word = offset / 8; bytes.size() < size + offset % 8; ++word) {
        std::uint64_t x = word * 0x9E3779B97F4A7C15U;
        x ^= x >> 29U;
        for (int i = 0; i < 8; ++i) {
            bytes += static_cast<char>(x >> (8 * i) & 0xFF);
        }
    }
    return bytes.substr(offset % 8, size);
}

struct Board {
    TemporaryFolder folder;
    std::string card = folder.file("card");
    std::unique_ptr<Program> program;
    std::string udp;
    Board() {
        std::filesystem::create_directory(card);
        program = std::make_unique<Program>(
            Args{"run", "--profile", "elegoo-mars-pro", "--udp", ":0", "--sd", card, "-q"});
        udp = program->ready()["udp"];
    }
};

TEST_CASE(
    "run --udp: fifty megabytes go up and come down, with one datagram of fifty lost, damaged or repeated") {
    Board board;
    const UdpClient socket(board.udp);
    TransferClient client(
        {[&](std::string_view bytes) { socket.send(bytes); }, [&] { return socket.receive(patience_ms); }},
        {0.02, 3});
    constexpr std::uint64_t size = 50'000'000;
    CHECK(client.upload("big.ctb", size, content) == "");
    CHECK(client.lost > 200);
    CHECK(client.damaged > 100);
    CHECK(client.repeated > 100);
    CHECK(std::filesystem::file_size(board.card + "/big.ctb") == size);
    std::uint64_t at = 0;
    bool same = true;
    CHECK(client.download("big.ctb", size, [&](std::string_view bytes) {
        same = same && bytes == content(at, bytes.size());
        at += bytes.size();
    }) == "");
    CHECK(same);
    CHECK(at == size);
    CHECK(client.ask("M30 big.ctb").starts_with("File deleted"));
    CHECK(std::filesystem::is_empty(board.card));
    CHECK(board.program->stop() == 0);
}

TEST_CASE("run --udp: names never leave the folder, and the answers say so") {
    Board board;
    std::ofstream(board.folder.file("secret")) << "secret";
    const UdpClient socket(board.udp);
    for (const char* request :
         {"M28 ../made", "M28 /../made", "M28 a/../../made", "M28 sub/made", "M28 /", "M28"}) {
        CAPTURE(std::string(request));
        socket.send(request);
        CHECK(socket.receive(patience_ms) == "Error:write data\r\n");
        CHECK(socket.receive(patience_ms) == "ok N:0\r\n");
    }
    socket.send("M6032 '../secret'");
    CHECK(socket.receive(patience_ms).starts_with("Error:File is not existed"));
    CHECK(socket.receive(patience_ms) == "ok N:0\r\n");
    socket.send("M30 ../secret");
    CHECK(socket.receive(patience_ms).starts_with("Delete failed"));
    CHECK(std::filesystem::exists(board.folder.file("secret")));
    CHECK_FALSE(std::filesystem::exists(board.folder.file("made")));
    CHECK(std::filesystem::is_empty(board.card));
}

TEST_CASE("run --udp: the program's log says once who sends") {
    const TemporaryFolder folder;
    const std::string file = folder.file("own.log");
    Program board({"run", "--profile", "elegoo-mars-pro", "--udp", ":0", "-q", "--log-file", file,
                   "--log-level", "debug"});
    const UdpClient socket(board.ready()["udp"]);
    for (int i = 0; i < 2; ++i) {
        socket.send("M4002");
        CHECK(socket.receive(patience_ms).starts_with("ok V"));
    }
    CHECK(board.stop() == 0);
    std::ifstream in(file);
    const std::string log{std::istreambuf_iterator<char>(in), {}};
    const std::size_t first = log.find(" sends to the network module at 127.0.0.1:");
    REQUIRE(first != std::string::npos);
    CHECK(log.find(" sends to the network module", first + 1) == std::string::npos);
}

TEST_CASE("run --udp: a port that cannot be had") {
    const Board board;
    check_mistakes({{{"run", "--udp", board.udp}, no_port, "cannot be listened on"},
                    {{"run", "--udp", "nonsense"}, usage, "is not an address"}});
}

}  // namespace
}  // namespace fauxboard::e2e
