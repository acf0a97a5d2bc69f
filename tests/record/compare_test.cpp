#include "emulator/record/compare.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "emulator/host/profile_files.h"
#include "emulator/record/replay.h"
#include "protocol/framing.h"

using namespace fauxboard;
using namespace fauxboard::record;
using From = RecordedLine::From;
using Lines = std::vector<RecordedLine>;

namespace {

RecordedLine line(double t, From from, const std::string& body) {
    std::string wire = protocol::frame(body);
    wire.resize(wire.size() - 2);
    return {machine::from_seconds(t), from, wire};
}

/// A recorded talk made by our own board: what differs from it was made to differ.
Lines made_up() {
    const auto profile = host::load_profile_by_name("geeetech-a30t");
    Lines talk{line(0, From::board, "L3")};
    const auto say = [&](double t, const std::string& body) { talk.push_back(line(t, From::screen, body)); };
    say(4, "M2134 FW:V1.02.xx");
    say(10, "M104 S200");
    say(20, "M2140 S5");
    say(300, "M2105 S2");
    say(310, "M2105 S4");
    say(320, "M104 S0");
    say(340, "M500");
    say(341, "M290 Z0.1");
    say(420, "M105");
    Lines out = replay(profile, talk, {}).lines;
    out.insert(out.end(), talk.begin() + 1, talk.end());
    std::stable_sort(out.begin(), out.end(),
                     [](const RecordedLine& a, const RecordedLine& b) { return a.t < b.t; });
    return out;
}

Lines ours(const Lines& recording) {
    return replay(host::load_profile_by_name("geeetech-a30t"), recording, {}).lines;
}

std::string all_failures(const Comparison& comparison) {
    std::string out;
    for (const std::string& failure : comparison.failures()) {
        out += failure + "\n";
    }
    return out;
}

template <class F>
void edit(Lines& lines, std::string_view part, F&& change) {
    for (RecordedLine& one : lines) {
        if (one.bytes.find(part) != std::string::npos) {
            change(one);
        }
    }
}

void drop(Lines& lines, double from, double to, std::string_view part) {
    std::erase_if(lines, [&](const RecordedLine& one) {
        const double t = machine::to_seconds(one.t);
        return t > from && t < to && one.bytes.find(part) != std::string::npos;
    });
}

}  // namespace

TEST_CASE("compare: a board is like itself") {
    const Lines recording = made_up();
    const Comparison comparison = compare(recording, ours(recording), true);
    CHECK(all_failures(comparison) == "");
    CHECK(comparison.ok());
    REQUIRE(comparison.requests.size() == 9);
    CHECK(comparison.requests[0].recorded == "L9");
    CHECK(comparison.requests[1].recorded == "L2");
    CHECK(comparison.requests[2].recorded == "L24 P5");
    CHECK(comparison.requests[3].recorded == "L12 P0");
    CHECK(comparison.requests[6].recorded == "");  // M500 has no answer
    CHECK(comparison.recorded_latency.replies == 8);
    CHECK(comparison.bursts.size() == 1);
    REQUIRE(comparison.curves.size() == 2);
    CHECK(comparison.curves[0].name == "nozzle, heating to 200");
    CHECK(comparison.curves[0].rms_k < 0.01);
    CHECK(comparison.curves[1].name == "nozzle, cooling");
}

TEST_CASE("compare: each kind of difference is found") {
    const Lines recording = made_up();
    Lines given = ours(recording);

    SUBCASE("a reply that is missing") {
        drop(given, 20, 20.2, "L24");
        CHECK(all_failures(compare(recording, given, true))
                  .find("M2140 S5 got no reply, the recorded board gave L24 P5") != std::string::npos);
    }
    SUBCASE("a reply where none was given") {
        given.push_back(line(340.08, From::board, "L24 P3 A7.00 B7.00 C0.50 D5.00"));
        std::stable_sort(given.begin(), given.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        CHECK(all_failures(compare(recording, given, true))
                  .find("M500 got L24 P3, the recorded board gave no reply") != std::string::npos);
    }
    SUBCASE("a late reply") {
        edit(given, "L24 P5", [](RecordedLine& one) { one.t += std::chrono::milliseconds(150); });
        CHECK(all_failures(compare(recording, given, true)).find("M2140 S5 was answered after 2") !=
              std::string::npos);
    }
    SUBCASE("another reply") {
        edit(given, "L24 P5", [](RecordedLine& one) {
            one = line(machine::to_seconds(one.t), From::board, "L24 P6 A0.00 B0.00");
        });
        CHECK(all_failures(compare(recording, given, true))
                  .find("M2140 S5 got L24 P6, the recorded board gave L24 P5") != std::string::npos);
    }
    SUBCASE("a boot message with other contents; a serial number does not count") {
        edit(given, "SN:", [](RecordedLine& one) {
            const std::size_t at = one.bytes.find("SN:") + 3;
            one.bytes.replace(at, 16, "0123456789ABCDEF");
            const std::string body = one.bytes.substr(4, one.bytes.rfind('*') - 4);
            one = line(machine::to_seconds(one.t), From::board, body);
        });
        CHECK(compare(recording, given, true).ok());
        edit(given, "L23 SE:0", [](RecordedLine& one) {
            one = line(machine::to_seconds(one.t), From::board,
                       "L23 SE:1 BE:1 BP:50 CE:0 HE:0 SP:0 ST:16 HC:0 HO:0");
        });
        CHECK(all_failures(compare(recording, given, true)).find("line 15: recorded L23, ours L23") !=
              std::string::npos);
    }
    SUBCASE("another period") {
        edit(given, "N-0 L3 ", [](RecordedLine& one) { one.t = one.t * 101 / 100; });
        CHECK(all_failures(compare(recording, given, true)).find("L3 always: every 4.24") !=
              std::string::npos);
    }
    SUBCASE("a change that does not come") {
        edit(given, " MT:1 ",
             [](RecordedLine& one) { one.bytes.replace(one.bytes.find(" MT:1 "), 6, " MT:0 "); });
        CHECK(all_failures(compare(recording, given, true)).find("L3 MT becomes 1 never") !=
              std::string::npos);
    }
    SUBCASE("another temperature") {
        edit(given, " T0:", [](RecordedLine& one) {
            const std::size_t at = one.bytes.find(" T0:") + 4;
            if (one.bytes[at] == '1') {
                one.bytes.replace(at, 1, "2");  // 100 K more
            }
        });
        CHECK(all_failures(compare(recording, given, true)).find("nozzle, heating to 200: ") !=
              std::string::npos);
    }
}

TEST_CASE("compare: the report, for people and for programs") {
    const Lines recording = made_up();
    const Comparison same = compare(recording, ours(recording), true);
    const std::string text = comparison_text(same);
    CHECK(text.find("M104 S200") != std::string::npos);
    CHECK(text.find("Verdict: the same talk, within the tolerances: 9 requests answered as recorded.") !=
          std::string::npos);
    CHECK(text.find("differs") == std::string::npos);
    const auto json = comparison_json(same);
    CHECK(json["ok"] == true);
    CHECK(json["differences"].empty());
    CHECK(json["requests"].size() == 9);
    CHECK(json["requests"][6]["ours"].is_null());
    CHECK(json["periods"][0]["frame"] == "L3");

    const Comparison nothing = compare(recording, {}, true);
    CHECK_FALSE(nothing.ok());
    CHECK(comparison_text(nothing).find("Verdict: not the same talk; ") != std::string::npos);
    CHECK(comparison_json(nothing)["ok"] == false);
    CHECK(compare({}, {}, true).ok());
}

// The figures that the emulated A30T is built to. The recording is somebody else's and no part of this
// repository.
TEST_CASE("compare: our A30T against the recorded one") {
    const std::filesystem::path file =
        FAUXBOARD_SOURCE_DIR "/../shared/captures/a30t-boot-heat-load-home.jsonl";
    if (!std::filesystem::exists(file)) {
        MESSAGE("skipped: no recording beside the source tree");
        return;
    }
    const Lines recording = load_recording(file);
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        CAPTURE(seed);
        const ReplayResult result =
            replay(host::load_profile_by_name("geeetech-a30t"), recording, {.seed = seed});
        const Comparison comparison = compare(recording, result.lines, true);
        CHECK(all_failures(comparison) == "");
        CHECK(result.notices.empty());
        CHECK(comparison.requests.size() == 44);
        CHECK(comparison.bursts.size() == 2);
        for (const CountRow& row : comparison.counts) {
            CAPTURE(row.frame);
            if (row.frame == "L2") {  // when a temperature has moved enough hangs on noise
                CHECK(static_cast<double>(row.ours) ==
                      doctest::Approx(static_cast<double>(row.recorded)).epsilon(0.08));
            } else {
                CHECK(row.ours == row.recorded);
            }
        }
        for (const CurveRow& row : comparison.curves) {
            CHECK(row.rms_k < 1);
        }
    }
}
