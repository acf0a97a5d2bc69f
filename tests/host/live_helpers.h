#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/host/clock.h"
#include "emulator/host/live_observer.h"
#include "emulator/host/profile_files.h"
#include "emulator/link/link.h"

namespace fauxboard::host::test {

using machine::SimTime;
using namespace std::chrono_literals;

/// A link without a line: remembers what is written, and says what the test says.
struct FakeLink final : link::Link {
    link::LinkListener* listener = nullptr;
    link::LinkState now = link::LinkState::opening;
    std::vector<std::string> messages;
    link::LinkStats counted;

    void open(link::LinkListener& who) override {
        listener = &who;
        now = link::LinkState::waiting;
    }
    void close() override {
        listener = nullptr;
        now = link::LinkState::opening;
    }
    void write(std::string_view message) override { messages.emplace_back(message); }
    link::LinkState state() const override { return now; }
    const link::LinkStats& stats() const override { return counted; }
    std::string describe() const override { return "a fake"; }
    std::string kind() const override { return "fake"; }
    std::string path() const override { return "nowhere"; }

    void go(link::LinkState state, std::string_view why) {
        now = state;
        listener->on_state(state, why);
    }
    std::string all() const {
        std::string text;
        for (const std::string& message : messages)
            text += message;
        return text;
    }
    bool wrote(std::string_view part) const { return all().find(part) != std::string::npos; }
};

/// Time by hand: it passes by skip() only, or by setting `hand` without ringing an alarm.
struct HandClock final : Clock {
    SimTime hand{0};

    using Clock::earliest;
    using Clock::ring_due;
    void start() override {}
    void run() override {}
    SimTime time() const override { return hand; }
    void arm(SimTime) override {}
    void skipped(SimTime by) override { hand += by; }

    /// Lets time pass, with every alarm at its moment.
    void pass(SimTime span) { skip(span); }
};

/// Remembers all it is told, a text each: "0.050 sent L3 ...".
struct Witness final : LiveObserver {
    std::vector<std::string> sent;
    std::vector<std::string> received;
    std::vector<std::string> notices;
    std::vector<std::string> links;

    void on_received(SimTime, board::Channel, std::string_view line, board::Verdict) override {
        received.emplace_back(line);
    }
    void on_sent(SimTime, board::Channel, std::string_view line) override { sent.emplace_back(line); }
    void on_notice(SimTime, board::Level, std::string_view text) override { notices.emplace_back(text); }
    void on_link(SimTime, link::LinkState, std::string_view why) override { links.emplace_back(why); }
};

}  // namespace fauxboard::host::test
