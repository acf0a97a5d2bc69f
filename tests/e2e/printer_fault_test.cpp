// `run --fault` with faults of the printer, as its users have them.

#include "emulator/record/recording.h"
#include "protocol/framing.h"
#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

struct Broken {
    explicit Broken(const Args& faults) : program(arguments(faults)), peer(program.ready()["path"]) {}
    Args arguments(const Args& faults) const {
        Args args{"run", "--no-pacing", "-q", "--control", control, "--record", recording};
        for (const std::string& fault : faults) {
            args.insert(args.end(), {"--fault", fault});
        }
        return args;
    }
    Result ctl(Args words) const {
        words.insert(words.begin(), {"ctl", control});
        return run(words);
    }
    /// What the board said on its pages of exceptions, whoever listened.
    std::vector<std::string> exceptions() const {
        std::vector<std::string> bodies;
        for (const record::RecordedLine& line : record::load_recording(recording)) {
            const std::string body(protocol::unframe(line.bytes, protocol::ChecksumPolicy::required).body);
            if (line.from == record::RecordedLine::From::board && body.starts_with("L18 P26")) {
                bodies.push_back(body);
            }
        }
        return bodies;
    }
    /// A field's value as JSON.
    std::string value(const std::string& field) const {
        const Result result = ctl({"get", field, "--json"});
        CAPTURE(result.errors);
        REQUIRE(result.code == 0);
        return nlohmann::json::parse(result.out)["fields"][field].dump();
    }

    TemporaryFolder folder;
    std::string control = folder.file("control");
    std::string recording = folder.file("talk.jsonl");
    Program program;
    Peer peer;
};

TEST_CASE("run --fault: the printer breaks at its time, the screen is told, and it is mended") {
    Broken run({"jam:at=1h", "thermistor_short:at=2h"});
    CHECK(run.value("faults.jam") == "false");
    REQUIRE(run.ctl({"advance", "90min"}).code == 0);
    CHECK(run.value("faults.jam") == "true");
    CHECK(run.value("faults.thermistor_short") == "false");
    REQUIRE(run.ctl({"advance", "31min"}).code == 0);
    CHECK(run.value("faults.thermistor_short") == "true");
    CHECK(run.exceptions() == std::vector<std::string>{"L18 P26 S4"});
    CHECK(run.ctl({"fault", "remove", "jam"}).code == 0);
    CHECK(run.value("faults.jam") == "false");
    CHECK(run.ctl({"fault", "clear"}).code == 0);
    CHECK(run.value("faults.thermistor_short") == "false");
    run.peer.lines().drop();
    CHECK(contains(run.peer.ask("M104 S200", "/200.0"), "L2 B:"));
    CHECK(run.program.stop() == 0);
}

TEST_CASE("run --fault: a card pulled out, together with a fault of the line") {
    Broken run({"card_removed:at=1h", "delay:to_screen,time=5ms"});
    REQUIRE(run.ctl({"do", "job.select", R"({"name": "testpattern.gcode"})"}).code == 0);
    REQUIRE(run.ctl({"advance", "61min"}).code == 0);
    CHECK(run.exceptions() == std::vector<std::string>{"L18 P26 S1"});
    CHECK(run.value("card.usable") == "false");
    CHECK(run.ctl({"world", "card", "in"}).code == 0);
    CHECK(run.value("card.usable") == "true");
    CHECK(run.value("faults.card_removed") == "false");
}

TEST_CASE("run --fault: what is wrong with a fault of the printer is a sentence, before anything runs") {
    check_mistakes({
        {{"run", "--fault", "jamm"}, usage, "did you mean \"jam\"?"},
        {{"run", "--fault", "heater_dead:heater=chamber"}, usage, "chamber"},
        {{"run", "--fault", "jam:at=soon"}, usage, "soon"},
    });
}

}  // namespace
}  // namespace fauxboard::e2e
