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
        for (std::uint64_t byte = 1; byte <= 9; ++byte) {
            open().keep(sample(byte));
            const auto back = open().load();
            REQUIRE(back);
            CHECK(*back == sample(byte));
        }
    }
    {
        CHECK(open().load() == sample(9));
        open().keep(sample(10));
        CHECK(open().load() == sample(10));
        open().drop();
    }
    CHECK_FALSE(open().load());
}

TEST_CASE_FIXTURE(Bench, "job place: what has no room is no place") {
    {
        JobPlaceFile store = open();
        store.keep(sample(1));
        store.keep(std::string(5000, 'x'));
    }
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
        const auto marked = [&](std::size_t slot) {
            return bad.size() >= slot + 8 && bad.compare(slot, 8, good, slot, 8) == 0;
        };
        if (!bad.empty() && !marked(0) && !marked(JobPlaceFile::slot_bytes)) {
            REQUIRE_THROWS_AS(open(), link::HostError);  // anybody's, as far as can be seen
            continue;
        }
        {
            JobPlaceFile store = open();
            const auto place = store.load();
            if (place) {
                REQUIRE((place == sample(1) || place == sample(2)));
            }
            store.keep(sample(77));
        }
        REQUIRE(open().load());
        REQUIRE(open().load() == sample(77));
    }
}

TEST_CASE_FIXTURE(Bench, "job place: a file that cannot be is an error with a reason") {
    CHECK_THROWS_AS(JobPlaceFile(folder.file("missing/eeprom.job"), {}), link::HostError);
    CHECK_THROWS_AS(JobPlaceFile("/dev/null", {}), link::HostError);
}

TEST_CASE("job place: a file that is somebody else's stays as it is, and is named") {
    Bench bench;
    const std::string foreign(362, 'f');
    for (const std::string& text : {foreign, std::string("{}\n"), std::string(5000, '\0')}) {
        bench.put(text);
        CHECK_THROWS_WITH_AS(bench.open(), doctest::Contains(bench.file.c_str()), link::HostError);
        CHECK(bench.bytes() == text);
    }
    bench.put("");
    bench.open().keep(sample(1));  // an empty one is nobody's
    bench.open().keep(sample(2));
    CHECK(bench.open().load().has_value());
}

TEST_CASE("job place: a second board on the same file is told, and changes nothing") {
    Bench bench;
    {
        JobPlaceFile first = bench.open();
        first.keep(sample(7));
        const std::string before = bench.bytes();
        CHECK_THROWS_WITH_AS(bench.open(), doctest::Contains("is in use by a board that runs"),
                             link::HostError);
        CHECK(bench.bytes() == before);
    }
    CHECK(bench.open().load() == sample(7));
    CHECK((std::filesystem::status(bench.file).permissions() & std::filesystem::perms::others_all) ==
          std::filesystem::perms::none);
}
