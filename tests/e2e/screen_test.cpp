// `fauxboard screen` as its user has it: the real program against the real board's program.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "emulator/host/screen_files.h"
#include "emulator/record/recording.h"
#include "tests/e2e/program.h"
#include "tests/e2e/xml.h"

namespace fauxboard::e2e {
namespace {

/// Also where time is no matter: only a clock that runs ahead makes the screen patient with a busy computer.
const std::string fast = "100";

/// A board without pacing on a pty, so fast that a tour of an hour takes half a minute.
struct Board {
    explicit Board(const std::string& profile)
        : program({"run", "--no-pacing", "-q", "--profile", profile, "--speed", fast}),
          path(program.ready()["path"]) {}
    Program program;
    std::string path;
};

std::string read_file(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// What stands on stderr beside how far a slow tour has got: "  52 of 186  Control/Home".
std::string without_progress(const std::string& errors, const std::string& buttons) {
    std::istringstream in(errors);
    std::string out;
    for (std::string line; std::getline(in, line);) {
        out += contains(line, " of " + buttons + "  ") ? "" : line + "\n";
    }
    return out;
}

TEST_CASE("the tour presses every button of the screen, and the board meets every expectation") {
    for (const std::string& name : {std::string("geeetech-a30t"), std::string("geeetech-a30")}) {
        CAPTURE(name);
        const TemporaryFolder folder;
        const Board board(name);
        const std::string buttons = std::to_string(host::load_screen_by_name(name)->buttons.size());
        const Result tour = run({"screen", "--port", board.path, "--screen", name, "--speed", fast, "tour",
                                 "--junit", folder.file("tour.xml")});
        INFO(tour.out);
        CHECK(without_progress(tour.errors, buttons) == "");
        CHECK(tour.code == 0);
        CHECK(
            contains(tour.out, "\n" + buttons + " buttons: " + buttons + " met, 0 not met, 0 not pressed\n"));
        const std::string junit = read_file(folder.file("tour.xml"));
        CHECK(xml_trouble(junit) == "");
        CHECK(count_of(junit, "<testcase ") == std::stoul(buttons));
        CHECK(contains(junit, "tests=\"" + buttons + "\" failures=\"0\""));
    }
}

/// What one side said, of a recording.
std::vector<std::string> said(const std::string& file, record::RecordedLine::From side) {
    std::vector<std::string> lines;
    for (const record::RecordedLine& line : record::load_recording(file)) {
        if (line.from == side) {
            lines.push_back(line.bytes);
        }
    }
    return lines;
}

TEST_CASE("the tour passes with a tap in between, which records all that either side said") {
    const TemporaryFolder folder;
    Program board({"run", "--no-pacing", "-q", "--speed", fast, "--record", folder.file("board.jsonl")});
    const std::string path = board.ready()["path"];
    Program tap({"tap", path, "pty", "--board", "A", "-q", "--record", folder.file("tap.jsonl")});
    const std::string other_end = tap.ready()["b"]["path"];
    const Result tour = run({"screen", "--port", other_end, "--speed", fast, "tour"});
    INFO(tour.out);
    CHECK(tour.code == 0);
    CHECK(tap.stop() == 0);
    CHECK(board.stop() == 0);
    using From = record::RecordedLine::From;
    CHECK(said(folder.file("tap.jsonl"), From::screen) == said(folder.file("board.jsonl"), From::screen));
    // The tap came to a board that had been talking already, and left before it ended.
    const std::vector<std::string> passed = said(folder.file("tap.jsonl"), From::board);
    const std::vector<std::string> all = said(folder.file("board.jsonl"), From::board);
    CHECK(passed.size() > 400);
    CHECK(std::search(all.begin(), all.end(), passed.begin(), passed.end()) != all.end());
}

TEST_CASE("a board with one reply broken makes the tour fail with a sentence that names it") {
    const TemporaryFolder folder;
    write_file(
        folder.file("broken.json"),
        R"({"name": "broken", "extends": "geeetech-a30t", "requests": {"M2139": {"send": "L24.jerk"}}})");
    const Board board(folder.file("broken.json"));
    const Result tour = run({"screen", "--port", board.path, "--speed", fast, "tour", "--json", "--junit",
                             folder.file("tour.xml"), "--record", folder.file("talk.jsonl")});
    CHECK(tour.code == failed);
    const auto report = nlohmann::json::parse(tour.out);
    CHECK(report["passed"] == false);
    CHECK(report["not_pressed"] == 0);
    const auto& results = report["results"];
    const auto broken =
        std::find_if(results.begin(), results.end(), [](const auto& one) { return one["verdict"] != "met"; });
    REQUIRE(broken != results.end());
    CHECK((*broken)["button"] == "Setting/Add-on");
    CHECK((*broken)["sentence"] ==
          "Setting/Add-on: sent \"M2139\"; expected L23 within 0.5 s; came \"L24 P3 A7.00 B7.00 C0.50 "
          "D5.00\"");
    const std::string junit = read_file(folder.file("tour.xml"));
    CHECK(xml_trouble(junit) == "");
    CHECK(contains(junit, "<failure type=\"not met\" message=\"Setting/Add-on: sent &quot;M2139&quot;"));
    CHECK(count_of(junit, "<failure ") == report["not_met"].get<std::size_t>());
    const std::string talk = read_file(folder.file("talk.jsonl"));
    CHECK(contains(talk, "log Geeetech LCD OK"));
    CHECK(contains(talk, "L24 P3 A7.00"));
}

/// The words of a shell's line, some in double quotes.
std::vector<std::string> shell_words(const std::string& line) {
    std::vector<std::string> words(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ' ' && !quoted) {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

TEST_CASE("the buttons that the help's examples press are there, and do what they should") {
    const Board board("geeetech-a30t");
    const std::string help = run({"screen", "--help"}).out;
    const std::string start = "fauxboard screen --port /tmp/screen press ";
    int pressed = 0;
    for (std::size_t at = help.find(start); at != std::string::npos; at = help.find(start, at + 1)) {
        const std::string line = help.substr(at + start.size(), help.find('\n', at) - at - start.size());
        std::vector<std::string> call{"screen", "--port", board.path, "--speed", fast, "press"};
        const std::string buttons = line.substr(0, line.find("   "));  // what is behind says what it shows
        const std::vector<std::string> words = shell_words(buttons);
        call.insert(call.end(), words.begin(), words.end());
        const Result press = run(call);
        CAPTURE(buttons);
        INFO(press.out);
        CHECK(press.errors == "");
        CHECK(press.code == 0);
        ++pressed;
    }
    CHECK(pressed == 3);
}

TEST_CASE("press sends what the button sends, prints what comes back, and judges it") {
    const TemporaryFolder folder;
    const Board board("geeetech-a30t");
    const Result text = run({"screen", "--port", board.path, "--speed", fast, "press", "Hotend on",
                             "sound ON", "Screen lock PW=4321"});
    CHECK(text.code == 0);
    CHECK(contains(text.out, "screen → board  N-0 M104 S200"));
    CHECK(contains(text.out, "nozzle: target 200"));
    CHECK(contains(text.out, "board → screen  N-0 L2 B:"));
    CHECK(contains(text.out, "met: Control/Filament/Hotend on: sent \"M104 S200"));
    CHECK(contains(text.out, "N-0 M2139 P2 W4321*"));
    CHECK(contains(text.out, "met: Setting/Add-on/Screen lock PW=4321: sent "));
    CHECK_FALSE(contains(text.out, "log Geeetech"));  // before the first touch

    const Result json =
        run({"screen", "--port", board.path, "--speed", fast, "press", "--json", "-v", "Setting/About"});
    CHECK(json.code == 0);
    std::vector<nlohmann::json> lines;
    for (std::size_t at = 0; at < json.out.size(); at = json.out.find('\n', at) + 1)
        lines.push_back(nlohmann::json::parse(json.out.substr(at, json.out.find('\n', at) - at)));
    REQUIRE(!lines.empty());
    CHECK(lines.front()["line"] == "log Geeetech LCD OK");
    CHECK(lines.back()["button"] == "Setting/About");
    CHECK(lines.back()["verdict"] == "met");
}

TEST_CASE("what the screen does not take as it was meant is said as it comes") {
    const TemporaryFolder folder;
    write_file(folder.file("odd.json"), R"({"name": "odd", "extends": "geeetech-a30t",
        "frames": {"crash": "L3 PS:0 FN:a TM:0"},
        "requests": {"M2139": {"send": ["L23", "crash"]}}})");
    const Board board(folder.file("odd.json"));
    const Result text = run({"screen", "--port", board.path, "--speed", fast, "press", "Setting/Add-on"});
    CHECK(text.code == 0);
    CHECK(contains(text.out, "would crash: no \" PG:\" behind \"FN:\""));
    const Result json =
        run({"screen", "--port", board.path, "--speed", fast, "press", "--json", "Setting/Add-on"});
    CHECK(contains(json.out, R"("verdict":"would crash")"));
}

TEST_CASE("a button that cannot be pressed now, and an expectation that is not met, are exit code 1") {
    const Board board("geeetech-a30t");
    const Result shut = run({"screen", "--port", board.path, "--speed", fast, "press", "Exception/Continue"});
    CHECK(shut.code == failed);
    CHECK(contains(shut.errors, "Exception/Continue: not pressed: "));
    const TemporaryFolder folder;
    write_file(folder.file("mute.json"),
               R"({"name": "mute", "extends": "geeetech-a30t", "requests": {"M2139": {"send": null}}})");
    const Board mute(folder.file("mute.json"));
    const Result missing = run({"screen", "--port", mute.path, "--speed", fast, "press", "Sound on"});
    CHECK(missing.code == failed);
    INFO(missing.errors);
    CHECK(contains(missing.errors, "expected L23 where addons.sound is 1 within 0.5 s; came nothing"));
}

TEST_CASE("show opens a page, waits for its values, and prints it") {
    const Board board("geeetech-a30t");
    const Result jerk = run({"screen", "--port", board.path, "--speed", fast, "show", "jerk"});
    INFO(jerk.errors);
    CHECK(jerk.code == 0);
    CHECK(jerk.out ==
          "Jerk  (Control/Motion Param/Jerk)\n---------------------------------\n"
          "X 7.00   Y 7.00   Z 0.50   E 5.00 mm/s\n"
          "[Bar chart button]  [Main menu button]  [Return button]\n");
    const auto about = nlohmann::json::parse(
        run({"screen", "--port", board.path, "--speed", fast, "show", "--json", "About"}).out);
    CHECK(about["page"] == "Setting/About");
    CHECK(about["values"]["device.name"]["value"] == "GEEETECH-A30T");
    CHECK(about["values"]["device.name"]["told"] == true);
    CHECK(about["values"]["device.name"]["from"] == "L9");
    const auto files = nlohmann::json::parse(
        run({"screen", "--port", board.path, "--speed", fast, "show", "--json", "Printing"}).out);
    CHECK(files["values"]["files"]["value"].size() > 0);
}

TEST_CASE("a line on which nobody answers: a sentence, exit code 5") {
    const link::test::OtherPty silent;
    const UniqueFd held = link::test::open_terminal(silent.path);
    for (const Args& what :
         {Args{"tour"}, Args{"show"}, Args{"press", "Store settings"}, Args{"press", "Home all"}}) {
        Args args{"screen", "--port", silent.path, "--timeout", "20ms"};
        args.insert(args.end(), what.begin(), what.end());
        const Result result = run(args);
        CAPTURE(what[0]);
        CHECK(result.code == timed_out);
        CHECK(result.out == "");
        CHECK(contains(result.errors, "nothing came from the board on"));
        CHECK(contains(result.errors, silent.path));
    }
}

TEST_CASE("a board that goes away ends it: exit code 4") {
    Program board({"run", "--no-pacing", "--json"});
    const std::string path = board.ready()["path"];
    Program screen({"screen", "--port", path, "tour"});
    CHECK(contains(board.out().find("log Geeetech"), "LCD OK"));  // both are at work
    CHECK(board.stop() == 0);
    CHECK(screen.wait() == no_port);
}

TEST_CASE("each mistake has its exit code and its sentence") {
    const Args line{"screen", "--port", "/dev/ttyMISSING"};
    const auto with = [&](Args more) {
        more.insert(more.begin(), line.begin(), line.end());
        return more;
    };
    const link::test::OtherPty pty;
    const std::vector<Mistake> mistakes{
        {{"screen"}, usage, "a command is missing; known: press"},
        {{"screen", "tour"}, usage, "--port"},
        {with({"--tcp", ":1", "tour"}), usage, "--tcp"},
        {with({"frobnicate"}), usage, "there is no command 'frobnicate'"},
        {with({"press"}), usage, "BUTTON"},
        {with({"tour", "--speed", "max"}), usage, "cannot run at 'max'"},
        {with({"tour", "--timeout", "soon"}), usage, "expected 500ms"},
        {with({"tour", "--screen", "geeetech-a30x"}), bad_input, "did you mean \"geeetech-a30"},
        {with({"tour", "--screen", "/missing.json"}), bad_input, "/missing.json"},
        {with({"tour"}), no_port, "/dev/ttyMISSING"},
        {{"screen", "--tcp", "nonsense", "tour"}, usage, "nonsense"},
        {with({"tour", "--junit", "/missing/x.xml"}), bad_input, "cannot be written"},
        {with({"tour", "--record", "/missing/x"}), bad_input, "cannot be written"},
        {with({"interactive"}), usage, "needs a terminal"},
        {{"screen", "--port", pty.path, "press", "Hotend onn"},
         usage,
         "did you mean \"Control/Filament/Hotend on\""},
        {{"screen", "--port", pty.path, "press", "Store settings", "Hotend onn"}, usage, "Hotend on"},
        {{"screen", "--port", pty.path, "press", "Rset"}, usage, "write more of its path"},
        {{"screen", "--port", pty.path, "press", "Screen lock PW=99999"}, usage, "from 0 to 9999"},
        {{"screen", "--port", pty.path, "show", "Control/Sped"}, usage, "did you mean \"Control/Speed\""},
    };
    check_mistakes(mistakes);
}

}  // namespace
}  // namespace fauxboard::e2e
