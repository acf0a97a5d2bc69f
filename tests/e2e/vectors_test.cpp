// Every request of the screens' buttons, sent over a real pseudo-terminal to a fresh board: the same vectors
// that the board passes in virtual time.

#include <algorithm>
#include <cmath>

#include "tests/e2e/program.h"
#include "tests/support/board_driver.h"
#include "tests/support/vectors.h"

namespace fauxboard::e2e {
namespace {

using testing::said;
using testing::Vector;
using testing::VectorFile;

/// An L3 comes at least so often, in seconds of the board; counting them is how a test waits for the board's
/// clock.
constexpr double status_period_s = 4.2;

std::string dressed(const VectorFile& file, const std::string& body) {
    return file.bare ? body + "\r\n" : frame(body);
}

void let_pass(Peer& peer, double seconds) {
    for (int i = 0; i <= static_cast<int>(std::ceil(seconds / status_period_s)); ++i) {
        REQUIRE(contains(peer.lines().find("L3 PS:"), "L3 PS:"));
    }
}

/// The schedule may say these at any time.
bool periodic(const std::string& body) {
    return body.starts_with("L1 ") || body.starts_with("L2 ") || body.starts_with("L3 ") ||
           body.starts_with("L22 ");
}

/// As said(), of a board without frames too.
std::string body_of(const VectorFile& file, const std::string& line) {
    const bool code = line.size() > 1 && line[0] == 'L' && line[1] >= '0' && line[1] <= '9';
    return file.bare && code ? line : said(line);
}

/// All that comes up to the answer of a last question, which few buttons ask.
std::vector<std::string> talk(Peer& peer, const VectorFile& file, const Vector& vector) {
    const std::string last = file.bare ? "L11 P0 " : "L24 P3 ";
    auto marks = 1 + std::count_if(vector.replies.begin(), vector.replies.end(),
                                   [&](const std::string& reply) { return reply.starts_with(last); });
    std::string bytes;
    for (const std::string& line : vector.frame) {
        bytes += line + "\r\n";
    }
    for (const std::string& body : vector.send) {
        bytes += vector.frame.empty() ? dressed(file, body) : std::string{};
    }
    peer.say(bytes + dressed(file, file.bare ? "M2120 P5" : "M2140 S3"));
    std::vector<std::string> bodies;
    while (true) {
        const std::string line = peer.lines().next();
        REQUIRE(line != "(silence)");
        REQUIRE(line != "(end)");
        bodies.push_back(body_of(file, line));
        if (bodies.back().starts_with(last) && --marks == 0) {
            bodies.pop_back();
            return bodies;
        }
    }
}

void check_vector(const VectorFile& file, const Vector& vector) {
    CAPTURE(vector.button);
    // Fast, so that what must be prepared does not take the time it takes; without pacing, so that replies
    // come in their order and at once.
    Program program({"run", "-q", "--no-pacing", "--speed", "50", "--profile", file.profile});
    Peer peer(program.ready()["path"]);
    REQUIRE(contains(peer.lines().find("L21"), "L21"));  // the boot is over
    peer.say(dressed(file, "M2134 FW:V1.02.xx"));
    let_pass(peer, 1);
    for (const Vector::Preparation& step : vector.prepare) {
        peer.say(dressed(file, step.send));
        let_pass(peer, step.wait_s);
    }
    const std::vector<std::string> came = talk(peer, file, vector);
    CAPTURE(testing::join(came));
    auto next = vector.replies.begin();
    for (const std::string& body : came) {
        if (next != vector.replies.end() && body == *next) {
            ++next;
        } else {
            CHECK_MESSAGE(periodic(body), body);
        }
    }
    CHECK_MESSAGE(next == vector.replies.end(),
                  (next == vector.replies.end() ? std::string{} : "missing: " + *next));
}

void check_file(std::string_view name) {
    const VectorFile file = testing::load_vectors(name);
    int sent = 0;
    for (const Vector& vector : file.vectors) {
        // What happens to the machine or on its USB side, and what a tick decides, has no place on this line.
        if (vector.world.empty() && vector.host.empty() && !vector.paced) {
            check_vector(file, vector);
            ++sent;
        }
    }
    CHECK(sent > 10);
    MESSAGE(name << ": " << sent << " of " << file.vectors.size() << " vectors sent over a pseudo-terminal");
}

TEST_CASE("every button of the A30T is answered over a pseudo-terminal") {
    check_file("geeetech-a30t");
}
TEST_CASE("so are the requests that are on no button") {
    check_file("more");
}
TEST_CASE("so are those of the A30") {
    check_file("geeetech-a30");
}

}  // namespace
}  // namespace fauxboard::e2e
