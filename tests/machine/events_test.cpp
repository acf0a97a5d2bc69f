#include "emulator/machine/events.h"

#include <doctest/doctest.h>

#include <set>

#include "emulator/machine/event_rows.h"
#include "emulator/machine/kind.h"

using namespace fauxboard::machine;

TEST_CASE("events: names are unique and lead back to their event") {
    std::set<std::string_view> names;
    for (const EventId each : events()) {
        CHECK(names.insert(each->name).second);
        CHECK(find_event(each->name) == each);
        CHECK_FALSE(each->help.empty());
    }
    CHECK_FALSE(find_event("nothing").has_value());
}

TEST_CASE("events: the queue keeps their order, drops the newest when full, and counts that") {
    EventQueue queue;
    for (int i = 0; i < 70; ++i) {
        queue.raise(i % 2 == 0 ? event("motion.homed") : event("job.started"));
    }
    CHECK(queue.dropped() == 6);
    for (int i = 0; i < 64; ++i) {
        REQUIRE(queue.take() == (i % 2 == 0 ? event("motion.homed") : event("job.started")));
    }
    CHECK_FALSE(queue.take().has_value());
    for (int i = 0; i < 1000; ++i) {
        queue.raise(event("job.paused"));
        REQUIRE(queue.take() == event("job.paused"));
    }
    CHECK(queue.empty());
}

TEST_CASE("events: each of a kind has its place among those that its machines may raise") {
    for (const Kind* kind : kinds()) {
        const auto own = events_of(*kind);
        CHECK(own.size() == common_events.size() + kind->events.size());
        for (std::size_t i = 0; i < own.size(); ++i) {
            CHECK(event_index(*kind, own[i]) == i);
        }
    }
}
