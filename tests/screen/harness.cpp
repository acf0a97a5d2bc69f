#include "tests/screen/harness.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "protocol/framing.h"

namespace fauxboard::testing {

behaviour::SourceFinder screen_finder() {
    return [](std::string_view name, std::string_view) -> std::optional<behaviour::SourceText> {
        const std::string file = fmt::format("{}/profiles/screens/{}.json", FAUXBOARD_SOURCE_DIR, name);
        std::ifstream in(file, std::ios::binary);
        if (!in) {
            return std::nullopt;
        }
        return behaviour::SourceText{
            file, std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>())};
    };
}

std::shared_ptr<const screen::ScreenProfile> shipped_screen(std::string_view name) {
    static std::map<std::string, std::shared_ptr<const screen::ScreenProfile>, std::less<>> loaded;
    auto hit = loaded.find(name);
    if (hit == loaded.end()) {
        const auto source = screen_finder()(name, {});
        REQUIRE_MESSAGE(source.has_value(), std::string(name));
        hit = loaded.emplace(name, screen::load_screen(*source, screen_finder())).first;
    }
    return hit->second;
}

std::shared_ptr<const screen::ScreenProfile> screen_from(std::string_view json) {
    return screen::load_screen({"test.json", std::string(json)}, screen_finder());
}

Bench::Bench(std::shared_ptr<const screen::ScreenProfile> profile) : screen_(std::move(profile)) {
    screen_.power_on(SimTime{0});
    pass(2);
    take();
}

void Bench::pass(double seconds) {
    now_ += machine::from_seconds(seconds);
    for (;;) {
        const SimTime next = screen_.advance(now_);
        bytes_ += screen_.output();
        const bool more = !screen_.output().empty();
        screen_.clear_output();
        if (!more && next > now_) return;
    }
}

std::string Bench::take() {
    std::string out;
    out.swap(bytes_);
    return out;
}

const screen::Judgement& Bench::say(std::string_view body) {
    std::string line = protocol::frame(body);
    line.resize(line.size() - 2);
    return say_raw(line);
}

const screen::Judgement& Bench::say_raw(std::string_view line) {
    screen_.receive(now_, std::string(line) + "\r\n");
    pass(0.05);
    REQUIRE(!screen_.judgements().empty());
    return screen_.judgements().back();
}

std::string Bench::press(std::string_view path) {
    const screen::PressResult result = screen_.press(path, now_);
    return result.pressed ? fmt::format("{}", fmt::join(result.sent, " | ")) : result.sentence;
}

TourRun run_tour(const std::string& name, std::shared_ptr<const behaviour::Profile> profile, double limit_s) {
    board::Board board(std::move(profile), {}, {});
    screen::Screen screen(shipped_screen(name));
    screen::Tour tour(screen);
    SimTime now{0};
    board.power_on(now);
    screen.power_on(now);
    const SimTime limit = machine::from_seconds(limit_s);
    while (!tour.done() && now < limit) {
        const SimTime board_next = board.advance(now);
        if (!board.output().empty()) {
            screen.receive(now, board.output());
            board.clear_output();
            continue;
        }
        const SimTime tour_next = tour.advance(now);
        if (!screen.output().empty()) {
            board.receive(now, screen.output());
            screen.clear_output();
            continue;
        }
        now = std::max(now + SimTime{1}, std::min(board_next, tour_next));
    }
    return {tour.results(), screen.findings(), screen.counters(),
            tour.total(),   tour.done(),       machine::to_seconds(now)};
}

}  // namespace fauxboard::testing
