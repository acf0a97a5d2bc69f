// What those see who reach into a live board: curves, the last lines, a screen that looks on.

#include "emulator/host/live_target.h"

#include "emulator/control/session.h"
#include "emulator/host/screen_files.h"
#include "protocol/framing.h"
#include "tests/host/live_helpers.h"
#include "tests/link/helpers.h"

namespace fauxboard::host::test {
namespace {

using control::Json;
using control::Session;

struct Bench {
    explicit Bench(const std::string& profile = "geeetech-a30t")
        : board(load_profile_by_name(profile), {}, {false, 1, &observers}),
          live(board, link, clock, &observers),
          target(
              {loop, board, live, clock, link, nullptr, [] {}, 1, screen_of(board.profile()), nullptr, {}}),
          session(target.hub(), [] {}) {
        observers.add(target);
        link.open(live);
        live.start(machine::never, [] {});
        clock.pass(3s);
    }
    Json ask(const Json& request) {
        session.receive(request.dump() + "\n");
        Json answer;
        for (const Json& each : lines()) {
            if (each.contains("ok")) answer = each;
        }
        return answer;
    }
    std::vector<Json> lines() {
        std::vector<Json> out;
        std::string text = session.take_output();
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = text.find('\n', at);
            out.push_back(Json::parse(text.substr(at, end - at)));
            at = end + 1;
        }
        return out;
    }

    link::EventLoop loop;
    Observers observers;
    FakeLink link;
    HandClock clock;
    board::Board board;
    LiveBoard live;
    LiveTarget target;
    Session session;
};

TEST_CASE("curves: temperatures, heights and progress from the first moment on, a point a second") {
    Bench b;
    b.ask({{"op", "set"}, {"fields", {{"heaters.nozzle.target", 200}}}});
    b.clock.pass(30s);
    const Json curves = b.ask({{"op", "curves"}});
    std::vector<std::string> names;
    for (const Json& series : curves["series"])
        names.push_back(series["path"]);
    for (const char* name :
         {"heaters.nozzle.true", "heaters.nozzle.target", "heaters.bed.true", "position.z"}) {
        CAPTURE(name);
        CHECK(std::find(names.begin(), names.end(), name) != names.end());
    }
    CHECK(curves["t"][0].get<double>() < 1);
    CHECK(curves["t"].size() >= 32);
    CHECK(curves["t"].size() <= 36);
    const Json& nozzle = curves["values"][static_cast<std::size_t>(
        std::find(names.begin(), names.end(), "heaters.nozzle.true") - names.begin())];
    CHECK(nozzle.back().get<double>() > nozzle.front().get<double>() + 10);
}

TEST_CASE("curves of a day stay bounded, and reach from its beginning to its end") {
    Bench b;
    CurveKeeper keeper;
    for (int second = 0; second < 24 * 3600; ++second) {
        keeper.take(b.board, std::chrono::seconds(second));
    }
    CHECK(keeper.points() <= CurveKeeper::most_points);
    CHECK(keeper.points() > CurveKeeper::most_points / 2);
    const Json curves = keeper.to_json();
    CHECK(curves["t"].front() == 0.0);
    CHECK(curves["t"].back().get<double>() > 24 * 3600 - 2);
    CHECK(std::is_sorted(curves["t"].begin(), curves["t"].end()));
}

TEST_CASE("the last lines are there for whoever comes later, bounded, with words") {
    Bench b;
    for (int i = 0; i < 300; ++i)
        b.live.on_bytes(protocol::frame("M105"));
    const Json lines = b.ask({{"op", "talk"}})["lines"];
    CHECK(lines.size() == TalkKeeper::most_lines);
    CHECK(lines.back()["from"] == "board");
    CHECK(lines.back()["words"].get<std::string>() != "");
    b.live.on_bytes("N-0 M105*99\r\n");
    CHECK(b.ask({{"op", "talk"}})["lines"].back()["refused"] == "bad frame");
}

TEST_CASE("traffic with words, for those who asked for them") {
    Bench b;
    Session plain(b.target.hub(), [] {});
    plain.receive("{\"op\": \"subscribe\", \"topic\": \"traffic\"}\n");
    (void)plain.take_output();
    b.ask({{"op", "subscribe"}, {"topic", "traffic"}, {"words", true}});
    b.live.on_bytes(protocol::frame("M105"));
    CHECK(b.lines().front()["words"].get<std::string>() != "");
    CHECK(plain.take_output().find("words") == std::string::npos);
    CHECK(b.ask({{"op", "subscribe"}, {"topic", "link"}, {"words", true}})["error"]["code"] == "bad-request");
    CHECK(b.ask({{"op", "subscribe"}, {"topic", "traffic"}, {"words", 1}})["error"]["code"] == "bad-request");
}

TEST_CASE("a screen that looks on shows what the board has said, before it was there and after") {
    Bench b;
    const Json face = b.ask({{"op", "screen"}})["screen"];
    REQUIRE(face.is_object());
    CHECK(face["page"] == "Main");
    CHECK(face["lines"].dump().find("/ 0.0") != std::string::npos);
    CHECK(face["buttons"].size() > 2);
    CHECK(b.link.all().find("Geeetech LCD") == std::string::npos);
    b.ask({{"op", "set"}, {"fields", {{"heaters.nozzle.target", 200}}}});
    b.clock.pass(10s);
    CHECK(b.ask({{"op", "screen"}})["screen"]["lines"].dump().find("/ 200.0") != std::string::npos);
}

TEST_CASE("its buttons are requests to the board, and lead to pages") {
    Bench b;
    const Json answer = b.ask({{"op", "press"}, {"button", "Control/Filament/Hotend on"}});
    REQUIRE(answer["ok"] == true);
    CHECK(answer["sent"].dump().find("M104") != std::string::npos);
    CHECK(answer["screen"]["page"] == "Control/Filament");
    CHECK(b.ask({{"op", "get"}, {"fields", "heaters.nozzle.target"}})["fields"]["heaters.nozzle.target"] ==
          200.0);
    const Json wrong = b.ask({{"op", "press"}, {"button", "Hotend onn"}});
    CHECK(wrong["error"]["code"] == "refused");
    CHECK(b.ask({{"op", "press"}, {"button", "Home"}, {"row", 0}})["error"]["code"] == "out-of-range");
}

TEST_CASE("while somebody is on the line the screen that looks on says nothing by itself") {
    Bench b;
    b.link.go(link::LinkState::up, "somebody came");
    std::vector<std::string> heard;
    struct Ear final : LiveObserver {
        explicit Ear(std::vector<std::string>& into) : heard(into) {}
        void on_received(SimTime, board::Channel, std::string_view line, board::Verdict) override {
            heard.emplace_back(line);
        }
        void on_sent(SimTime, board::Channel, std::string_view) override {}
        void on_notice(SimTime, board::Level, std::string_view) override {}
        void on_link(SimTime, link::LinkState, std::string_view) override {}
        std::vector<std::string>& heard;
    } ear(heard);
    b.observers.add(ear);
    b.ask({{"op", "screen"}});
    b.clock.pass(30s);
    CHECK(heard.empty());
    b.ask({{"op", "press"}, {"button", "Control/Filament/Hotend on"}});
    CHECK_FALSE(heard.empty());
}

TEST_CASE("a board without a screen of its kind has none, and says so") {
    Bench b("elegoo-mars-pro");
    CHECK(b.ask({{"op", "screen"}})["screen"].is_null());
    CHECK(b.ask({{"op", "press"}, {"button", "Home"}})["error"]["code"] == "not-here");
}

TEST_CASE("what is looked at is told when it changes, and only while somebody wants it") {
    Bench b;
    CHECK(b.ask({{"op", "subscribe"}, {"topic", "screen"}})["ok"] == true);
    const auto heard = [&] {
        for (const Json& line : b.lines()) {
            if (line.value("event", "") == "screen") return true;
        }
        return false;
    };
    CHECK(link::test::run_until(b.loop, heard));
    b.ask({{"op", "press"}, {"button", "Control"}});
    CHECK(link::test::run_until(b.loop, heard));
}

}  // namespace
}  // namespace fauxboard::host::test
