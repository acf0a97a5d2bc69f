#include "tests/fault/helpers.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "protocol/framing.h"

namespace fauxboard::fault {
namespace {

constexpr std::array both_ways{Direction::to_screen, Direction::to_board};
constexpr std::array<std::size_t, 5> chunks{1, 2, 3, 7, 64};

std::string with(std::string_view own, std::string_view more) {
    const bool bare = own.find(':') == std::string_view::npos;
    return std::string(own) + (bare ? ":" : ",") + std::string(more);
}

/// After the fault, a wire: half lines at once.
void check_wire(LineRig& rig) {
    CHECK(rig.push("N-0 half") == "N-0 half");
    CHECK(rig.push(" a line\r\n") == " a line\r\n");
    CHECK(rig.line.held() == 0);
}

void check_ends_with_count(std::string_view own, Direction direction, bool changes_bytes) {
    LineRig rig(direction);
    rig.add(with(own, "every=3,count=2"));
    const std::string input = frames(20);
    const std::string at_once = rig.push(input);
    CHECK(at_once != input);
    const std::string out = at_once + rig.pass(std::chrono::minutes(10));
    CHECK((out != input) == changes_bytes);
    CHECK(rig.status().acted == 2);
    CHECK(rig.status().over);
    CHECK(out.ends_with(frames(20).substr(frames(7).size())));
    check_wire(rig);
}

void check_ends_with_time(std::string_view own, Direction direction) {
    LineRig rig(direction);
    rig.add(with(own, "from=1s,for=2s"));
    CHECK(rig.push(frames(3)) == frames(3));
    rig.pass(ms(1000));
    rig.push(frames(3));
    CHECK(rig.status().acted == 3);
    rig.pass(ms(1999));
    CHECK_FALSE(rig.status().over);
    rig.pass(std::chrono::minutes(10));
    CHECK(rig.status().over);
    CHECK(rig.push(frames(3)) == frames(3));
    check_wire(rig);
}

void check_ends_when_cleared(std::string_view own, Direction direction) {
    LineRig rig(direction);
    rig.add(own);
    rig.push(frames(3) + "N-0 half");
    rig.line.clear(rig.now);
    CHECK(rig.line.held() == 0);
    rig.pass(SimTime{0});
    CHECK(rig.push(frames(3)) == frames(3));
    check_wire(rig);
    CHECK(rig.line.advance(rig.now) == machine::never);
}

}  // namespace

std::string frames(std::size_t n) {
    std::string out;
    for (std::size_t i = 0; i < n; ++i) {
        out += protocol::frame("L1 X" + std::to_string(i));
    }
    return out;
}

std::string LineRig::take() {
    std::string out(line.output());
    line.clear_output();
    return out;
}

std::string LineRig::push(std::string_view bytes, std::size_t chunk) {
    std::string out;
    while (!bytes.empty()) {
        line.push(now, bytes.substr(0, chunk));
        bytes.remove_prefix(std::min(chunk, bytes.size()));
        out += take();
    }
    return out;
}

std::string LineRig::pass(SimTime time) {
    const SimTime end = now + time;
    std::string out;
    while (true) {
        const SimTime next = line.advance(now);
        CHECK(next > now);
        out += take();
        if (next > end) {
            break;
        }
        now = next;
    }
    now = end;
    line.advance(now);
    return out + take();
}

std::string spoiled(std::string_view spec, std::string_view bytes, Direction direction, std::size_t chunk) {
    LineRig rig(direction);
    rig.add(spec);
    const std::string out = rig.push(bytes, chunk);
    return out + rig.pass(std::chrono::hours(1));
}

void check_edits(std::string_view own) {
    const std::string input = frames(40) + "bare\nN-0 half";
    for (const Direction direction : both_ways) {
        const std::string spec = with(own, "probability=0.5,seed=7");
        const std::string out = spoiled(spec, input, direction);
        CHECK(out != input);
        for (const std::size_t chunk : chunks) {
            CHECK(spoiled(spec, input, direction, chunk) == out);
        }
        CHECK(spoiled(with(own, "probability=0.5,seed=8"), input, direction) != out);
        CHECK(spoiled(with(own, "probability=0"), input, direction) == input);
        check_ends_with_count(own, direction, true);
        check_ends_with_time(own, direction);
        check_ends_when_cleared(own, direction);
    }
}

void check_paces(std::string_view own) {
    const std::string input = frames(40) + "bare\nN-0 half";
    for (const Direction direction : both_ways) {
        // What comes out within each 10 ms is repeatable, too.
        const auto course = [&](std::size_t chunk) {
            LineRig rig(direction);
            rig.add(with(own, "probability=0.5,seed=7"));
            std::vector<std::string> out{rig.push(input, chunk)};
            for (int i = 0; i < 2000; ++i) {
                out.push_back(rig.pass(ms(10)));
            }
            return out;
        };
        const std::vector<std::string> out = course(std::string_view::npos);
        std::string all;
        for (const std::string& part : out) {
            all += part;
        }
        CHECK(all == input);
        CHECK(out.front() != input);
        for (const std::size_t chunk : chunks) {
            const std::vector<std::string> again = course(chunk);
            CHECK(std::equal(out.begin() + 1, out.end(), again.begin() + 1));
        }
        check_ends_with_count(own, direction, false);
        check_ends_with_time(own, direction);
        check_ends_when_cleared(own, direction);
    }
}

void check_interrupts(std::string_view kind) {
    const std::string half_a_second = with(kind, "for=500ms");
    for (const Direction direction : both_ways) {
        const auto course = [&](std::string_view more, std::size_t chunk) {
            LineRig rig(direction);
            rig.add(with(half_a_second, more));
            std::string out;
            for (int i = 0; i < 50; ++i) {
                out += rig.push(frames(4), chunk);
                out += rig.pass(ms(100));
            }
            return out;
        };
        const std::string out = course("probability=0.1,seed=7", std::string_view::npos);
        CHECK(out.size() < frames(4).size() * 50);
        for (const std::size_t chunk : chunks) {
            CHECK(course("probability=0.1,seed=7", chunk) == out);
        }
        CHECK(course("probability=0.1,seed=8", std::string_view::npos) != out);

        LineRig counted(direction);
        counted.add(with(half_a_second, "every=3,count=2"));
        CHECK(counted.push(frames(4)) == frames(2));
        CHECK(counted.pass(ms(499)).empty());
        CHECK(counted.push("lost\n").empty());
        counted.pass(ms(1));
        CHECK(counted.push(frames(4)) == frames(2));
        CHECK_FALSE(counted.status().over);
        counted.pass(ms(500));
        CHECK(counted.status().acted == 2);
        CHECK(counted.status().over);
        CHECK(counted.push(frames(4)) == frames(4));
        check_wire(counted);

        LineRig timed(direction);
        timed.add(with(half_a_second, "at=1s"));
        timed.pass(ms(999));
        CHECK(timed.push("half ") == "half ");
        timed.pass(ms(1));
        CHECK(timed.push("a line\r\n").empty());
        CHECK(timed.status().acted == 1);
        CHECK_FALSE(timed.status().over);
        timed.pass(ms(500));
        CHECK(timed.status().over);
        check_wire(timed);
        CHECK(timed.line.bytes_lost() == 8);
        check_ends_when_cleared(kind, direction);
    }
}

}  // namespace fauxboard::fault
