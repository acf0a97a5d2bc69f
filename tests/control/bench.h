#pragma once

#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <vector>

#include "emulator/control/hub.h"
#include "emulator/control/session.h"
#include "tests/support/board_driver.h"
#include "tests/support/loose_faults.h"

namespace fauxboard::control::test {

using namespace std::chrono_literals;

/// A board in virtual time with its hub: what a host is, without one.
struct Bench final : Target {
    explicit Bench(std::string_view profile = "geeetech-a30t", bool pacing = false)
        : hub(*this), own(testing::shipped_profile(profile), {}, {pacing, 1, &hub}) {
        own.power_on(SimTime{0});
        pass(1s);
        sent.clear();
    }

    const board::Board& board() const override { return own; }
    void visit(const std::function<void(board::Board&, SimTime)>& use) override {
        use(own, now);
        take();
    }
    SimTime skip(SimTime by) override {
        skip_to = std::max(skip_to, now) + by;
        return skip_to;
    }
    void hold(bool still) override { held = still; }
    void quit() override { ended = true; }
    fault::FaultControl* faults() override { return with_faults ? &loose : nullptr; }
    Json status() const override { return {{"link", {{"kind", "none"}}}}; }
    Display* display() override { return shown; }

    void take() {
        sent += own.output();
        own.clear_output();
    }
    /// Lets time pass, for the board and for those who watch it.
    void pass(SimTime by) { step(now + by); }
    /// Carries out the jumps that were asked for.
    void jump() { step(std::max(now, skip_to)); }
    void step(SimTime to) {
        for (SimTime watch = look(); now < to; watch = look()) {
            const SimTime next = std::min(own.advance(std::min(to, watch)), watch);
            take();
            now = std::clamp(next, own.time(), to);
        }
    }
    SimTime look() {
        own.refresh(now);
        take();
        return hub.on_moved(now);
    }
    /// The board still does what it is for.
    bool answers() {
        sent.clear();
        own.receive(now, protocol::frame("M105"));
        own.advance(now);
        take();
        return sent.find("L2 B:") != std::string::npos;
    }

    Hub hub;
    board::Board own;
    testing::LooseFaults loose;
    bool with_faults = true;
    Display* shown = nullptr;
    bool ended = false;
    bool held = false;
    SimTime now{0};
    SimTime skip_to{0};
    std::string sent;
};

/// One client of it.
struct Client {
    explicit Client(Bench& bench) : session(bench.hub, [this] { ++wakes; }) {}

    /// All lines that have come, parsed; each must be one line of JSON.
    std::vector<Json> lines() {
        std::vector<Json> out;
        std::string text = session.take_output();
        while (!text.empty()) {
            const std::size_t end = text.find('\n');
            REQUIRE(end != std::string::npos);
            out.push_back(Json::parse(text.substr(0, end)));
            text.erase(0, end + 1);
        }
        return out;
    }
    /// Sends one line, and gives the one answer.
    Json ask(const std::string& line) {
        session.receive(line + "\n");
        for (const Json& each : lines()) {
            if (each.contains("ok")) {
                return each;
            }
        }
        return nullptr;
    }
    /// The code of the error, "" when there is none.
    std::string code(const std::string& line) {
        const Json answer = ask(line);
        REQUIRE(answer.is_object());
        return answer["ok"].get<bool>() ? "" : answer["error"]["code"].get<std::string>();
    }
    Session session;
    int wakes = 0;
};

inline bool has(const Json& text, std::string_view part) {
    return text.get<std::string>().find(part) != std::string::npos;
}

}  // namespace fauxboard::control::test
