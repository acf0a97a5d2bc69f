// The job, the user, and the talk with the host itself.

#include <string>
#include <string_view>
#include <vector>

#include "emulator/filament/gcode_rows.h"

namespace fauxboard::filament::codes {
namespace {

constexpr std::size_t longest_message = 60;
/// How long the firmware is busy with a message of the file.
constexpr double message_s = 0.001;
constexpr double longest_wait_s = 86400;

/// M0 and M1 wait for the user, or so long as P (ms) or S (s) say. A host's command that waits holds a job up
/// by itself; a job's own pauses it.
void wait_for_user(GcodeSource& r, Line line) {
    const double seconds = line.has('S') ? line.number('S') : line.number('P') / 1000;
    r.on.control.wait_for_user(seconds > 0 && line.code <= 1 ? std::min(seconds, longest_wait_s) : 0);
    if (r.of_job) {
        r.on.control.pause_job(line.code > 1);
    }
    r.on.events.raise(event("job.waits_for_user"));
}

void message(GcodeSource& r, Line line) {
    std::string& text = r.on.job.message;
    text.assign(line.text.substr(0, longest_message));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    r.on.events.raise(event("job.message"));
    wait(r, message_s);  // told before the next one takes its place
}

/// M118: E1, A1 and P first, at most three of them and in any order, then the text.
void tell(GcodeSource& r, Line line) {
    ToldText& told = r.on.told;
    told = {};
    std::string_view text = line.text;
    for (int i = 0; i < 3; ++i) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        if (word.size() != 2 || word[1] < '0' || word[1] > '9' ||
            std::string_view("AEP").find(word[0]) == std::string_view::npos) {
            break;
        }
        told.action = told.action || word == "A1";
        told.echo = told.echo || word == "E1";
        told.line = word[0] == 'P' ? word[1] - '0' : told.line;
        text.remove_prefix(std::min(end + 1, text.size()));
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    }
    told.text = text;
}

/// M808: L begins what is to be done so often (0: for ever), without it the file goes back there; K ends it.
void repeat(GcodeSource& r, Line line) {
    if (!r.of_job) {
        return;
    }
    GcodeMachine& p = r.on;
    std::vector<Job::Loop>& loops = p.job.loops;
    constexpr std::size_t most_loops = 10;
    if (line.has('L')) {
        if (loops.size() == most_loops) {
            p.events.raise(event("job.too_many_markers"));
            return;
        }
        loops.push_back({r.next, static_cast<int>(line.number('L'))});
    } else if (line.has('K')) {
        loops.clear();
    } else if (loops.empty()) {
        p.events.raise(event("job.no_marker"));
    } else if (Job::Loop& loop = loops.back(); loop.times == 1) {
        loops.pop_back();
    } else {
        loop.times -= loop.times > 0 ? 1 : 0;
        p.control.seek_job(static_cast<double>(loop.byte));
        wait(r, message_s);  // so that a loop around nothing takes its time
    }
}

void set_line_number(GcodeSource& r, Line line) {
    if (line.has('N') && !r.of_job) {
        r.on.host.line().last = static_cast<std::int64_t>(line.number('N'));
    }
}

void keepalive(GcodeSource& r, Line line) {
    if (line.has('S')) {
        constexpr double most_s = 60;
        r.on.host.set_busy_s(std::clamp(line.number('S'), 0.0, most_s), r.now);
    }
}

constexpr auto table = std::to_array<GcodeCode>({
    {'M', 0, rest, wait_for_user},
    {'M', 1, rest, wait_for_user},
    {'M', 25, nothing, [](GcodeSource& r, Line) { r.on.control.pause_job(true); }},
    {'M', 73, nothing, ignore},
    {'M', 110, nothing, set_line_number},
    {'M', 112, nothing, [](GcodeSource& r, Line) { r.on.control.kill(); }},
    {'M', 113, nothing, keepalive},
    {'M', 115, nothing, ignore},
    {'M', 117, nothing, message},
    {'M', 118, nothing, tell, false, true},
    {'M', 125, rest, wait_for_user, false, true},
    {'M', 524, nothing, [](GcodeSource& r, Line) { r.on.control.stop_job(); }},
    {'M', 600, rest, wait_for_user},
    {'M', 701, rest, wait_for_user, false, true},
    {'M', 808, nothing, repeat, false, true},
});

}  // namespace

std::span<const GcodeCode> job_codes() {
    return table;
}

}  // namespace fauxboard::filament::codes
