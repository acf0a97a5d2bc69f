#include "emulator/host/program_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"
#include "emulator/fault/deed_text.h"
#include "emulator/host/clock.h"
#include "emulator/machine/events.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr std::array<std::string_view, 6> names{"trace", "debug", "info", "warning", "error", "off"};

/// "2026-11-30T21:40:12.345678Z".
std::string calendar_text(SimTime since_1970) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(since_1970);
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:06}Z", fmt::gmtime(static_cast<std::time_t>(seconds.count())),
                       (since_1970 - seconds).count());
}

/// A JSON string in ASCII, whatever the text is.
std::string json_text(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::optional<LogLevel> log_level(std::string_view name) {
    const auto* const hit = std::find(names.begin(), names.end(), name);
    return hit == names.end() ? std::nullopt : std::optional(static_cast<LogLevel>(hit - names.begin()));
}

std::string_view level_name(LogLevel level) {
    return names[static_cast<std::size_t>(level)];
}

LogLevel log_level(behaviour::Level level) {
    constexpr std::array levels{LogLevel::debug, LogLevel::info, LogLevel::warning, LogLevel::error};
    return levels[static_cast<std::size_t>(level)];
}

std::string ProgramLog::head(bool json) {
    return json ? std::string(LogFile::json_mark) + "}" : std::string(LogFile::text_mark);
}

void ProgramLog::say(SimTime now, LogLevel level, std::string_view what, std::string_view text) {
    if (level < style_.least) {
        return;
    }
    const std::string time = calendar_text(time_since_epoch());
    const double t = machine::to_seconds(now);
    const std::string& board = style_.board;
    file_.write(
        style_.json
            ? fmt::format(R"({{"time": "{}", "t": {:.6f}, {}"level": "{}", "what": "{}", "text": {}}})", time,
                          t, board.empty() ? "" : R"("board": )" + json_text(board) + ", ", level_name(level),
                          what, json_text(text))
            : fmt::format("{} {:13.6f}  {:<7}  {:<7}  {}{}", time, t, level_name(level), what,
                          board.empty() ? "" : board + ": ", text));
}

void ProgramLog::on_received(SimTime now, board::Channel channel, std::string_view line,
                             board::Verdict verdict) {
    if (verdict != board::Verdict::accepted && style_.least <= LogLevel::debug) {
        say(now, LogLevel::debug, "refused",
            fmt::format("{} from {}: {}",
                        verdict == board::Verdict::bad_frame ? "bad frame" : "too many requests wait",
                        board::other_end(channel), behaviour::as_ascii(protocol::mask_secrets(line))));
    }
}

void ProgramLog::on_notice(SimTime now, board::Level level, std::string_view text) {
    say(now, log_level(level), "notice", text);
}

void ProgramLog::on_event(SimTime now, machine::EventId event) {
    say(now, LogLevel::trace, "event", event->name);
}

void ProgramLog::on_link(SimTime now, link::LinkState, std::string_view why) {
    say(now, LogLevel::info, "link", why);
}

void ProgramLog::on_world(SimTime now, std::string_view words) {
    say(now, LogLevel::info, "done", words);
}

void ProgramLog::on_fault(SimTime now, std::string_view sentence) {
    say(now, LogLevel::info, "fault", sentence);
}

void ProgramLog::on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) {
    if (style_.least <= LogLevel::debug) {
        say(now, LogLevel::debug, "fault",
            fmt::format("fault {}: {}", deed.fault, fault::deed_text(deed, board::other_end(channel))));
    }
}

}  // namespace fauxboard::host
