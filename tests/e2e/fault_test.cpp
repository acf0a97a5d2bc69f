// `run --fault` and `tap --fault`: a line that misbehaves, as the user of the real program has it.

#include <fstream>
#include <sstream>

#include "emulator/fault/faults.h"
#include "emulator/fault/kind.h"
#include "emulator/record/recording.h"
#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

using fault::Direction;
using fault::SimTime;

Args with_faults(Args args, const std::vector<std::string>& faults) {
    for (const std::string& spec : faults) {
        args.emplace_back("--fault");
        args.push_back(spec);
    }
    return args;
}

Args run_args(const std::vector<std::string>& faults) {
    return with_faults({"run", "--no-pacing", "-q"}, faults);
}

bool right(const std::string& line) {
    return protocol::unframe(line, protocol::ChecksumPolicy::required).fault == protocol::FrameFault::none;
}

std::string request(int target) {
    return frame("M104 S" + std::to_string(target));
}

std::string answer(int target) {
    return "/" + std::to_string(target) + ".0";
}

/// What a fault that has nothing to do with time makes of these bytes.
std::string spoiled(std::string_view spec, Direction direction, std::string_view bytes) {
    fault::FaultLine line(direction);
    line.add(SimTime{0}, fault::fault_from_text(spec));
    line.push(SimTime{0}, bytes);
    return std::string(line.output());
}

std::vector<std::string> lines_of(const std::string& bytes) {
    std::vector<std::string> out;
    std::istringstream in(bytes);
    for (std::string line; std::getline(in, line);) {
        if (line.ends_with('\r')) {
            line.pop_back();
        }
        out.push_back(line);
    }
    return out;
}

/// The board's status comes at any time, but not as the answer to a new target.
constexpr int first_target = 101;
constexpr int requests = 40;
constexpr int last_target = 250;

/// Which of forty requests are answered by a board behind a line with that fault. Afterwards it is asked
/// until it answers, which ends the test of a fault that swallows lines by chance.
std::vector<int> answered(const std::string& fault) {
    Program program(run_args({fault}));
    Peer peer(program.ready()["path"]);
    std::string bytes;
    for (int i = 0; i < requests; ++i) {
        bytes += request(first_target + i);
    }
    for (int i = 0; i < requests; ++i) {
        bytes += request(last_target);
    }
    peer.say(bytes);
    std::vector<int> out;
    for (std::string line = peer.lines().next(); !contains(line, answer(last_target));
         line = peer.lines().next()) {
        REQUIRE(line.starts_with("N-0 "));
        for (int i = 0; i < requests; ++i) {
            if (contains(line, answer(first_target + i)) && (out.empty() || out.back() != first_target + i)) {
                out.push_back(first_target + i);
            }
        }
    }
    return out;
}

TEST_CASE("a wrong fault is a sentence, with exit code 2, for run and for tap") {
    const std::pair<const char*, const char*> wrong[] = {
        {"dorp:every=2", "did you mean \"drop\"?"},
        {"", "found no kind; expected one of drop, garble"},
        {"drop:to_bord", "did you mean \"to_board\"?"},
        {"drop:evry=2", "did you mean \"every\"?"},
        {"drop:every=0", "every: found \"0\"; expected a whole number from 1 to"},
        {"drop:every=2,every=3", "every is given twice"},
        {"slow:rate=9", "rate: found \"9\"; expected a rate from"},
        {"delay:time=200", "expected a time from 0s to 60s with its unit, such as \"200ms\""},
        {"drop:at=1s,every=2", "expected only one of them"},
        {"garble:probability=2", "expected a number from 0 to 1"},
        {"drop:line=usbb", "did you mean \"usb\"?"},
        {"drop:line=usb", "there is no USB side here"}};
    for (const auto& [spec, sentence] : wrong) {
        for (const Args& args : {Args{"run", "--fault", spec}, Args{"tap", "pty", "pty", "--fault", spec}}) {
            const std::string text = spec;
            CAPTURE(text);
            const Result result = run(args);
            CAPTURE(result.errors);
            CHECK(result.code == 2);
            CHECK(contains(result.errors, sentence));
            CHECK(result.out.empty());
        }
    }
    CHECK(run({"run", "--fault"}).code == 2);
}

TEST_CASE("every fault of the line to the screen is seen at the screen's end") {
    const std::pair<const char*, bool (*)(const std::string&, const std::string&)> kinds[] = {
        {"garble:to_screen", [](const std::string& a, const std::string&) { return !right(a); }},
        {"cut:to_screen,bytes=2", [](const std::string& a, const std::string&) { return !right(a); }},
        {"wrong_checksum:to_screen",
         [](const std::string& a, const std::string&) {
             return protocol::unframe(a, protocol::ChecksumPolicy::required).fault ==
                    protocol::FrameFault::checksum_wrong;
         }},
        {"duplicate:to_screen",
         [](const std::string& a, const std::string& b) { return right(a) && a == b; }},
        {"nul_burst:to_screen,bytes=3",
         [](const std::string& a, const std::string&) {
             return a.starts_with(std::string(3, '\0') + "N-0");
         }},
        {"merge:to_screen,every=3", [](const std::string& a, const std::string& b) {
             return contains(a.substr(1), "N-0 ") && !contains(b.substr(1), "N-0 ");
         }}};
    for (const auto& [spec, seen] : kinds) {
        const std::string text = spec;
        CAPTURE(text);
        Program program(run_args({spec}));
        Peer peer(program.ready()["path"]);
        peer.lines().next();
        peer.lines().next();
        for (int i = 0; i < 4; ++i) {
            const std::string first = peer.lines().next();
            const std::string second = peer.lines().next();
            CAPTURE(first);
            CAPTURE(second);
            CHECK(seen(first, second));
        }
        CHECK(program.stop() == 0);
        CHECK(contains(program.errors(), "Fault 1, " + text + ", acted "));
    }
}

TEST_CASE("lines lost on the way to the screen: the boot messages, at the places that the seed says") {
    const auto codes = [](const std::string& fault, std::size_t count) {
        Program program(run_args({fault}));
        Peer peer(program.ready()["path"]);
        std::vector<std::string> out;
        while (out.size() < count) {
            const std::string line = peer.lines().next();
            REQUIRE(right(line));
            out.push_back(line.substr(4, line.find(' ', 4) - 4));
        }
        return out;
    };
    const std::string fault = "drop:to_screen,probability=0.5,seed=3";
    const auto boot = codes("drop:to_screen,probability=0", 16);
    std::string burst;
    for (const std::string& code : boot) {
        burst += code + "\n";
    }
    const auto left = lines_of(spoiled(fault, Direction::to_screen, burst));
    CHECK(left.size() > 4);
    CHECK(left.size() < 12);
    CHECK(codes(fault, left.size()) == left);
    CHECK(codes(fault, left.size()) == left);
}

TEST_CASE("the same seed swallows the same requests, another seed others") {
    const std::string fault = "drop:to_board,probability=0.4,seed=5";
    std::string bytes;
    for (int i = 0; i < requests; ++i) {
        bytes += request(first_target + i);
    }
    std::vector<int> expected;
    const std::string left = spoiled(fault, Direction::to_board, bytes);
    for (int i = 0; i < requests; ++i) {
        if (contains(left, request(first_target + i))) {
            expected.push_back(first_target + i);
        }
    }
    CHECK(expected.size() > 10);
    CHECK(expected.size() < 35);
    CHECK(answered(fault) == expected);
    CHECK(answered(fault) == expected);
    CHECK(answered("drop:to_board,probability=0.4,seed=6") != expected);
    CHECK(answered("drop:to_board,probability=0").size() == requests);
}

TEST_CASE("a fault of any kind, in both directions, ends; then the board answers, and its deeds are told") {
    for (const fault::Kind* kind : fault::kinds()) {
        if (kind->name == "disconnect") {
            continue;  // below
        }
        const bool dead = kind->interrupt != nullptr;
        const std::string spec = std::string(kind->name) + (dead ? ":every=1,count=1,for=1ms" : ":count=2");
        CAPTURE(spec);
        Program program(run_args({spec}));
        Peer peer(program.ready()["path"]);
        // Asked again and again: what is lost is lost.
        std::string line;
        peer.say(request(110));
        for (int i = 0; i < 100 && !(right(line) && contains(line, answer(111))); ++i) {
            peer.say(request(111));
            line = peer.lines().next();
        }
        CHECK(contains(line, answer(111)));
        CHECK(right(line));
        CHECK(program.stop() == 0);
        CAPTURE(program.errors());
        CHECK(contains(program.errors(), dead ? ", acted once on 1 line in each direction."
                                              : ", acted 2 times on 2 lines in each direction."));
    }
}

TEST_CASE("a request that a fault swallows is not answered, the next one is; the end names what was done") {
    Program program(run_args({"drop:to_board,count=1"}));
    Peer peer(program.ready()["path"]);
    peer.say(request(111));
    std::string line;
    for (peer.say(request(112)); !contains(line, answer(112)); line = peer.lines().next()) {
        REQUIRE_FALSE(contains(line, answer(111)));
    }
    CHECK(program.stop() == 0);
    CHECK(contains(program.errors(), "Fault 1, drop:to_board,count=1, acted once on 1 line."));
}

TEST_CASE("a disconnection takes the pty away and brings it back under its name; the board works on") {
    const TemporaryFolder folder;
    const std::string name = folder.file("screen");
    Program program({"run", "--no-pacing", "--json", "--pty=" + name, "--fault",
                     "disconnect:to_board,after=1,count=1,for=50ms"});
    program.ready();
    {
        Peer peer(name);
        CHECK(contains(peer.ask("M104 S111", answer(111)), "L2 "));
        peer.say(request(112));
        CHECK(peer.lines().find("(end)") == "(end)");
    }
    CHECK(contains(program.out().find("a fault disconnects the line"), "\"link\": \"waiting\""));
    CHECK(contains(program.out().find("the line is connected again"), name));
    Peer peer(name);
    CHECK(contains(peer.ask("M104 S113", answer(113)), "L2 "));
    CHECK(program.stop() == 0);
    CHECK(contains(program.errors(), ", acted once on 2 lines."));
    CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(name)));
}

TEST_CASE("a fault is on the line that was asked for, and where both were it says on which it was") {
    for (const char* profile : {"marlin", "geeetech-a30t"}) {
        CAPTURE(profile);
        Program alone(
            {"run", "-q", "--profile", profile, "--host-pty", "--fault", "garble:to_board,every=2"});
        Peer host(alone.ready()["host"]["path"]);
        host.say("N0 M110 N0*125\nN1 M105*38\n");
        CHECK(contains(host.lines().find("Resend:"), "Resend: 1"));
        CHECK(alone.stop() == 0);
    }
    Program both({"run", "-q", "--pty", "--host-pty", "--fault", "garble:to_board,every=2"});
    both.ready();
    CHECK(both.stop() == 0);
    CHECK(contains(both.errors(), "never acted. It was for the main line; line=usb is the USB side.\n"));
}

TEST_CASE("the USB side has faults of its own, and the main line none of them") {
    const TemporaryFolder folder;
    Program program({"run", "--no-pacing", "-q", "--host-pty", "--control=" + folder.file("ctl"), "--fault",
                     "garble:to_board,every=2,line=usb", "--fault", "drop:to_board,count=1,line=main"});
    const auto ready = program.ready();
    Peer screen(ready["path"]);
    Peer host(ready["host"]["path"]);
    host.say("N0 M110 N0*125\nN1 M105*38\n");
    CHECK(host.lines().find("ok") == "ok");
    CHECK(contains(host.lines().find("Error:"), "Error:"));
    screen.say(request(111));
    CHECK(contains(screen.ask("M104 S112", answer(112)), "L2 "));
    const Result list = run({"ctl", folder.file("ctl"), "--json", "fault", "list"});
    CHECK(contains(list.out, "\"line\":\"usb\""));
    CHECK(run({"ctl", folder.file("ctl"), "fault", "remove", "1"}).code == 0);
    CHECK(run({"ctl", folder.file("ctl"), "fault", "add", "silence:line=usb,from=0s,for=1ms"}).code == 0);
    CHECK(run({"ctl", folder.file("ctl"), "fault", "clear"}).code == 0);
    host.say("N0 M110 N0*125\nN1 M105*38\n");
    CHECK(contains(host.lines().find("ok T:"), "ok T:"));
    CHECK(program.stop() == 0);
    CHECK_FALSE(contains(program.errors(), "Fault "));
}

TEST_CASE("a disconnection of the USB side takes that pty away and brings it back; the main line stays") {
    const TemporaryFolder folder;
    const std::string name = folder.file("usb");
    Program program({"run", "--no-pacing", "--json", "--host-pty=" + name, "--fault",
                     "disconnect:to_board,after=1,count=1,for=50ms,line=usb"});
    const auto ready = program.ready();
    Peer screen(ready["path"]);
    {
        Peer host(name);
        host.say("M105\n");
        CHECK(contains(host.lines().find("ok T:"), "ok T:"));
        host.say("M105\n");
        CHECK(host.lines().find("(end)") == "(end)");
    }
    CHECK(contains(program.out().find("the line is connected again"), name));
    Peer host(name);
    host.say("M105\n");
    CHECK(contains(host.lines().find("ok T:"), "ok T:"));
    CHECK(contains(screen.ask("M104 S113", answer(113)), "L2 "));
    CHECK(program.stop() == 0);
    CHECK(contains(program.errors(), "line=usb"));
}

TEST_CASE("tap: the line between a board and a screen misbehaves, both ways, and recovers") {
    const TemporaryFolder folder;
    Program board({"run", "--no-pacing", "-q"});
    const std::string path = board.ready()["path"];
    Program tap(with_faults({"tap", "pty", path, "-q", "--board", "B", "--record", folder.file("tap.jsonl")},
                            {"drop:to_board,count=1", "wrong_checksum:to_screen,count=5"}));
    Peer peer(tap.ready()["a"]["path"]);
    for (int i = 0; i < 5; ++i) {
        CHECK_FALSE(right(peer.lines().next()));
    }
    CHECK(right(peer.lines().next()));
    peer.say(request(111));
    std::string line;
    for (peer.say(request(112)); !contains(line, answer(112)); line = peer.lines().next()) {
        REQUIRE_FALSE(contains(line, answer(111)));
    }
    CHECK(right(line));
    CHECK(tap.stop() == 0);
    CHECK(contains(tap.errors(), "Fault 1, drop:to_board,count=1, acted once on 1 line."));
    CHECK(contains(tap.errors(), "Fault 2, wrong_checksum:to_screen,count=5, acted 5 times on 5 lines."));
    // Recorded is what the board said and got, and what the faults did to it.
    int deeds = 0;
    for (const record::RecordedLine& recorded : record::load_recording(folder.file("tap.jsonl"))) {
        if (recorded.from == record::RecordedLine::From::fault) {
            ++deeds;
            continue;
        }
        CHECK(right(recorded.bytes));
        CHECK_FALSE(contains(recorded.bytes, "M104 S111"));
    }
    CHECK(deeds == 6);
    CHECK(board.stop() == 0);
}

TEST_CASE("the virtual screen tells a line that loses its request from one that works") {
    const std::pair<const char*, int> lines[] = {{"drop:to_board,after=2", 1}, {"duplicate:to_screen", 0}};
    for (const auto& [fault, code] : lines) {
        Program board(run_args({fault}));
        const std::string path = board.ready()["path"];
        const Result press = run({"screen", "--port", path, "press", "Hotend on"});
        CAPTURE(press.errors);
        CHECK(press.code == code);
    }
}

}  // namespace
}  // namespace fauxboard::e2e
