// `run --script` as its users have it: exit codes, files, parameters, a screen on a real pseudo-terminal.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/e2e/program.h"
#include "tests/e2e/xml.h"

namespace fauxboard::e2e {
namespace {

constexpr int interrupted = 7;

std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A scenario in a file of its own.
struct Script {
    explicit Script(std::string_view json, std::string_view name = "test.json")
        : file(folder.file(std::string(name))) {
        std::ofstream(file) << json;
    }
    Args args(Args more = {}) const {
        more.insert(more.begin(), {"run", "--script", file});
        return more;
    }
    TemporaryFolder folder;
    std::string file;
};

TEST_CASE("a shipped scenario passes in virtual time, with a screen in the process and reports in files") {
    const TemporaryFolder folder;
    const Result result =
        run({"run", "--script", "leveling-session", "--speed", "max", "-q", "--junit", folder.file("out.xml"),
             "--report", folder.file("out.json"), "--record", folder.file("talk.jsonl")});
    CAPTURE(result.errors);
    CHECK(result.code == 0);
    CHECK(contains(result.out, R"(ready {"profile":"geeetech-a30t","link":"screen","path":"in-process"})"));
    CHECK(contains(result.errors, "leveling-session passed: "));
    const std::string xml = read(folder.file("out.xml"));
    CHECK(xml_trouble(xml) == "");
    CHECK(contains(xml, "failures=\"0\""));
    CHECK(contains(xml, "classname=\"scenario.leveling-session\""));
    const auto report = nlohmann::json::parse(read(folder.file("out.json")));
    CHECK(report["verdict"] == "passed");
    CHECK(report["screen"] == "geeetech-a30t");
    CHECK(report["recording"] == folder.file("talk.jsonl"));
    CHECK(report["state"]["leveling.auto"] == false);
    CHECK(contains(read(folder.file("talk.jsonl")), R"("from": "screen")"));
}

TEST_CASE("what a scenario does to the machine stands in its recording, and a replay does it again") {
    const Script script(R"({"name": "test", "steps": [
        {"wait": "5s"}, {"do": "filament in"}, {"do": {"heater.target": {"heater": "bed", "c": "60C"}}},
        {"request": "M105"}, {"expect": "^L2 B:[0-9.]* /60\\.0", "within": "5s"}]})");
    const std::string talk = script.folder.file("talk.jsonl");
    REQUIRE(run(script.args({"--speed", "max", "-q", "--record", talk})).code == 0);
    const std::string recorded = read(talk);
    CHECK(contains(recorded, R"("from": "world", "do": "filament in"})"));
    CHECK(contains(recorded, R"("do": "{\"heater.target\":{\"heater\":\"bed\",\"c\":60.0}}"})"));
    const Result again = run({"replay", talk});
    CHECK(again.code == 0);
    CHECK(contains(again.out, "/60.0 "));
}

TEST_CASE("exit codes: passed, failed, a wait in vain, a wrong file, ended before its time") {
    const auto code = [](std::string_view steps, Args more = {}) {
        const Script script(R"({"name": "test", "steps": )" + std::string(steps) + "}");
        more.insert(more.end(), {"--speed", "max", "-q"});
        return run(script.args(std::move(more)));
    };
    CHECK(code(R"([{"wait": "1s"}])").code == 0);
    const Result wrong_now = code(R"([{"check": {"job.status": 1}, "why": "it prints"}])");
    CHECK(wrong_now.code == failed);
    CHECK(contains(wrong_now.errors,
                   "test failed after 0 ms: \"it prints\" is not so: expected job.status to be 1 now; "
                   "job.status is 0 ("));
    const Result in_vain = code(R"([{"wait": {"event": "motion.homed"}, "within": "5s"}])");
    CHECK(in_vain.code == timed_out);
    CHECK(contains(in_vain.errors, "test timed out after 5 s: waited in vain for the event motion.homed"));
    CHECK(contains(in_vain.errors, "What passed last:\n"));
    const Result wrong = code(R"([{"wait": "5"}])");
    CHECK(wrong.code == bad_input);
    CHECK(wrong.out.empty());
    CHECK(contains(wrong.errors,
                   "test.json:1: /steps/0/wait: found the text \"5\"; expected a time with its unit"));
    const Result early = code(R"([{"wait": "1h"}])", {"--duration", "5s"});
    CHECK(early.code == interrupted);
    CHECK(contains(early.errors,
                   "test was ended by --duration after 5 s, in the step \"wait for 1 h to pass\""));
    CHECK(code(R"([{"wait": "1s"}])", {"--junit", "/nowhere/at/all.xml"}).code == bad_input);
}

TEST_CASE("mistakes of the command line") {
    check_mistakes(
        {{{"run", "--screen", "geeetech-a30t"}, usage, "--screen requires --script"},
         {{"run", "--script", "soak", "--screen", "geeetech-a30t", "--pty"},
          usage,
          "--pty excludes --screen"},
         {{"run", "--script", "soak", "--param", "rounds"}, usage, "expected name=value"},
         {{"run", "--script", "soack"}, bad_input, "did you mean \"soak\"?"},
         {{"run", "--script", "soak", "--param", "round=1"}, bad_input, "did you mean \"rounds\"?"},
         {{"run", "--script", "leveling-session", "--pty"}, bad_input, "\"press\" needs a virtual screen"},
         {{"run", "--script", "./nothing.json"}, bad_input, "no such file"}});
}

TEST_CASE("parameters from the command line; --json ends with the whole outcome") {
    const Script script(R"({"name": "test", "parameters": {
            "long": {"default": "1s", "help": "how long"}, "n": {"default": 1, "help": "how often"}},
        "steps": [{"repeat": "${n}", "steps": [{"wait": "${long}"}]}]})");
    const Result result =
        run(script.args({"--speed", "max", "--json", "--param", "long=2s", "--param", "n=3"}));
    CHECK(result.code == 0);
    const std::string last = result.out.substr(result.out.rfind('\n', result.out.size() - 2) + 1);
    const auto outcome = nlohmann::json::parse(last);
    CHECK(outcome["verdict"] == "passed");
    CHECK(outcome["t"] == 6.0);
    CHECK(outcome["parameters"]["long"] == "2s");
    CHECK(outcome["parameters"]["n"] == 3);
}

TEST_CASE("a screen at the other end of a real pseudo-terminal is waited for, and answered") {
    const Script script(R"({"name": "test", "steps": [
        {"wait": {"request": "^M104 S(?P<target>[0-9]+)$"}, "within": "10min"},
        {"send": {"line": "L14 you asked for ${target}"}},
        {"wait": {"request": "^M106 P0 S255"}, "within": "10min"}]})");
    Program program(script.args({"--pty", "-q"}));
    Peer peer(program.ready()["path"]);
    CHECK(contains(peer.ask("M104 S222", "you asked"), "L14 you asked for 222"));
    peer.say(frame("M106 P0 S255"));
    CHECK(program.wait() == 0);
    CHECK(contains(program.errors(), "test passed: 3 steps in "));
}

TEST_CASE("SIGTERM in the middle: it says where it was, and leaves its reports") {
    const Script script(R"({"name": "test", "steps": [
        {"note": "now"}, {"wait": "24h", "why": "a day passes"}, {"note": "then"}]})");
    Program program(script.args({"--pty", "--junit", script.folder.file("out.xml")}));
    Peer peer(program.ready()["path"]);
    peer.ask("M105", "L2 ");
    program.signal(SIGTERM);
    CHECK(program.wait() == interrupted);
    CHECK(contains(program.errors(), "test was ended by SIGTERM after "));
    CHECK(contains(program.errors(), "in the step \"a day passes\" ("));
    const std::string xml = read(script.folder.file("out.xml"));
    CHECK(xml_trouble(xml) == "");
    CHECK(contains(xml, "skipped=\"2\""));
}

TEST_CASE("check and describe know scenarios") {
    CHECK(run({"check", "soak", "power-loss"}).out == "soak: ok\npower-loss: ok\n");
    const Script script(R"({"$schema": "scenario.schema.json", "name": "x", "steps": [{"wait": "5"}]})");
    const Result wrong = run({"check", script.file});
    CHECK(wrong.code == failed);
    CHECK(contains(wrong.out, ":1: /steps/0/wait: found the text \"5\""));
    CHECK(contains(run({"describe", "scenarios"}).out, "expect_next"));
}

}  // namespace
}  // namespace fauxboard::e2e
