// Every request of the button tables, and the rest of the requests: what comes back, when, and what it did.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "protocol/framing.h"
#include "tests/support/board_driver.h"
#include "tests/support/vectors.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

constexpr double window_s = 0.6;  // shorter than the stretch in which the schedule is silent
constexpr double tick_s = 0.05;

enum class How { bodies, frames, bare };

std::string wire_bytes(const Vector& vector, How how) {
    std::string bytes;
    for (std::size_t i = 0; i < vector.send.size(); ++i) {
        bytes += how == How::bare     ? vector.send[i] + "\r\n"
                 : how == How::frames ? vector.frame.at(i) + "\r\n"
                                      : protocol::frame(vector.send[i]);
    }
    return bytes;
}

void check_replies(const BoardDriver& driver, const Vector& vector, double pressed) {
    const auto lines = driver.between(pressed, pressed + window_s);
    std::vector<std::string> bodies;
    for (const auto& line : lines) {
        bodies.push_back(line.body);
    }
    CHECK(join(bodies) == join(vector.replies));
    // A request is executed at the next tick, its first frame leaves at the one after; a bare line leaves at
    // once. What the USB host sends is executed at once.
    const double last_request = tick_s * static_cast<double>(vector.send.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto& line = lines[i];
        const bool bare = line.body.starts_with("raw:") || vector.direct.contains(i);
        CAPTURE(line.body);
        const bool any_moment = bare || !vector.host.empty() || vector.takes_s > 0;
        CHECK(line.at - pressed >= vector.takes_s + (any_moment ? 0.0 : 0.0499));
        CHECK(line.at - pressed <= vector.takes_s + 0.055 + last_request +
                                       tick_s * static_cast<double>(vector.replies.size() - 1));
    }
    if (vector.takes_s == 0 && vector.replies.size() == 1 && vector.send.size() == 1 && lines.size() == 1 &&
        !lines[0].body.starts_with("raw:") && vector.direct.empty()) {
        CHECK(lines[0].at - pressed <= 0.105);
    }
}

void check_state(const BoardDriver& driver, const Vector& vector) {
    for (const auto& [path, value] : vector.state) {
        const auto& shown_path = path;
        CAPTURE(shown_path);
        CHECK(driver.number(path) == doctest::Approx(value).epsilon(1e-9));
    }
    for (const auto& [path, value] : vector.texts) {
        const auto& shown_path = path;
        CAPTURE(shown_path);
        CHECK(driver.text(path) == value);
    }
}

void run_vector(const VectorFile& file, const Vector& vector, How how, double phase_s) {
    BoardDriver driver(file.profile);
    driver.run_until(1.0);
    driver.meet_screen();
    for (const Vector::Preparation& step : vector.prepare) {
        driver.press(step.send);
        driver.run_for(step.wait_s);
    }
    if (!vector.world.empty()) {
        driver.world(vector.world);
    }
    driver.run_for(1.5);
    driver.run_to_quiet();
    driver.run_for(phase_s);
    const double pressed = driver.now();
    driver.feed(wire_bytes(vector, how));
    for (const std::string& line : vector.host) {
        driver.host(line);
    }
    driver.run_until(pressed + window_s);
    check_replies(driver, vector, pressed);
    driver.run_until(pressed + vector.after_s);
    check_state(driver, vector);
    CHECK(driver.board().counters().bad_frames == 0);
    CHECK(driver.board().counters().unknown_codes == 0);
    CHECK(driver.board().counters().unmatched == 0);
}

void run_file(const char* name, How how, std::initializer_list<double> phases) {
    const VectorFile file = load_vectors(name);
    REQUIRE(!file.vectors.empty());
    for (const Vector& vector : file.vectors) {
        for (const double phase_s : phases) {
            CAPTURE(vector.button);
            CAPTURE(phase_s);
            run_vector(file, vector, how, phase_s);
        }
    }
}

}  // namespace

TEST_CASE("every request of the A30T's buttons gets its reply in time and does what it says") {
    run_file("geeetech-a30t", How::bodies, {0.0, 0.017, 0.034, 0.049});
}

TEST_CASE("the A30T's buttons as the frames that a real screen sent") {
    run_file("geeetech-a30t", How::frames, {0.025});
}

TEST_CASE("the vectors hold the 119 distinct frames of the button tables, each with its right checksum") {
    std::set<std::string> distinct;
    for (const Vector& vector : load_vectors("geeetech-a30t").vectors) {
        CAPTURE(vector.button);
        REQUIRE(vector.frame.size() == vector.send.size());
        for (std::size_t i = 0; i < vector.frame.size(); ++i) {
            const protocol::Unframed frame =
                protocol::unframe(vector.frame[i], protocol::ChecksumPolicy::required);
            CHECK(frame.fault == protocol::FrameFault::none);
            CHECK(std::string(frame.body) == vector.send[i]);
            distinct.insert(vector.frame[i]);
        }
    }
    CHECK(distinct.size() == 119);
}

TEST_CASE("every other request, and the USB side, gets its reply and does what it says") {
    run_file("more", How::bodies, {0.0, 0.03});
}

TEST_CASE("an A30 board takes its screen's bare lines, and says no more than that screen can read") {
    run_file("geeetech-a30", How::bare, {0.0, 0.03});
}

TEST_CASE("an A30 board takes framed lines as well") {
    run_file("geeetech-a30", How::bodies, {0.01});
}
