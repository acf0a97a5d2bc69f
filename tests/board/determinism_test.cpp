// Same profile, seed and input at the same times: the same bytes at the same times, however it is called.

#include <doctest/doctest.h>

#include <random>

#include "protocol/framing.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using std::string;

namespace {

/// Something that happens to a board.
struct Happening {
    double at = 0;
    enum class Kind { screen, host, world } kind = Kind::screen;
    string what;
};

const std::vector<string>& requests() {
    static const std::vector<string> all{"M105",
                                         "M27",
                                         "M20 LCD",
                                         "M2140 S0",
                                         "M290 Z0.1",
                                         "G28",
                                         "M104 S210",
                                         "M140 S60",
                                         "M104 S0",
                                         "M165 A1 B2 C3",
                                         "M2138 S1",
                                         "M2105 S2",
                                         "M2105 S4",
                                         "M500",
                                         "M2106 P0 S1",
                                         "G1 X50 Y60 F3000",
                                         "M18",
                                         "M23 testpattern.gcode",
                                         "M24",
                                         "M25",
                                         "M2103",
                                         "M2107 S0",
                                         "M2107 S6",
                                         "M190 S40",
                                         "M108",
                                         "M112",
                                         "M2139",
                                         "M22",
                                         "M21",
                                         "M20 file:SD1:/A30T",
                                         "M2134 FW:V1",
                                         "M2120 P7 S0",
                                         "M2135 P100",
                                         "M92 X81",
                                         "M502",
                                         "M9999",
                                         "M106 P0 S100",
                                         "M220 S50",
                                         "T1",
                                         "M115",
                                         "log something",
                                         "M2101"};
    return all;
}

/// Some minutes of a busy line. Kept simple so that a failing seed can be looked at.
std::vector<Happening> busy_line(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    std::vector<Happening> out;
    double at = 0.2;
    for (int i = 0; i < 250; ++i) {
        at += static_cast<double>(below(3000)) / 1000;
        const std::size_t which = below(20);
        if (which == 0) {
            constexpr std::array world{"filament in", "filament out", "card out",
                                       "card in",     "board reset",  "job finished"};
            out.push_back({at, Happening::Kind::world, world[below(world.size())]});
        } else if (which == 1) {
            constexpr std::array host{"M117 hello", "M104 S100", "G28", "M109 S60", "M290 Z0.3", "G29"};
            out.push_back({at, Happening::Kind::host, host[below(host.size())]});
        } else {
            string bytes = protocol::frame(requests()[below(requests().size())]);
            if (which == 2) {
                bytes[below(bytes.size())] ^= 1;
            }
            out.push_back({at, Happening::Kind::screen, bytes});
        }
    }
    return out;
}

constexpr double end_s = 900;

void happen(BoardDriver& driver, const Happening& what) {
    switch (what.kind) {
        case Happening::Kind::screen:
            driver.feed(what.what);
            break;
        case Happening::Kind::host:
            driver.host(what.what);
            break;
        case Happening::Kind::world:
            driver.world(what.what);
            break;
    }
}

BoardDriver::Setup seeded(std::uint64_t seed) {
    BoardDriver::Setup setup;
    setup.seed = seed;
    return setup;
}

string plain_run(const std::vector<Happening>& line, std::uint64_t seed,
                 const char* profile = "geeetech-a30t") {
    BoardDriver driver(profile, seeded(seed));
    for (const Happening& what : line) {
        driver.run_until(what.at);
        happen(driver, what);
    }
    driver.run_until(end_s);
    return driver.transcript();
}

}  // namespace

TEST_CASE("determinism: two runs with the same seed and input are byte-identical, on every profile") {
    for (const char* profile : {"geeetech-a30t", "geeetech-a30", "geeetech-a30t-no-card", "smartto-delta"}) {
        for (unsigned seed = 1; seed <= 5; ++seed) {
            CAPTURE(profile);
            CAPTURE(seed);
            const auto line = busy_line(seed);
            const string first = plain_run(line, seed, profile);
            CHECK(first.size() > 10000);
            CHECK(first == plain_run(line, seed, profile));
        }
    }
}

TEST_CASE("determinism: another seed gives other noise, so the seed is really used") {
    const std::vector<Happening> line{{3, Happening::Kind::screen, protocol::frame("M104 S200")}};
    CHECK(plain_run(line, 1) != plain_run(line, 2));
}

TEST_CASE("determinism: any split of the input bytes gives the same output") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        const auto line = busy_line(seed);
        const string whole = plain_run(line, seed);
        BoardDriver driver("geeetech-a30t", seeded(seed));
        for (const Happening& what : line) {
            driver.run_until(what.at);
            if (what.kind != Happening::Kind::screen) {
                happen(driver, what);
                continue;
            }
            for (std::size_t at = 0; at < what.what.size();) {
                const std::size_t piece = 1 + random() % 9;
                driver.feed(std::string_view(what.what).substr(at, piece));
                at += piece;
                if (random() % 3 == 0) {
                    driver.feed("");
                }
            }
        }
        driver.run_until(end_s);
        REQUIRE(driver.transcript() == whole);
    }
}

TEST_CASE("determinism: advance in steps of any size gives the same bytes at the same times") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed + 1000);
        const auto line = busy_line(seed);
        const string whole = plain_run(line, seed);
        BoardDriver driver("geeetech-a30t", seeded(seed));
        const auto run_in_steps = [&](double end) {
            while (driver.now() < end) {
                const double step =
                    static_cast<double>(1 + random() % 1000) / (random() % 4 == 0 ? 1000.0 : 200.0);
                driver.run_until(std::min(end, driver.now() + step));
            }
        };
        for (const Happening& what : line) {
            run_in_steps(what.at);
            happen(driver, what);
        }
        run_in_steps(end_s);
        REQUIRE(driver.transcript() == whole);
    }
}

TEST_CASE("determinism: a board called only at the times it asked for says the same") {
    const auto line = busy_line(7);
    const string whole = plain_run(line, 7);
    BoardDriver driver("geeetech-a30t", seeded(7));
    std::size_t calls = 0;
    const auto run_as_asked = [&](double end) {
        const board::SimTime stop = machine::from_seconds(end);
        for (board::SimTime due = driver.board().advance(driver.board().time()); due < stop; ++calls) {
            driver.run_until(machine::to_seconds(due));
            due = driver.board().advance(due);
        }
        driver.run_until(end);
    };
    for (const Happening& what : line) {
        run_as_asked(what.at);
        happen(driver, what);
    }
    run_as_asked(end_s);
    CHECK(driver.transcript() == whole);
    CHECK(calls < 20000);  // events, not ticks
}

TEST_CASE("an idle, cold board asks to be called for its next L3, and not before") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(7.6);
    const board::SimTime due = driver.board().advance(machine::from_seconds(7.7));
    CHECK(machine::to_seconds(due) == doctest::Approx(11.648).epsilon(0.001));
}

TEST_CASE("no pacing: the same answers in the same order, each at once") {
    BoardDriver::Setup at_once;
    at_once.pacing = false;
    BoardDriver paced;
    BoardDriver unpaced("geeetech-a30t", at_once);
    std::vector<string> slow;
    std::vector<string> fast;
    for (const auto& [driver, answers] : {std::pair{&paced, &slow}, std::pair{&unpaced, &fast}}) {
        driver->run_until(1);
        driver->press("M2134 FW:V1");
        driver->run_until(3.4);
        driver->run_to_quiet();
        for (const char* request : {"M105", "M27", "M20 LCD", "M2140 S0", "M2138 S1", "M2107 S6", "M115"}) {
            const double pressed = driver->now();
            driver->press(request);
            driver->run_for(driver == &paced ? 0.105 : 0.0);
            for (const auto& line : driver->between(pressed, pressed + 0.2)) {
                answers->push_back(line.body);
                if (driver == &unpaced) {
                    CHECK(line.at == doctest::Approx(pressed));
                }
            }
            driver->run_for(0.001);
        }
    }
    CHECK(join(fast) == join(slow));
    CHECK(fast.size() == 11);
}
