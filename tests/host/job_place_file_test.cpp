// The place of a job on disk: what comes back, and what a broken file gives.

#include "emulator/host/job_place_file.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "emulator/link/host_error.h"
#include "tests/link/helpers.h"

using namespace fauxboard;
using host::JobPlaceFile;

namespace {

struct Bench {
    link::test::TemporaryFolder folder;
    std::string file = folder.file("eeprom.job");
    std::string trouble;
    JobPlaceFile open() {
        return JobPlaceFile(file, [this](std::string_view text) { trouble = text; });
    }
    std::string bytes() const {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void put(const std::string& text) const { std::ofstream(file, std::ios::binary) << text; }
};

/// A place that a machine might keep: `byte` tells one from another.
std::string sample(std::uint64_t byte) {
    return std::string(200, 'v') + std::to_string(byte) + " Ordner/Käse \"1\".gcode";
}

}  // namespace

TEST_CASE_FIXTURE(Bench, "job place: what was kept last comes back, until it is dropped") {
    CHECK_FALSE(open().load());
    {
        JobPlaceFile store = open();
        for (std::uint64_t byte = 1; byte <= 9; ++byte) {
            store.keep(sample(byte));
            const auto back = open().load();
            REQUIRE(back);
            CHECK(*back == sample(byte));
        }
    }
    {
        JobPlaceFile store = open();
        CHECK(store.load() == sample(9));
        store.keep(sample(10));
        CHECK(open().load() == sample(10));
        store.drop();
    }
    CHECK_FALSE(open().load());
}

TEST_CASE_FIXTURE(Bench, "job place: what has no room is no place") {
    JobPlaceFile store = open();
    store.keep(sample(1));
    store.keep(std::string(5000, 'x'));
    CHECK_FALSE(open().load());
}

TEST_CASE_FIXTURE(Bench, "job place: a write torn anywhere leaves the place before it") {
    {
        JobPlaceFile store = open();
        store.keep(sample(1));
        store.keep(sample(2));
    }
    const std::string before = bytes();
    {
        JobPlaceFile store = open();
        store.load();
        store.keep(sample(3));
    }
    const std::string after = bytes();
    REQUIRE(before.size() <= after.size());
    std::size_t first = 0;
    while (first < before.size() && before[first] == after[first]) {
        ++first;
    }
    REQUIRE(first < before.size());
    int old = 0, fresh = 0;
    for (std::size_t cut = first; cut <= after.size(); ++cut) {
        std::string torn = before;
        torn.resize(after.size());
        torn.replace(first, cut - first, after, first, cut - first);
        put(torn);
        const auto place = open().load();
        REQUIRE(place);
        old += place == sample(2) ? 1 : 0;
        fresh += place == sample(3) ? 1 : 0;
        REQUIRE((place == sample(2) || place == sample(3)));
    }
    CHECK(old > 0);
    CHECK(fresh > 0);
}

TEST_CASE_FIXTURE(Bench, "job place: any file gives a place or none, and the next one is kept in it") {
    {
        JobPlaceFile store = open();
        store.keep(sample(1));
        store.keep(sample(2));
    }
    const std::string good = bytes();
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        std::string bad = good;
        for (int n = 0; n <= i % 4; ++n) {
            bad[random() % bad.size()] = static_cast<char>(random());
        }
        bad.resize(random() % (bad.size() + 1));
        put(bad);
        JobPlaceFile store = open();
        const auto place = store.load();
        if (place) {
            REQUIRE((place == sample(1) || place == sample(2)));
        }
        store.keep(sample(77));
        REQUIRE(open().load());
        REQUIRE(open().load() == sample(77));
    }
}

TEST_CASE_FIXTURE(Bench, "job place: a file that cannot be is an error with a reason") {
    CHECK_THROWS_AS(JobPlaceFile(folder.file("missing/eeprom.job"), {}), link::HostError);
    CHECK_THROWS_AS(JobPlaceFile("/dev/null", {}), link::HostError);
}
