#include "emulator/world/invariants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "emulator/behaviour/fields.h"
#include "emulator/screen/screen.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

/// A burst of the longest listing fits; a queue that grows does not.
constexpr std::size_t most_output = 256UL * 1024;
/// What one call may read of a disk: a job's look ahead, its end, and a piece of each reader.
constexpr std::uint64_t most_bytes_read = 2UL * 1024 * 1024;
constexpr std::uint64_t most_stops = 20'000;
constexpr double walk_grain_mm = 0.02;

bool is_framed(const View& view) {
    return view.channel == board::Channel::main &&
           view.board.profile().line.framing == behaviour::Framing::frames;
}

/// Calls `look(line)` for each line, its end taken off, until it finds something.
template <class Look>
std::string each_line(std::string_view output, Look&& look) {
    while (!output.empty()) {
        const std::size_t end = std::min(output.find('\n'), output.size() - 1);
        std::string_view line = output.substr(0, end);
        output.remove_prefix(end + 1);
        line = line.substr(0, line.find_last_not_of('\r') + 1);
        if (std::string found = look(line); !found.empty()) {
            return found;
        }
    }
    return {};
}

/// A real A30T sends these two without a checksum.
bool has_no_checksum(std::string_view line) {
    return line.starts_with("N-0 L14 Pausing") || line.starts_with("N-0 L14 file select succeed!:");
}

std::string whole_lines(const View& view) {
    return view.output.ends_with('\n') ? "" : "output ends in the middle of a line";
}

/// Where hosts are spoken to, an unknown command is said back as it came, as the firmware does.
std::string plain_lines(const View& view) {
    if (!is_framed(view)) {
        return {};
    }
    return each_line(view.output, [](std::string_view line) -> std::string {
        const bool plain = std::all_of(line.begin(), line.end(), [](char c) {
            return static_cast<unsigned char>(c) >= 0x20 && c != 0x7F;
        });
        return plain ? "" : "a control character within a line";
    });
}

std::string right_checksums(const View& view) {
    if (!is_framed(view)) {
        return {};
    }
    return each_line(view.output, [](std::string_view line) -> std::string {
        const bool right =
            !line.starts_with("N-0 ") || has_no_checksum(line) ||
            protocol::unframe(line, protocol::ChecksumPolicy::required).fault == protocol::FrameFault::none;
        return right ? "" : fmt::format("\"{}\" has a wrong checksum", line);
    });
}

std::string bounded_output(const View& view) {
    return view.output.size() <= most_output ? "" : fmt::format("{} bytes at once", view.output.size());
}

std::string time_goes_on(const View& view) {
    if (view.board.time() < view.ledger.before) {
        return "the board's time went back";
    }
    return view.board.time() == view.ledger.now ? "" : "the board's time stood still";
}

std::string counters_add_up(const View& view) {
    const board::Counters& c = view.board.counters();
    if (c.lines_sent != view.ledger.lines_said) {
        return fmt::format("{} lines said, {} counted", view.ledger.lines_said, c.lines_sent);
    }
    return c.lines_received == view.ledger.lines_heard
               ? ""
               : fmt::format("{} lines heard, {} counted", view.ledger.lines_heard, c.lines_received);
}

std::string told_of_commands(std::uint64_t taken, std::uint64_t acknowledged) {
    return fmt::format("{} commands, {} acknowledgements", taken, acknowledged);
}

std::string no_more_ok_than_commands(const View& view) {
    const std::uint64_t taken = view.ledger.commands_taken;
    const std::uint64_t acknowledged = view.ledger.commands_acknowledged;
    return acknowledged <= taken ? "" : told_of_commands(taken, acknowledged);
}

std::string each_command_has_its_ok(const View& view) {
    const std::uint64_t taken = view.ledger.commands_taken - commands_without_ok(view.board.machine());
    const std::uint64_t acknowledged = view.ledger.commands_acknowledged;
    return acknowledged == taken ? "" : told_of_commands(taken, acknowledged);
}

std::string progress_stays(const View& view) {
    const Ledger& l = view.ledger;
    const machine::Job& job = view.board.machine().job;
    if (!job.active() || l.job_seen != l.job_number) {
        return {};
    }
    // Some boards throw away what was planned when they pause: such a job goes on where it was executed.
    const std::uint64_t behind = l.paused ? std::min(l.job_byte, l.job_executed) : l.job_byte;
    return job.byte() >= behind ? "" : fmt::format("the job went from byte {} to {}", l.job_byte, job.byte());
}

std::string place_is_within(const View& view) {
    const machine::Job& job = view.board.machine().job;
    return job.byte() <= job.bytes() ? "" : fmt::format("byte {} of {}", job.byte(), job.bytes());
}

std::string bounded_work(const View& view) {
    const Ledger& l = view.ledger;
    if (l.most_bytes_read > most_bytes_read) {
        return fmt::format("one call read {} bytes of the disk", l.most_bytes_read);
    }
    return l.stops_at_one_moment <= most_stops ? "" : "the board wants to be called without end";
}

std::string nothing_named_too_early(const View& view) {
    const std::string& name = view.disk.named_too_early();
    return name.empty() ? "" : fmt::format("\"{}\" was written under its own name", name);
}

std::string files_are_whole(const View& view) {
    for (const auto& [path, contents] : view.ledger.whole) {
        const std::string* const content = view.disk.content(path);
        if (content != nullptr && contents.find(*content) == contents.end()) {
            return fmt::format("\"{}\" has {} bytes that nobody ever wrote as a whole", path,
                               content->size());
        }
    }
    return {};
}

std::string saved_is_there(const View& view) {
    const std::optional<std::string>& kept = view.eeprom.kept();
    const std::string& image = view.board.machine().eeprom_image.text();
    return !kept || image == *kept ? "" : "the board's EEPROM holds something else than was saved";
}

std::string saved_is_stored(const View& view) {
    const std::string& image = view.board.machine().eeprom_image.text();
    const bool stored = image == view.eeprom.kept().value_or(view.ledger.eeprom_at_first);
    return stored || view.eeprom.refused() ? "" : "what the board takes for saved was not stored";
}

/// Numbers alone: texts are few, and shown as they are.
std::string saved_is_in_force(const View& view) {
    return each_line(view.board.machine().eeprom_image.text(), [&view](std::string_view line) -> std::string {
        const std::size_t blank = line.find(' ');
        const behaviour::Field* const field = behaviour::find_field(line.substr(0, blank));
        if (blank == std::string_view::npos || field == nullptr || !field->stored) {
            return {};
        }
        double saved = 0;
        const std::string_view number = line.substr(blank + 1);
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), saved);
        const std::optional<double> in_force = number_of(view.board.machine(), field->path);
        return error != std::errc{} || end != number.data() + number.size() ||
                       in_force.value_or(saved) == saved
                   ? ""
                   : fmt::format("{} is {}, and was saved as {}", field->path, *in_force, saved);
    });
}

std::string place_was_reached(const View& view) {
    const std::optional<Place> place = saved_place(view.board.machine());
    if (!place) {
        return {};
    }
    const auto known = view.ledger.places.find(place->path);
    return known != view.ledger.places.end() && known->second.contains(place->byte)
               ? ""
               : fmt::format("\"{}\" is to go on at byte {}, where it never was", place->path, place->byte);
}

std::string over_is_over(const View& view) {
    const machine::Machine& machine = view.board.machine();
    const std::optional<Place> place = saved_place(machine);
    return view.ledger.job_over && !machine.job.active() && place
               ? fmt::format("\"{}\" has ended, and is to go on at byte {}", place->path, place->byte)
               : "";
}

std::string every_line_answers(const View& view) {
    return view.ledger.unanswered.empty() ? "" : fmt::format("{}", fmt::join(view.ledger.unanswered, "; "));
}

std::string moves_once(const View& view) {
    for (const auto& [asked, came] : view.ledger.walks) {
        if (std::abs(asked[0] - came[0]) >= walk_grain_mm || std::abs(asked[1] - came[1]) >= walk_grain_mm) {
            return fmt::format("the moves lead to {:.3f}, {:.3f}; the head is at {:.3f}, {:.3f}", asked[0],
                               asked[1], came[0], came[1]);
        }
    }
    return {};
}

/// But for what was too short to be a move: less than Marlin's six steps.
std::string motors_follow(const View& view) {
    constexpr double too_short_steps = 7;
    const machine::Machine& machine = view.board.machine();
    if (machine.moving()) {
        return {};
    }
    for (const char axis : {'x', 'y'}) {
        const auto place = number_of(machine, fmt::format("position.{}", axis));
        const auto stands = number_of(machine, fmt::format("position.steps.{}", axis));
        const auto steps_per_mm = number_of(machine, fmt::format("settings.steps.{}", axis));
        if (place && stands && steps_per_mm && std::abs(*place * *steps_per_mm - *stands) > too_short_steps) {
            return fmt::format("{} is at {}, and its motor at {}", axis, *place, *stands / *steps_per_mm);
        }
    }
    return {};
}

std::string one_a_turn(const View& view) {
    const int answers = view.ledger.too_soon;
    return answers == 0 ? "" : fmt::format("{} requests were answered within one turn", answers);
}

std::string user_is_heard(const View& view) {
    return view.ledger.unheard ? "the board waits for a user who has continued" : "";
}

std::string upload_is_there(const View& view) {
    const std::string& name = view.ledger.not_saved;
    return name.empty() ? "" : fmt::format("\"{}\" was acknowledged, and is something else", name);
}

std::string told_of(const Tally& tally) {
    return fmt::format("{} moves and {} layers", tally[0], tally[1]);
}

/// What those fields say, of whatever kind of machine it is.
template <std::size_t n>
std::string told_by(const machine::Machine& machine, const std::array<std::string_view, n>& paths) {
    std::string out;
    for (const std::string_view path : paths) {
        const behaviour::Field* const field = behaviour::find_field(path);
        const behaviour::Value value = field == nullptr ? behaviour::Value{} : field->get(machine);
        if (!value.none()) {
            out += fmt::format(
                "{}{} {}", out.empty() ? "" : ", ", path,
                value.is_text() ? fmt::format("\"{}\"", value.text) : fmt::format("{}", value.number));
        }
    }
    return out;
}

std::string prints_end(const View& view) {
    const Ledger& l = view.ledger;
    const std::optional<Tally>& ended = l.prints.ended();
    if (!l.proof || ended == l.proof) {
        return {};
    }
    constexpr std::array<std::string_view, 6> stands{"job.status",   "job.byte",    "print.state",
                                                     "print.paused", "print.layer", "print.problem"};
    return ended ? fmt::format("a print had {} instead of {}", told_of(*ended), told_of(*l.proof))
                 : fmt::format("a print did not come to its end: {}", told_by(view.board.machine(), stands));
}

std::string light_is_right(const View& view) {
    const double broken = number_of(view.board.machine(), "watch.broken").value_or(0);
    constexpr std::array<std::string_view, 6> seen{"watch.lit_moving",        "watch.into_model",
                                                   "watch.wrong_pictures",    "watch.lit_at_end",
                                                   "watch.exposure_error_ms", "print.state"};
    return broken == 0 || view.ledger.harmed ? "" : told_by(view.board.machine(), seen);
}

std::string screen_lives(const View& view) {
    if (view.screen == nullptr || view.screen->counters().crashes == 0) {
        return {};
    }
    for (const screen::Finding& finding : view.screen->findings()) {
        if (finding.first.verdict == screen::Verdict::would_crash) {
            return finding.first.sentence();
        }
    }
    return "the screen crashed";
}

std::string damaged_is_refused(const View& view) {
    return view.ledger.damaged_taken == 0 ? "" : "a frame with a wrong checksum was carried out";
}

std::string lost_is_asked_for(const View& view) {
    return view.ledger.lost_counted == 0 ? "" : "a line that was not taken counts as taken";
}

constexpr std::array table{
    Invariant{Moment::output, "whole lines", "What the board says at once ends with the end of a line.",
              whole_lines},
    Invariant{Moment::output, "plain lines",
              "Within a line for the screen there are no control characters, whatever names and texts it is "
              "made of.",
              plain_lines},
    Invariant{Moment::output, "right checksums", "Every frame has the right checksum.", right_checksums},
    Invariant{Moment::output, "bounded output",
              "What the board says at once is bounded by its queues, not by what it was told.",
              bounded_output},
    Invariant{Moment::step, "time goes on", "The board's time never goes back, and is that of who calls it.",
              time_goes_on},
    Invariant{Moment::step, "counters add up", "The counters are what an observer counts.", counters_add_up},
    Invariant{Moment::step, "no more ok than commands",
              "The USB side never hears more acknowledgements than there were commands.",
              no_more_ok_than_commands},
    Invariant{Moment::step, "damaged is refused", "What arrives with a wrong checksum is not carried out.",
              damaged_is_refused},
    Invariant{Moment::step, "lost is asked for",
              "The number of a line that was not taken does not count as taken: it is asked for again.",
              lost_is_asked_for},
    Invariant{Moment::step, "progress stays", "A job never goes back in its file, unless it is told to.",
              progress_stays},
    Invariant{Moment::step, "place is within", "The place of a job lies within its file.", place_is_within},
    Invariant{Moment::step, "bounded work",
              "What one call reads and does is bounded, however long a file, a line or a silence was.",
              bounded_work},
    Invariant{Moment::step, "no name too early", "A file has its name when it is whole, and not before.",
              nothing_named_too_early},
    Invariant{Moment::step, "files are whole",
              "What stands under a name is the whole of something that was written, whatever was cut off.",
              files_are_whole},
    Invariant{Moment::step, "upload is there",
              "An upload that was acknowledged to its end is there, byte for byte.", upload_is_there},
    Invariant{Moment::step, "saved is stored",
              "What the board takes for saved was stored, unless it was told that it could not be.",
              saved_is_stored},
    Invariant{Moment::power_cut, "saved is there",
              "What was acknowledged as saved is there after the power was cut at any moment.",
              saved_is_there},
    Invariant{Moment::power_cut, "saved is in force",
              "A board that is switched on goes by the settings that were saved.", saved_is_in_force},
    Invariant{Moment::power_cut, "place was reached",
              "After a power cut a job goes on at a place that it really had reached.", place_was_reached},
    Invariant{Moment::step, "over is over", "A job that has ended is not to be taken up again.",
              over_is_over},
    Invariant{Moment::peace, "files are whole after all", "The same once all troubles are over.",
              files_are_whole},
    Invariant{Moment::peace, "every line answers",
              "A good request is answered on every line, within its time, whatever happened before.",
              every_line_answers},
    Invariant{
        Moment::peace, "each command has its ok",
        "Each accepted command of the USB side was acknowledged exactly once, but for the few that by the "
        "dialect never are.",
        each_command_has_its_ok},
    Invariant{Moment::peace, "moves once",
              "A move is executed once, in its order: many short ones lead where their sum leads.",
              moves_once},
    Invariant{Moment::step, "motors follow", "At rest the motors stand where the moves led them.",
              motors_follow},
    Invariant{Moment::peace, "one a turn",
              "A board that answers a request a turn does not answer faster, however many come at once.",
              one_a_turn},
    Invariant{Moment::step, "the user is heard", "When the user has continued, nothing waits for him.",
              user_is_heard},
    Invariant{Moment::peace, "prints end",
              "Once all is well a print comes to its end, with each of its moves and layers.", prints_end},
    Invariant{
        Moment::step, "light is right",
        "Of a printer that is not broken, the lamp never shines on a moving platform, at the end of a print "
        "or on another picture than the file's, and the platform never goes into what it has printed.",
        light_is_right},
    Invariant{Moment::step, "screen lives", "The screen never gets a line on which the real one would crash.",
              screen_lives},
};

}  // namespace

std::optional<double> number_of(const machine::Machine& machine, std::string_view path) {
    const behaviour::Field* const field = behaviour::find_field(path);
    const behaviour::Value value = field == nullptr ? behaviour::Value{} : field->get(machine);
    return value.is_number() ? std::optional(value.number) : std::nullopt;
}

std::uint64_t commands_without_ok(const machine::Machine& machine) {
    return machine.host_side().lines[machine::HostSide::usb_port].unanswered;
}

std::optional<Place> saved_place(const machine::Machine& machine) {
    if (number_of(machine, "power_loss.saved_job").value_or(0) == 0) {
        return std::nullopt;
    }
    return Place{std::string(behaviour::find_field("power_loss.path")->get(machine).text),
                 static_cast<std::uint64_t>(number_of(machine, "power_loss.byte").value_or(0))};
}

std::span<const Invariant> invariants() {
    return table;
}

}  // namespace fauxboard::world
