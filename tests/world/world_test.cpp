// The seeded world: a short life of every shipped board, and the tools of the world itself.

#include <doctest/doctest.h>

#include <array>

#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/host/script_files.h"
#include "emulator/world/invariants.h"
#include "emulator/world/play.h"
#include "emulator/world/steps.h"

namespace fauxboard::world {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

/// So that a program without optimisation is done in a minute, and one with sanitizers, which is many times
/// as slow and whose first lives are the same; `fauxboard soak` plays as many as are wanted.
constexpr std::uint64_t seeds = sanitized ? 1 : 4;
constexpr std::uint64_t steps = 50;

Cast cast_of(const std::string& name) {
    const bool touched = name == "geeetech-a30t";
    return make_cast(host::load_profile_by_name(name),
                     touched ? host::load_screen_by_name("geeetech-a30t") : nullptr);
}

void live(const std::string& name) {
    CAPTURE(name);
    const Soaked soaked =
        soak(cast_of(name), 1, steps, [](const Soaked& so_far) { return so_far.seeds >= seeds; });
    CHECK_MESSAGE(soaked.broken.empty(), soaked.broken);
}

TEST_CASE("a short life of every shipped board keeps all promises") {
    for (const host::ProfileEntry& entry : host::list_profiles()) {
        if (!entry.name.ends_with("-base")) {
            live(entry.name);
        }
    }
}

TEST_CASE("each line of every board has a request that it is known to answer") {
    for (const char* name : {"geeetech-a30t", "geeetech-a30", "elegoo-mars-pro"}) {
        const Cast cast = cast_of(name);
        CAPTURE(name);
        CHECK(cast.probes[static_cast<std::size_t>(behaviour::Channel::main)].has_value());
        CHECK(cast.requests.size() > 20);
    }
    CHECK(cast_of("geeetech-a30t").probes[static_cast<std::size_t>(behaviour::Channel::host)].has_value());
    CHECK(
        cast_of("elegoo-mars-pro").probes[static_cast<std::size_t>(behaviour::Channel::network)].has_value());
}

TEST_CASE("a world is its seed: the same bytes again, and others for another") {
    const Cast cast = cast_of("geeetech-a30t");
    const Outcome once = play(cast, 5, whole(10));
    const Outcome again = play(cast, 5, whole(10));
    CHECK(once.digest == again.digest);
    CHECK(once.time == again.time);
    CHECK(once.requests == again.requests);
    CHECK(play(cast, 6, whole(10)).digest != once.digest);
}

TEST_CASE("what a board prints is found by trying, and printed at the end of its life") {
    struct Row {
        const char* profile;
        const char* file;
        Tally tally;
    };
    constexpr std::array rows{
        Row{"marlin", "cold.gco", {61, 0}}, Row{"geeetech-a30-no-card", "cold.gco", {61, 0}},
        Row{"elegoo-mars-pro", "part.cbddlp", {0, 5}}, Row{"mks-dlp", "panel.cbddlp", {0, 5}}};
    for (const Row& row : rows) {
        const Cast cast = cast_of(row.profile);
        CAPTURE(row.profile);
        CHECK(cast.proof.file == row.file);
        CHECK(cast.proof.tally == row.tally);
        CHECK(cast.prints.size() >= 2);
    }
    // One that came to another end than it should.
    Cast cast = cast_of("elegoo-mars-pro");
    cast.proof.tally = {0, 6};
    CHECK(play(cast, 1, {})
              .broken.starts_with("prints end: a print had 0 moves and 5 layers instead of 0 moves and 6"));
}

TEST_CASE("a scenario is played along, over and over, and is in the seed's bytes") {
    const behaviour::SourceText source = host::find_script("print-with-filament-change");
    const script::Cast with = host::make_cast("geeetech-a30t", script::read_head(source).screen);
    const Cast cast = make_cast(script::load_scenario(source, host::script_finder(), with));
    const Outcome once = play(cast, 5, whole(10));
    CHECK_MESSAGE(once.held(), once.broken);
    CHECK(play(cast, 5, whole(10)).digest == once.digest);
    CHECK(play(make_cast(with.profile, with.screen), 5, whole(10)).digest != once.digest);
}

TEST_CASE("a broken promise shrinks to what breaks it, and its report plays again") {
    Cast cast = cast_of("elegoo-mars-pro");
    // A line that never answers so needs nothing to happen before.
    cast.probes[static_cast<std::size_t>(behaviour::Channel::main)] = Probe{"M105", "what no board says", {}};
    const Outcome outcome = play(cast, 3, whole(20));
    REQUIRE_FALSE(outcome.held());
    const std::vector<std::uint64_t> fewest = shrink(cast, 3, whole(20));
    CHECK(fewest.empty());
    const std::string told = report(cast, 3, fewest);
    CHECK(told.find("profile elegoo-mars-pro, seed 3") == 0);
    CHECK(told.find("every line answers") != std::string::npos);
}

TEST_CASE("each promise and each kind of step has its words") {
    for (const Invariant& each : invariants()) {
        CHECK(each.promise.ends_with('.'));
        CHECK((each.broken != nullptr));
    }
    for (const StepKind& each : step_kinds()) {
        CHECK(each.weight > 0);
        CHECK_FALSE(each.name.empty());
    }
}

}  // namespace
}  // namespace fauxboard::world
