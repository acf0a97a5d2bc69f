#include "tests/support/board_driver.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "emulator/behaviour/fields.h"
#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/support/printers.h"

namespace fauxboard::testing {

using machine::from_seconds;
using machine::to_seconds;

std::shared_ptr<const behaviour::Profile> shipped_profile(std::string_view name) {
    static std::map<std::string, std::shared_ptr<const behaviour::Profile>, std::less<>> loaded;
    const auto hit = loaded.find(name);
    if (hit != loaded.end()) {
        return hit->second;
    }
    return loaded[std::string(name)] = host::load_profile_by_name(name);
}

std::string said(std::string_view line) {
    const protocol::Unframed frame = protocol::unframe(line, protocol::ChecksumPolicy::required);
    const std::string body(frame.body);
    const bool right = frame.prefixed && frame.fault == protocol::FrameFault::none &&
                       protocol::frame(body) == std::string(line) + "\r\n";
    return right ? body : "raw:" + std::string(line);
}

std::string said(std::string_view line, const behaviour::Profile& profile) {
    const bool code = line.size() > 1 && line[0] == 'L' && line[1] >= '0' && line[1] <= '9';
    return !profile.line.framed && code ? std::string(line) : said(line);
}

std::string join(const std::vector<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts) {
        out += text + '\n';
    }
    return out;
}

BoardDriver::BoardDriver(std::shared_ptr<const behaviour::Profile> profile, const Setup& setup)
    : now_(setup.power_on_at),
      board_(std::move(profile), setup.services, board::Options{setup.pacing, setup.seed, this}) {
    board_.power_on(from_seconds(now_));
    take_output();
}

void BoardDriver::take_output() {
    bytes_.append(board_.output());
    board_.clear_output();
}

void BoardDriver::run_until(double seconds) {
    const board::SimTime end = from_seconds(seconds);
    while (board_.advance(end) <= end || !board_.output().empty()) {
        take_output();
    }
    now_ = std::max(now_, seconds);
}

bool BoardDriver::run_until_reply(double seconds) {
    const board::SimTime end = from_seconds(seconds);
    const std::size_t before = replies_.size();
    while (replies_.size() == before) {
        const board::SimTime due = board_.advance(end);
        const bool spoke = !board_.output().empty() || replies_.size() != before;
        take_output();
        if (!spoke && due > end) {
            now_ = std::max(now_, seconds);
            return false;
        }
    }
    now_ = std::max(now_, to_seconds(board_.time()));
    return true;
}

void BoardDriver::run_to_quiet() {
    const behaviour::Schedule& schedule = board_.profile().schedule;
    const double slot = to_seconds(schedule.slot);
    const double round = slot * static_cast<double>(schedule.slots.size());
    // Behind the last slot but one that may have something to say on an idle board.
    const double last = schedule.slots.size() > 5 ? 4 : 3;
    const double quiet = to_seconds(schedule.first) + last * slot + 0.01;
    run_until(quiet + round * std::ceil((now_ - quiet) / round));
}

void BoardDriver::press_all(const std::vector<std::string>& bodies) {
    std::string bytes;
    for (const std::string& body : bodies) {
        bytes += protocol::frame(body);
    }
    feed(bytes);
}

std::vector<std::string> BoardDriver::ask(std::string_view body, double seconds) {
    const double from = now_;
    const std::size_t before = lines_.size();
    press(body);
    run_until(from + seconds);
    std::vector<std::string> replies;
    for (std::size_t i = before; i < lines_.size(); ++i) {
        replies.push_back(lines_[i].body);
    }
    return replies;
}

void BoardDriver::feed(std::string_view bytes) {
    board_.receive(from_seconds(now_), bytes);
    take_output();
}

void BoardDriver::host(std::string_view line) {
    board_.connect(board::Channel::host, true);
    board_.receive(from_seconds(now_), std::string(line) + "\n", board::Channel::host);
    take_output();
}

void BoardDriver::world(std::string_view phrase) {
    REQUIRE(board_.world(from_seconds(now_), phrase));
    take_output();
}

void BoardDriver::finish_boot() {
    run_until(1);
    meet_screen();
    run_until(3.4);
    run_to_quiet();
}

void BoardDriver::meet_screen() {
    press("M2134 FW:V1.02.xx");
    run_for(0.15);
}

void BoardDriver::heat_nozzle(double c) {
    filament_printer(board_.machine()).thermal.set_temperature(filament::HeaterId::nozzle, c);
    run_for(0.7);
}

std::vector<BoardDriver::Line> BoardDriver::between(double from, double to) const {
    std::vector<Line> out;
    for (const Line& line : lines_) {
        if (line.at >= from && line.at < to) {
            out.push_back(line);
        }
    }
    return out;
}

std::vector<std::string> BoardDriver::bodies(double from, double to) const {
    std::vector<std::string> out;
    for (const Line& line : between(from, to)) {
        out.push_back(line.body);
    }
    return out;
}

std::vector<std::string> BoardDriver::timed(double from, double to) const {
    std::vector<std::string> out;
    for (const Line& line : between(from, to)) {
        out.push_back(fmt::format("{:.2f} {}", line.at, line.body));
    }
    return out;
}

std::vector<BoardDriver::Line> BoardDriver::matching(std::string_view start, double from, double to) const {
    std::vector<Line> out;
    for (const Line& line : between(from, to)) {
        if (line.body.starts_with(start)) {
            out.push_back(line);
        }
    }
    return out;
}

double BoardDriver::number(std::string_view path) const {
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE_MESSAGE(field != nullptr, std::string(path));
    REQUIRE(field->type != behaviour::FieldType::text);
    return field->get(board_.machine()).number;
}

std::string BoardDriver::text(std::string_view path) const {
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE_MESSAGE(field != nullptr, std::string(path));
    REQUIRE(field->type == behaviour::FieldType::text);
    return std::string(field->get(board_.machine()).text);
}

void BoardDriver::on_received(board::SimTime now, board::Channel channel, std::string_view line,
                              board::Verdict verdict) {
    received_.push_back({to_seconds(now), channel, std::string(line), verdict});
}

void BoardDriver::on_sent(board::SimTime now, board::Channel channel, std::string_view line) {
    if (channel != board::Channel::main) {
        replies_.push_back({to_seconds(now), std::string(line)});
        return;
    }
    lines_.push_back({to_seconds(now), std::string(line), said(line, board_.profile())});
    transcript_ += std::to_string(now.count()) + ' ' + std::string(line) + '\n';
}

void BoardDriver::on_notice(board::SimTime, board::Level, std::string_view text) {
    notices_.emplace_back(text);
}

}  // namespace fauxboard::testing
