// A whole print of a sliced file by the buttons of the virtual screen, on a real pseudo-terminal.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "emulator/record/recording.h"
#include "protocol/framing.h"
#include "tests/e2e/program.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::e2e {
namespace {

using Frame = std::map<std::string, std::string>;

/// "L3 PS:1 FN:a PG:7" as its fields.
Frame fields_of(const std::string& body) {
    Frame out;
    for (std::size_t at = body.find(' '); at != std::string::npos; at = body.find(' ', at + 1)) {
        const std::string field = body.substr(at + 1, body.find(' ', at + 1) - at - 1);
        out[field.substr(0, field.find(':'))] = field.substr(field.find(':') + 1);
    }
    return out;
}

Frame expected(const std::string& status, const std::string& motors, const std::string& name,
               const std::string& progress, const std::string& seconds, const std::string& layer,
               const std::string& layers) {
    return {{"PS", status},  {"VL", "0"},   {"MT", motors}, {"FT", "0"},  {"AL", "1"},
            {"ST", "1"},     {"WF", "0"},   {"MR", "100"},  {"FN", name}, {"PG", progress},
            {"TM", seconds}, {"LA", layer}, {"LC", layers}};
}

std::string words(const Frame& frame) {
    std::string out;
    for (const auto& field : frame) {
        out += field.first + ":" + field.second + " ";
    }
    return out;
}

/// A board whose card holds a sliced file of 60 000 moves and 200 layers.
struct Print {
    /// Ahead of time, so that board and screens have an hour's time for what takes a moment.
    static constexpr const char* speed = "20";

    TemporaryFolder folder;
    std::string content = made();
    Program program{{"run", "--no-pacing", "-q", "--speed", speed, "--sd", folder.file("card"), "--control",
                     folder.file("control"), "--record", folder.file("talk.jsonl")}};
    std::string path = program.ready()["path"];

    std::string made() const {
        testing::SlicedFile wishes;
        wishes.moves = 60'000;
        wishes.layers = 200;
        const std::string text = testing::make_sliced_file(wishes);
        std::filesystem::create_directory(folder.file("card"));
        std::ofstream(folder.file("card/Part.gcode"), std::ios::binary) << text;
        return text;
    }
    /// Touches buttons of a screen that is plugged in for it; each must be met by what it expects. A screen
    /// that has not heard yet that a print is under way shows no buttons for it; then it is tried again.
    void press(const Args& buttons) const {
        Args args{"screen", "--port", path, "--speed", speed, "press"};
        args.insert(args.end(), buttons.begin(), buttons.end());
        Result result = run(args);
        for (int tries = 1; tries < 20 && contains(result.errors, "is not there now"); ++tries) {
            result = run(args);
        }
        INFO(result.out);
        INFO(result.errors);
        REQUIRE(result.code == 0);
    }
    Result ctl(Args args) const {
        args.insert(args.begin(), {"ctl", folder.file("control")});
        return run(args);
    }
    void advance(const std::string& time) const { REQUIRE(ctl({"advance", time}).code == 0); }
    /// Values of the running board, all of one moment.
    nlohmann::json values() const {
        return nlohmann::json::parse(ctl({"get", "job", "--json"}).out)["fields"];
    }
    double number(const std::string& field) const { return values()[field].get<double>(); }
    /// Everything of this start that the board said so far.
    std::vector<std::string> said(std::string_view start) const {
        std::vector<std::string> bodies;
        for (const record::RecordedLine& line : record::load_recording(folder.file("talk.jsonl"))) {
            const std::string body(protocol::unframe(line.bytes, protocol::ChecksumPolicy::required).body);
            if (line.from == record::RecordedLine::From::board && body.starts_with(start)) {
                bodies.push_back(body);
            }
        }
        return bodies;
    }
    Frame last_l3() const {
        const auto all = said("L3 ");
        REQUIRE(!all.empty());
        return fields_of(all.back());
    }
    /// The layer that a place in the file belongs to, counted from 1.
    int layer_at(double byte) const {
        const std::size_t mark = content.rfind(";LAYER:", static_cast<std::size_t>(byte));
        return mark == std::string::npos ? 0 : std::stoi(content.substr(mark + 7)) + 1;
    }
    double bytes() const { return static_cast<double>(content.size()); }
    std::size_t moves() const {
        std::size_t count = 0;
        for (std::size_t at = 0; at != std::string::npos; at = content.find('\n', at)) {
            at += content[at] == '\n' ? 1U : 0U;
            count += content.compare(at, 3, "G0 ") == 0 || content.compare(at, 3, "G1 ") == 0 ? 1U : 0U;
        }
        return count;
    }
};

int whole(const Frame& frame, const char* key) {
    return std::stoi(frame.at(key));
}

/// Status, progress, time and layer as they went, over all that the screen was told.
void check_course(const std::vector<std::string>& frames) {
    std::string statuses;
    Frame before = fields_of(frames.front());
    for (const std::string& body : frames) {
        CAPTURE(body);
        const Frame frame = fields_of(body);
        REQUIRE(frame.size() == 13);
        if (statuses.empty() || statuses.back() != frame.at("PS")[0]) {
            statuses += frame.at("PS");
        }
        if (frame.at("PS") == "0") {
            const char* const name =
                statuses.size() > 1 ? "Part.gcode" : "";  // it stays when the print is over
            CHECK(words(frame) == words(expected("0", frame.at("MT"), name, "0", "0", "0", "0")));
        } else {
            CHECK(frame.at("FN") == "Part.gcode");
            CHECK(frame.at("LC") == "200");
            for (const char* key : {"PG", "TM", "LA"}) {
                CHECK(whole(frame, key) >= whole(before, key));
            }
        }
        before = frame;
    }
    CHECK(statuses == "012140");
}

TEST_CASE(
    "a print of 60 000 moves: chosen, started, paused and resumed by the screen's buttons, to its end") {
    const Print print;
    print.press({"Printing"});
    const auto listed = print.said("L7 P");
    CHECK(!listed.empty());
    CHECK(std::all_of(listed.begin(), listed.end(),
                      [](const std::string& body) { return body == "L7 P0 Part.gcode"; }));
    for (const std::string& body : print.said("L3 ")) {
        CHECK(words(fields_of(body)) == words(expected("0", "0", "", "0", "0", "0", "0")));
    }

    print.press({"Printing/File 1", "Printing/Print?/yes"});
    auto all = print.said("L3 PS:1 ");
    REQUIRE(!all.empty());
    CHECK(words(fields_of(all.front())) == words(expected("1", "0", "Part.gcode", "0", "0", "0", "200")));

    print.advance("10min");
    const nlohmann::json from = print.values();
    print.advance("5s");
    const Frame running = print.last_l3();
    const nlohmann::json to = print.values();
    CHECK(from["job.status"] == 1);
    CHECK(words(running) == words(expected("1", "1", "Part.gcode", running.at("PG"), running.at("TM"),
                                           running.at("LA"), "200")));
    CHECK(whole(running, "TM") >= std::floor(from["job.seconds"].get<double>()));
    CHECK(whole(running, "TM") <= to["job.seconds"].get<double>());
    CHECK(whole(running, "PG") >= std::floor(from["job.byte"].get<double>() * 100 / print.bytes()));
    CHECK(whole(running, "PG") <= to["job.byte"].get<double>() * 100 / print.bytes());
    CHECK(whole(running, "LA") >= print.layer_at(from["job.byte"]));
    CHECK(whole(running, "LA") <= print.layer_at(to["job.byte"]));
    CHECK(whole(running, "LA") > 1);

    print.press({"Bar chart button/Pause?/yes"});
    print.advance("2min");
    const nlohmann::json paused = print.values();
    REQUIRE(paused["job.status"] == 2);
    const double byte = paused["job.byte"];
    const Frame told = print.last_l3();
    // Where a layer begins the file is ahead: the layer is told when the nozzle is at its height.
    CHECK(whole(told, "LA") <= print.layer_at(byte));
    CHECK(whole(told, "LA") >= print.layer_at(byte) - 1);
    const Frame at_rest =
        expected("2", "1", "Part.gcode", std::to_string(static_cast<int>(byte * 100 / print.bytes())),
                 std::to_string(static_cast<int>(paused["job.seconds"].get<double>())), told.at("LA"), "200");
    CHECK(words(told) == words(at_rest));
    print.advance("1h");
    CHECK(words(print.last_l3()) == words(at_rest));
    CHECK(print.number("job.byte") == byte);

    print.press({"Bar chart button/Resume"});
    const auto resumed = print.said("L3 ");
    const auto first = std::find_if(resumed.rbegin(), resumed.rend(),
                                    [](const std::string& body) { return body.starts_with("L3 PS:2 "); });
    REQUIRE(first != resumed.rbegin());
    Frame going_on = at_rest;
    going_on["PS"] = "1";
    CHECK(words(fields_of(*(first - 1))) == words(going_on));

    for (int i = 0; i < 100 && print.number("job.status") != 0; ++i) {
        print.advance("30min");
    }
    const auto finished = print.said("L3 PS:4 ");
    REQUIRE(!finished.empty());
    const Frame last = fields_of(finished.back());
    CHECK(words(last) ==
          words(expected("4", last.at("MT"), "Part.gcode", "100", last.at("TM"), "200", "200")));
    CHECK(print.number("job.moves") == print.moves());
    CHECK(print.number("job.unknown_codes") == 0);
    const auto messages = print.said("L14  Layer ");
    REQUIRE(messages.size() == 200);
    for (std::size_t i = 0; i < messages.size(); ++i) {
        CHECK(messages[i] == "L14  Layer " + std::to_string(i + 1));
    }
    print.press({"Printing"});  // it is open to be pressed again
    check_course(print.said("L3 "));
}

}  // namespace
}  // namespace fauxboard::e2e
