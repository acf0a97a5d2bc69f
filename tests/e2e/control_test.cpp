// `run --control` and `ctl` as their users have them.

#include <sys/stat.h>

#include <csignal>
#include <fstream>

#include "emulator/link/local_path.h"
#include "tests/e2e/program.h"

namespace fauxboard::e2e {
namespace {

namespace fs = std::filesystem;

struct Live {
    explicit Live(const Args& more = {}) : program(with(control, more)), where(program.ready()) {
        CHECK(where["control"] == control);
    }
    static Args with(const std::string& control, const Args& more) {
        Args args{"run", "--no-pacing", "-q", "--control", control};
        args.insert(args.end(), more.begin(), more.end());
        return args;
    }
    Result ctl(Args words) const {
        words.insert(words.begin(), {"ctl", control});
        return run(words);
    }
    /// The answer to a --json request.
    nlohmann::json json(Args words) const {
        words.emplace_back("--json");
        const Result result = ctl(std::move(words));
        CAPTURE(result.errors);
        CHECK(result.code == 0);
        return nlohmann::json::parse(result.out, nullptr, false);
    }

    TemporaryFolder folder;
    std::string control = folder.file("control");
    Program program;
    nlohmann::json where;
};

TEST_CASE("set, get, do, world, send, advance, status: what ctl does is seen on the line") {
    Live live;
    Peer peer(live.where["path"]);
    CHECK(contains(peer.ask("M104 S111", "/111.0"), "L2 B:"));
    const Result set = live.ctl({"set", "heaters.nozzle.target=205", "heaters.bed.target=60"});
    CHECK(set.code == 0);
    CHECK(set.out == "heaters.nozzle.target  205 C\nheaters.bed.target     60 C\n");
    CHECK(contains(peer.ask("M105", "/205.0"), "/60.0"));
    CHECK(live.ctl({"get", "heaters.nozzle.target"}).out == "heaters.nozzle.target  205 C\n");
    CHECK(live.json({"get", "heaters"})["fields"]["heaters.bed.target"] == 60.0);
    CHECK(live.ctl({"do", "heater.target", R"({"heater": "nozzle", "c": 190})"}).code == 0);
    CHECK(live.ctl({"world", "filament", "in"}).code == 0);
    CHECK(live.ctl({"send", "--line", "L18 P1 S2"}).code == 0);
    CHECK(contains(peer.lines().find("L18 P1 S2"), "N-0 L18 P1 S2*"));
    CHECK(live.ctl({"send", "L2"}).code == 0);
    CHECK(contains(peer.lines().find("/190.0"), "L2 B:"));
    const nlohmann::json advanced = live.json({"advance", "10min"});
    CHECK(advanced["t"] >= 600.0);
    CHECK(live.json({"get", "heaters.bed.true"})["fields"]["heaters.bed.true"] > 55.0);
    CHECK(contains(live.ctl({"status"}).out, "profile: geeetech-a30t\n"));
    CHECK(live.json({"status"})["t"] >= 600.0);
    CHECK(contains(peer.ask("M104 S123", "/123.0"), "L2 B:"));
}

TEST_CASE("quit ends the run and removes the socket; so do signals") {
    Live live;
    CHECK(live.ctl({"quit"}).code == 0);
    CHECK(live.program.wait() == 0);
    CHECK_FALSE(fs::exists(live.control));
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        Live other;
        struct stat found {};
        REQUIRE(::lstat(other.control.c_str(), &found) == 0);
        CHECK(S_ISSOCK(found.st_mode));
        CHECK((found.st_mode & 07777U) == 0600U);
        other.program.signal(number);
        CHECK(other.program.wait() == 0);
        CHECK_FALSE(fs::exists(other.control));
    }
}

TEST_CASE("a socket in use is refused, one of a killed program replaced, a file left alone") {
    Live live;
    const Result second = run({"run", "--control", live.control});
    CHECK(second.code == no_port);
    CHECK(contains(second.errors, "is in use"));
    CHECK(live.ctl({"status"}).code == 0);
    live.program.signal(SIGKILL);
    CHECK(live.program.wait() == 1000 + SIGKILL);
    CHECK(fs::exists(live.control));
    const Result dead = live.ctl({"status"});
    CHECK(dead.code == no_port);
    CHECK(contains(dead.errors, "Nobody listens on"));
    Program next({"run", "--control", live.control});
    next.ready();
    CHECK(live.ctl({"status"}).code == 0);
    CHECK(next.stop() == 0);
    const std::string file = live.folder.file("precious");
    std::ofstream(file) << "data";
    const Result refused = run({"run", "--control", file});
    CHECK(refused.code == no_port);
    CHECK(contains(refused.errors, "is not a socket"));
    CHECK(fs::file_size(file) == 4);
}

TEST_CASE("each no has its exit code and its sentence") {
    Live live;
    const std::vector<Mistake> all{
        {{"get", "heaters.nozle"}, failed, "Did you mean \"heaters.nozzle\"?"},
        {{"set", "heaters.nozzle.target=2000"}, failed, "expected 0 to 1000 C"},
        {{"set", "heaters.nozzle.true=20"}, failed, "can be read but not set"},
        {{"set", "heaters.nozzle.target=warm"}, failed, "expected a number"},
        {{"set", "heaters.nozzle.target"}, usage, "FIELD=VALUE"},
        {{"set"}, usage, "FIELD=VALUE"},
        {{"do", "motion.hom"}, failed, "Did you mean \"motion.home\"?"},
        {{"do", "heater.target", "{"}, usage, "no JSON object"},
        {{"world", "filament", "inn"}, failed, "Did you mean \"filament in\"?"},
        {{"send", "L2x"}, failed, "no frame \"L2x\""},
        {{"advance", "5parsec"}, failed, "200ms"},
        {{"fault", "remove", "x"}, failed, "There is no fault \"x\""},
        {{"fault"}, usage, "a command is missing; known: list"},
        {{"watch", "heaters.nozle"}, failed, "no field"},
        {{"frobnicate"}, usage, "there is no command 'frobnicate'"},
        {{"get", "--jsn"}, usage, "get: there is no option '--jsn'; did you mean '--json'?"},
        {{}, usage, "a command is missing; known: get"},
    };
    for (const Mistake& wrong : all) {
        const Result result = live.ctl(wrong.args);
        CAPTURE(wrong.says);
        CAPTURE(result.errors);
        CHECK(result.code == wrong.code);
        CHECK(contains(result.errors, wrong.says));
        CHECK(result.out.empty());
    }
    CHECK(run({"ctl", live.folder.file("none"), "status"}).code == no_port);
    CHECK(live.ctl({"status"}).code == 0);
}

TEST_CASE("watch: what passes on the line, and what changes") {
    Live live;
    Peer peer(live.where["path"]);
    CHECK(contains(peer.ask("M104 S111", "/111.0"), "L2 B:"));
    Program watch({"ctl", live.control, "watch", "heaters.nozzle.target", "--traffic", "--every", "10ms"});
    CHECK(contains(watch.out().find("heaters.nozzle.target = "), "heaters.nozzle.target = 111 C"));
    peer.say(frame("M104 S222"));
    CHECK(contains(watch.out().find("-> N-0 M104 S222"), "-> N-0 M104 S222"));
    CHECK(contains(watch.out().find("target = 222"), "heaters.nozzle.target = 222 C"));
    CHECK(live.ctl({"quit"}).code == 0);
    CHECK(watch.wait() == 0);
}

TEST_CASE("ctl tells silence from an end") {
    const TemporaryFolder folder;
    const std::string name = folder.file("silent");
    link::LocalPath path;
    const UniqueFd fd = path.listen(name);
    const Result silent = run({"ctl", name, "status", "--timeout", "50"});
    CHECK(silent.code == timed_out);
    CHECK(contains(silent.errors, "No answer from " + name));
    Live live({"--duration", "1h"});
    const Result ended = live.ctl({"advance", "2h"});
    CHECK(ended.code == failed);
    CHECK(contains(ended.errors, "The run ended before this was done."));
    CHECK(live.program.wait() == 0);
}

}  // namespace
}  // namespace fauxboard::e2e
