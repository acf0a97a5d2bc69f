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
using machine::JobPlace;

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

JobPlace sample(std::uint64_t byte) {
    JobPlace place;
    place.volume = 1;
    place.path = "Ordner/Käse \"1\".gcode";
    place.bytes = 5'000'000'000;
    place.byte = byte;
    place.layer = 17;
    place.layers = 200;
    place.elapsed = machine::SimTime{123'456'789};
    place.at = {10.125, -3.5, 7.2, 1234.56789};
    place.nozzle_c = 205.5;
    place.bed_c = 60;
    place.part_fan_percent = 80;
    place.speed_percent = 120;
    place.flow_percent = 95;
    place.modal.unit_mm = 25.4;
    place.modal.feed_mm_s = 41.7;
    place.modal.weights = {0.5, 0.25, 0.25};
    place.relative_e = true;
    return place;
}

void check_same(const JobPlace& a, const JobPlace& b) {
    CHECK(a.volume == b.volume);
    CHECK(a.path == b.path);
    CHECK(a.bytes == b.bytes);
    CHECK(a.byte == b.byte);
    CHECK(a.layer == b.layer);
    CHECK(a.layers == b.layers);
    CHECK(a.elapsed == b.elapsed);
    CHECK(a.at == b.at);
    CHECK(a.nozzle_c == b.nozzle_c);
    CHECK(a.bed_c == b.bed_c);
    CHECK(a.part_fan_percent == b.part_fan_percent);
    CHECK(a.speed_percent == b.speed_percent);
    CHECK(a.flow_percent == b.flow_percent);
    CHECK(a.modal.unit_mm == b.modal.unit_mm);
    CHECK(a.modal.feed_mm_s == b.modal.feed_mm_s);
    CHECK(a.modal.weights == b.modal.weights);
    CHECK(a.relative == b.relative);
    CHECK(a.relative_e == b.relative_e);
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
            check_same(*back, sample(byte));
        }
    }
    {
        JobPlaceFile store = open();
        CHECK(store.load()->byte == 9);
        store.keep(sample(10));
        CHECK(open().load()->byte == 10);
        store.drop();
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
        old += place->byte == 2 ? 1 : 0;
        fresh += place->byte == 3 ? 1 : 0;
        REQUIRE((place->byte == 2 || place->byte == 3));
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
            REQUIRE((place->byte == 1 || place->byte == 2));
        }
        store.keep(sample(77));
        REQUIRE(open().load());
        REQUIRE(open().load()->byte == 77);
    }
}

TEST_CASE_FIXTURE(Bench, "job place: a file that cannot be is an error with a reason") {
    CHECK_THROWS_AS(JobPlaceFile(folder.file("missing/eeprom.job"), {}), link::HostError);
    CHECK_THROWS_AS(JobPlaceFile("/dev/null", {}), link::HostError);
}
