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

namespace {

/// More than this at once takes its time on the wire, at 115200 bit/s.
constexpr std::size_t wire_piece = 1152;
constexpr SimTime wire_time{100'000};

/// Carries what each says to the other until `done` or the limit; `advance` is the screen's or its tour's.
SimTime carry(board::Board& board, screen::Screen& screen, SimTime now, SimTime limit,
              const std::function<SimTime(SimTime)>& advance, const std::function<bool()>& done) {
    while (!done() && now < limit) {
        const SimTime board_next = board.advance(now);
        if (!board.output().empty()) {
            const std::string bytes(board.output());
            board.clear_output();
            for (std::size_t at = 0; at < bytes.size(); at += wire_piece) {
                if (at != 0) {
                    now += wire_time;
                    advance(now);
                }
                screen.receive(now, std::string_view(bytes).substr(at, wire_piece));
            }
            continue;
        }
        const SimTime screen_next = advance(now);
        if (!screen.output().empty()) {
            board.receive(now, screen.output());
            screen.clear_output();
            continue;
        }
        now = std::max(now + SimTime{1}, std::min({board_next, screen_next, limit}));
    }
    return now;
}

}  // namespace

TourRun run_tour(const std::string& name, std::shared_ptr<const behaviour::Profile> profile, double limit_s,
                 const machine::Services& services) {
    board::Board board(std::move(profile), services, {});
    screen::Screen screen(shipped_screen(name));
    screen::Tour tour(screen);
    board.power_on(SimTime{0});
    screen.power_on(SimTime{0});
    const SimTime now = carry(
        board, screen, SimTime{0}, machine::from_seconds(limit_s),
        [&](SimTime at) { return tour.advance(at); }, [&] { return tour.done(); });
    return {tour.results(), screen.findings(), screen.counters(),
            tour.total(),   tour.done(),       machine::to_seconds(now)};
}

Together::Together(std::shared_ptr<const behaviour::Profile> profile,
                   std::shared_ptr<const screen::ScreenProfile> screen_profile,
                   const machine::Services& services, const std::vector<std::string>& presses) {
    board::Board board(std::move(profile), services, {});
    screen::Screen screen(std::move(screen_profile));
    board.power_on(SimTime{0});
    screen.power_on(SimTime{0});
    SimTime now{0};
    const auto pass = [&](double seconds) {
        now = carry(
            board, screen, now, now + machine::from_seconds(seconds),
            [&](SimTime at) { return screen.advance(at); }, [] { return false; });
    };
    pass(8);
    for (const std::string& path : presses) {
        screen.press(path, now);
        pass(3);
    }
    pass(40);
    findings = screen.findings();
}

}  // namespace fauxboard::testing
