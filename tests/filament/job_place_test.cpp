#include "emulator/filament/job_place.h"

#include <doctest/doctest.h>

#include <random>

using namespace fauxboard;
using namespace fauxboard::filament;

namespace {

JobPlace sample(std::uint64_t byte) {
    JobPlace place;
    place.volume = 1;
    place.path = "Ordner/Käse \"1\".gcode";
    place.bytes = 5'000'000'000;
    place.byte = byte;
    place.layer = 17;
    place.layers = 200;
    place.elapsed = SimTime{123'456'789};
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

/// The place that comes back from its bytes.
std::optional<JobPlace> there_and_back(const JobPlace& place) {
    std::string bytes;
    put_place(place, bytes);
    return place_from(bytes);
}

}  // namespace

TEST_CASE("job place: what is kept as bytes comes back") {
    const auto back = there_and_back(sample(7));
    REQUIRE(back);
    check_same(*back, sample(7));
}

TEST_CASE("job place: a path that is too long is not kept, and no bytes are no place") {
    JobPlace place = sample(7);
    place.path = std::string(513, 'p');
    CHECK_FALSE(there_and_back(place));
    CHECK_FALSE(place_from(""));
    CHECK_FALSE(place_from("abc"));
}

TEST_CASE("job place: any bytes give a place that can be, or none") {
    std::string good;
    put_place(sample(7), good);
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        std::string bad = good;
        for (int n = 0; n <= i % 4; ++n) {
            bad[random() % bad.size()] = static_cast<char>(random());
        }
        bad.resize(random() % (bad.size() + 1));
        const auto place = place_from(bad);
        if (place) {
            REQUIRE(place->byte <= place->bytes);
            REQUIRE((place->volume == 0 || place->volume == 1));
        }
    }
}
