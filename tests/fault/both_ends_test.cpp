// A touch screen and a board with a line between them that misbehaves: every kind of fault in each
// direction is seen to act as that kind does, to be repeatable and to end; then both ends work on.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "emulator/fault/kind.h"
#include "tests/fault/both_ends.h"
#include "tests/fault/helpers.h"

using namespace fauxboard::fault;

namespace {

std::vector<std::string> lines(const Stream& stream) {
    std::vector<std::string> out;
    std::istringstream in(stream.bytes);
    for (std::string line; std::getline(in, line);)
        out.push_back(line);
    return out;
}

std::string without(std::string text, std::string_view characters) {
    std::erase_if(text, [&](char c) { return characters.find(c) != std::string_view::npos; });
    return text;
}

/// True when `some` is what is left of `all` when a few are taken out.
template <class Container>
bool part_of(const Container& some, const Container& all) {
    auto at = all.begin();
    for (const auto& one : some) {
        at = std::find(at, all.end(), one);
        if (at == all.end()) {
            return false;
        }
        ++at;
    }
    return some.size() < all.size();
}

// What each kind is known by. None holds for a line that nothing happens to.

bool lines_are_lost(const Way& way) {
    return part_of(lines(way.came), lines(way.said));
}

/// Nothing comes through for a while in which something is said, more than once.
bool all_is_lost_for_a_while(const Way& way) {
    SimTime longest{0};
    std::optional<SimTime> since;
    auto came = way.came.times.begin();
    for (const SimTime said : way.said.times) {
        came = std::lower_bound(came, way.came.times.end(), said);
        if (came != way.came.times.end() && *came == said) {
            since.reset();
        } else {
            longest = std::max(longest, said - since.value_or(said));
            since = since.value_or(said);
        }
    }
    return part_of(way.came.bytes, way.said.bytes) && longest >= ms(1500);
}

bool bytes_are_changed(const Way& way) {
    return way.came.bytes.size() == way.said.bytes.size() && way.came.bytes != way.said.bytes;
}

bool lines_come_twice(const Way& way) {
    std::vector<std::string> once = lines(way.came);
    std::vector<std::string> said = lines(way.said);
    const bool more = once.size() > said.size();
    once.erase(std::unique(once.begin(), once.end()), once.end());
    said.erase(std::unique(said.begin(), said.end()), said.end());
    return more && once == said;
}

bool bytes_are_late(const Way& way) {
    if (way.came.bytes != way.said.bytes) {
        return false;
    }
    SimTime most{0};
    for (std::size_t i = 0; i < way.said.times.size(); ++i) {
        if (way.came.times[i] < way.said.times[i]) {
            return false;
        }
        most = std::max(most, way.came.times[i] - way.said.times[i]);
    }
    return most >= ms(50);
}

/// The end of some lines is missing, all line ends are there.
bool lines_are_cut(const Way& way) {
    const auto came = lines(way.came);
    const auto said = lines(way.said);
    return way.came.bytes.size() < way.said.bytes.size() &&
           std::equal(came.begin(), came.end(), said.begin(), said.end(),
                      [](const std::string& part, const std::string& whole) {
                          return whole.starts_with(without(part, "\r"));
                      });
}

bool lines_are_merged(const Way& way) {
    return without(way.came.bytes, "\r\n") == without(way.said.bytes, "\r\n") &&
           lines(way.came).size() < lines(way.said).size();
}

bool nuls_come_in(const Way& way) {
    const std::string_view nul("\0", 1);
    return without(way.came.bytes, nul) == without(way.said.bytes, nul) &&
           way.came.bytes.size() > way.said.bytes.size();
}

bool strays_come_in(const Way& way) {
    constexpr std::string_view stray = "ok N:0\r\n";
    std::string came = way.came.bytes;
    std::size_t strays = 0;
    for (std::size_t at = came.find(stray); at != std::string::npos; at = came.find(stray, at)) {
        came.erase(at, stray.size());
        ++strays;
    }
    return strays != 0 && came == way.said.bytes;
}

bool checksums_are_changed(const Way& way) {
    const auto came = lines(way.came);
    const auto said = lines(way.said);
    return came != said && std::equal(came.begin(), came.end(), said.begin(), said.end(),
                                      [](const std::string& a, const std::string& b) {
                                          return a.substr(0, a.rfind('*')) == b.substr(0, b.rfind('*'));
                                      });
}

struct Row {
    std::string_view kind;
    std::string_view own;  ///< attributes of its own
    bool (*seen)(const Way&);
    bool one_way = true;  ///< the other direction is let be
};
constexpr Row rows[] = {{"drop", "", lines_are_lost},
                        {"garble", "bits=2", bytes_are_changed},
                        {"duplicate", "", lines_come_twice},
                        {"delay", "time=150ms,jitter=50ms", bytes_are_late},
                        {"slow", "rate=300B/s", bytes_are_late},
                        {"cut", "", lines_are_cut},
                        {"merge", "", lines_are_merged},
                        {"nul_burst", "where=inside", nuls_come_in},
                        {"stray_ok", "", strays_come_in},
                        {"wrong_checksum", "", checksums_are_changed},
                        {"silence", "for=2s", all_is_lost_for_a_while},
                        {"disconnect", "for=2s", all_is_lost_for_a_while, false}};

const Row* row_of(std::string_view kind) {
    const auto hit =
        std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return row.kind == kind; });
    return hit == std::end(rows) ? nullptr : &*hit;
}

struct Course {
    Way to_screen;
    Way to_board;
    FaultStatus status;
    std::size_t times_down = 0;

    const Way& way(bool to_the_screen) const { return to_the_screen ? to_screen : to_board; }
};

constexpr SimTime until{25'000'000};

/// 5 s without and 20 s with the fault, and 15 s in which it has ended by itself, or is cleared when it does
/// not: then nothing more is done to the line, and buttons do what the screen expects of them.
Course spoil(const std::string& spec) {
    CAPTURE(spec);
    BothEnds ends;
    ends.run(ms(5000));
    CHECK(ends.to_screen.untouched());
    CHECK(ends.to_board.untouched());
    const FaultSpec fault = fault_from_text(spec);
    ends.faults.add(ends.now(), fault);
    ends.run(until - ends.now());
    const Way to_screen = ends.to_screen;
    const Way to_board = ends.to_board;
    FaultStatus status = ends.faults.list(ends.now()).at(0);
    if (!fault.trigger.until) {
        ends.faults.clear(ends.now());
    }
    ends.run(ms(5000));  // what is late, a line without its end, a screen that has to start anew
    CHECK(ends.faults.connected(ends.now()));
    if (fault.trigger.until) {
        status.over = ends.faults.list(ends.now()).at(0).over;
    }
    ends.run(ms(10'000));
    CHECK(ends.to_screen.untouched());
    CHECK(ends.to_board.untouched());
    CHECK(ends.to_board.said.bytes.size() > 500);
    CHECK(ends.met({"Control/Filament/Hotend on", "Steps/mm/Rset", "Setting/About"}));
    return {to_screen, to_board, status, ends.times_down};
}

std::string spec_of(const Row& row, bool to_the_screen, std::string_view more) {
    return fmt::format("{}:{}{}{},{}", row.kind, to_the_screen ? "to_screen" : "to_board",
                       row.own.empty() ? "" : ",", row.own, more);
}

}  // namespace

TEST_CASE("both ends: every kind of fault, in each direction") {
    for (const Kind* kind : kinds()) {
        const Row* const row = row_of(kind->name);
        REQUIRE_MESSAGE(row != nullptr, kind->name);
        for (const bool to_the_screen : {true, false}) {
            const std::string spec = spec_of(*row, to_the_screen, "probability=0.3,seed=7,until=25s");
            CAPTURE(spec);
            const Course course = spoil(spec);
            CHECK(row->seen(course.way(to_the_screen)));
            if (row->one_way) {
                CHECK(course.way(!to_the_screen).untouched());
                CHECK(course.times_down == 0);
            } else {
                CHECK(row->seen(course.way(!to_the_screen)));
                CHECK(course.times_down > 3);  // one may begin at the moment when another ends
                CHECK(course.times_down <= course.status.acted);
            }
            CHECK(course.status.acted > 3);
            CHECK(course.status.over);

            const Course again = spoil(spec);
            CHECK(again.to_screen == course.to_screen);
            CHECK(again.to_board == course.to_board);
            const Course other = spoil(spec_of(*row, to_the_screen, "probability=0.3,seed=8,until=25s"));
            CHECK(other.way(to_the_screen) != course.way(to_the_screen));
        }
    }
}

TEST_CASE("both ends: a fault that never ends is over when it is cleared") {
    for (const Row& row : rows) {
        const Course course = spoil(spec_of(row, true, "probability=0.3"));
        CHECK(row.seen(course.to_screen));
        CHECK_FALSE(course.status.over);
    }
}

TEST_CASE("both ends: what a kind is known by is not seen where it does nothing") {
    for (const Row& row : rows) {
        const Course idle = spoil(spec_of(row, true, "probability=0,until=25s"));
        CAPTURE(row.kind);
        CHECK(idle.status.seen > 20);
        CHECK(idle.status.acted == 0);
        CHECK_FALSE(row.seen(idle.to_screen));
        CHECK_FALSE(row.seen(idle.to_board));
    }
}
