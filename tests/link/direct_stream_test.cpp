// A wire whose other end answers while the caller waits.

#include "emulator/link/direct_stream.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "emulator/link/host_port.h"
#include "emulator/link/inet_socket.h"
#include "emulator/link/link.h"
#include "tests/link/helpers.h"

namespace fauxboard::link {
namespace {

using test::TemporaryFolder;

/// Only there so that a broken test ends.
constexpr std::chrono::milliseconds patience{20'000};
constexpr std::chrono::milliseconds at_once{0};

UniqueFd other_end(const DirectStream& stream) {
    if (stream.kind() == "pty") {
        return UniqueFd(::open(stream.path().c_str(), O_RDWR | O_NOCTTY));
    }
    UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const SocketAddress address = resolve(stream.path(), SOCK_STREAM).front();
    REQUIRE(::connect(fd.get(), address.get(), address.size()) == 0);
    return fd;
}

std::string read_exactly(int fd, std::size_t size) {
    std::string out(size, '\0');
    std::size_t done = 0;
    while (done < size) {
        const ssize_t count = ::read(fd, out.data() + done, size - done);
        REQUIRE(count > 0);
        done += static_cast<std::size_t>(count);
    }
    return out;
}

std::string heard(DirectStream& stream, std::chrono::milliseconds limit = patience) {
    std::array<char, 64> room{};
    return {room.data(), stream.read(room, limit)};
}

std::vector<std::unique_ptr<DirectStream>> both_kinds() {
    std::vector<std::unique_ptr<DirectStream>> out;
    out.push_back(make_direct_pty(""));
    out.push_back(make_direct_tcp(":0"));
    return out;
}

TEST_CASE("direct stream: there and back, bytes as they are") {
    for (const auto& stream : both_kinds()) {
        CAPTURE(stream->kind());
        CHECK_FALSE(stream->up());
        CHECK_FALSE(stream->write("nobody hears this", at_once));
        CHECK(heard(*stream, at_once).empty());
        const UniqueFd peer = other_end(*stream);
        CHECK(stream->up());
        const std::string bytes("\x04\r\n\0\xFF\x11\x13", 7);
        CHECK(stream->write(bytes, patience));
        CHECK(read_exactly(peer.get(), bytes.size()) == bytes);
        REQUIRE(::write(peer.get(), bytes.data(), bytes.size()) == 7);
        CHECK(heard(*stream) == bytes);
        CHECK(heard(*stream, at_once).empty());
    }
}

TEST_CASE("direct stream: one leaves, and the next is heard") {
    for (const auto& stream : both_kinds()) {
        CAPTURE(stream->kind());
        {
            const UniqueFd first = other_end(*stream);
            CHECK(stream->up());
        }
        CHECK(heard(*stream).empty());  // which finds the end
        CHECK_FALSE(stream->up());
        const UniqueFd second = other_end(*stream);
        CHECK(stream->write("second", patience));
        CHECK(read_exactly(second.get(), 6) == "second");
    }
}

TEST_CASE("direct stream: who does not read holds nobody up, and gets whole messages afterwards") {
    for (const auto& stream : both_kinds()) {
        CAPTURE(stream->kind());
        const UniqueFd peer = other_end(*stream);
        const std::string message(1000, 'x');
        std::size_t taken = 0;
        while (stream->write(message, at_once))
            ++taken;
        CHECK_FALSE(stream->write(message, at_once));  // stalled
        CHECK(taken > 0);
        // The message that was under way goes on; those that were lost are lost whole.
        std::size_t read = 0;
        REQUIRE(::fcntl(peer.get(), F_SETFL, O_NONBLOCK) == 0);
        std::string all;
        std::array<char, 4096> room{};
        bool sent = false;
        for (int tries = 0; tries < 100'000 && !(sent && all.ends_with("end")); ++tries) {
            const ssize_t count = ::read(peer.get(), room.data(), room.size());
            if (count > 0) all.append(room.data(), static_cast<std::size_t>(count));
            sent = sent || stream->write("end", at_once);
        }
        read = all.size();
        CHECK(all.ends_with("end"));
        CHECK((read - 3) % message.size() == 0);
    }
}

TEST_CASE("direct stream: a name for the pseudo-terminal is gone with it; a port that is taken is told") {
    const TemporaryFolder folder;
    const std::string name = folder.file("wires");
    {
        const auto stream = make_direct_pty(name);
        CHECK(::access(name.c_str(), F_OK) == 0);
    }
    CHECK(::access(name.c_str(), F_OK) != 0);
    const auto stream = make_direct_tcp(":0");
    CHECK(stream->path().starts_with("127.0.0.1:"));
    CHECK_THROWS_AS(make_direct_tcp(stream->path()), LinkError);
}

}  // namespace
}  // namespace fauxboard::link
