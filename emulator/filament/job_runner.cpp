#include "emulator/filament/job_runner.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "emulator/filament/event_rows.h"
#include "emulator/filament/heating_wait.h"
#include "emulator/filament/host_commands.h"
#include "emulator/filament/motion.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {
namespace {

/// Read in so long a time at most; what is more has to wait until it is over.
constexpr std::uint64_t breath_bytes = 4096;
constexpr SimTime breath{10'000};
/// End of a file in which slicers leave what they know only then (PrusaSlicer's settings alone are 20 KiB).
constexpr std::uint64_t tail_bytes = 64 * 1024;
/// Read ahead to count layers: before the first line, so that it is known at once of most files, and then bit
/// by bit.
constexpr std::uint64_t scout_first_bytes = 1024 * 1024;
constexpr std::uint64_t scout_bytes = 16 * 1024;
/// How the head goes back to where it was before a pause: as the shipped profiles park it.
constexpr double return_feed_mm_s = 100;
constexpr double return_z_feed_mm_s = 20;

}  // namespace

void JobRunner::power_on() {
    stop();
    source_.wake = SimTime{0};
}

void JobRunner::start(SimTime now) {
    stop();
    lines_ = lines_cut_ = unknown_codes_ = source_.moves = 0;
    on_.modal = {};
    wake_ = source_.wake = source_.now = now;
    read_tail();
    const Volume* volume = storage_.volume(on_.job.volume());
    if (volume != nullptr) {
        scout_.open(*volume, on_.job.path());
        scout(scout_first_bytes);
    }
    on_.job.estimate_s = notes_.seconds();
    seek();
}

void JobRunner::pause() {
    paused_at_ = on_.motion.planned();
}

void JobRunner::drop_line() {
    held_ = ended_ = false;
    source_.arc.clear();
}

void JobRunner::resume(SimTime now) {
    wake_ = source_.wake = source_.now = now;
    // Anew: the card may have been out, and another one may be in.
    if (!held_) {
        seek();
    }
    const AxisValues at = on_.motion.planned();
    if (at == paused_at_) {
        return;
    }
    Procedure back(2);
    back[0].kind = back[1].kind = ProcedureStep::Kind::to;
    back[0].values = {paused_at_[0], paused_at_[1], std::nullopt, std::nullopt};
    back[0].feed_mm_s = return_feed_mm_s;
    back[1].values = {std::nullopt, std::nullopt, paused_at_[2], std::nullopt};
    back[1].feed_mm_s = return_z_feed_mm_s;
    on_.motion.set_position({std::nullopt, std::nullopt, std::nullopt, paused_at_[3]});
    on_.motion.run(back, now, on_.events);
}

void JobRunner::seek() {
    held_ = ended_ = false;
    on_.motion.disown_streamed();
    enough_byte_ = on_.job.place() + breath_bytes;
    const Volume* volume = storage_.volume(on_.job.volume());
    reader_.close();
    cut_ = 0;
    if (volume != nullptr) {
        reader_.open(*volume, on_.job.path(), on_.job.place());
    }
    source_.byte = on_.job.place();
}

void JobRunner::stop() {
    reader_.close();
    scout_.close();
    scout_notes_.clear();
    source_.arc.clear();
    notes_.clear();
    held_ = ended_ = false;
    close_ = never;
}

void JobRunner::finished(SimTime now) {
    stop();
    close_ = now + from_seconds(config_.finished_s);
}

std::uint64_t JobRunner::executed_byte() const {
    const bool pending = source_.arc.active() || held_;
    return on_.motion.streamed_byte(pending ? source_.byte : on_.job.place());
}

/// Whether lines are being read and carried out at all.
bool JobRunner::reading() const {
    return on_.job.status() == JobStatus::printing && !on_.job.pausing() && !on_.wait.active() &&
           !on_.host.holds() && !on_.job.stands_by;
}

SimTime JobRunner::next_event(SimTime now) const {
    if (close_ != never) {
        return close_;
    }
    if (!reading()) {
        return never;
    }
    const bool may = held_ || ended_ ? !on_.motion.busy() : on_.motion.can_stream();
    return may ? std::max(wake(), now) : never;
}

void JobRunner::advance(SimTime now) {
    source_.now = now;
    if (close_ <= now) {
        close_ = never;
        on_.control.close_job();
    }
    if (wake() > now || !reading()) {
        return;
    }
    if (scout_.is_open()) {
        scout(scout_bytes);
    }
    if (now >= breath_end_) {
        breath_end_ = now + breath;
        enough_byte_ = reader_.byte() + breath_bytes;
    }
    // Each round carries out a line or a part of an arc, or ends the loop.
    const bool open = reader_.is_open();
    while (reading() && wake() <= now && piece()) {
        if (reader_.byte() >= enough_byte_) {
            wake_ = std::max(wake_, breath_end_);
        }
    }
    if (open && on_.job.active()) {
        on_.job.set_byte(static_cast<double>(reader_.byte()));
    }
}

/// One step of the work; false when there is none to be done now.
bool JobRunner::piece() {
    Motion& motion = on_.motion;
    if (ended_) {
        if (!motion.busy()) {
            on_.control.finish_job();
        }
        return false;
    }
    if (!motion.can_stream() || (held_ && motion.busy())) {
        return false;
    }
    if (source_.arc.active()) {
        stream_arc(source_);
        return true;
    }
    if (!held_ && !fetch()) {
        return ended_;
    }
    execute();
    return true;
}

/// Reads and parses the next line. False when there is none.
bool JobRunner::fetch() {
    const Volume* volume = storage_.volume(on_.job.volume());
    if (volume == nullptr || !reader_.is_open()) {
        lose_file();
        return false;
    }
    std::string_view text;
    source_.byte = std::min(reader_.byte(), on_.job.bytes());  // the file may have grown meanwhile
    switch (reader_.next(text)) {
        case GcodeReader::Result::line:
            break;
        case GcodeReader::Result::passing_over:
            line_ = {};
            return true;
        case GcodeReader::Result::end:
            ended_ = true;
            return false;
        case GcodeReader::Result::failed:
            lose_file();
            return false;
    }
    ++lines_;
    source_.next = reader_.byte();
    text_ = text;
    if (std::exchange(cut_, reader_.lines_cut()) != reader_.lines_cut()) {
        ++lines_cut_;
        on_.events.raise(event("job.line_too_long"));
    }
    parse_gcode(text, line_);
    if (!line_.comment.empty()) {
        take_comment();
    }
    return true;
}

void JobRunner::take_comment() {
    if (notes_.take(line_.comment)) {
        on_.job.layer = notes_.layer();
        on_.job.layers = std::max(notes_.layers(), on_.job.layers);
    }
    on_.job.estimate_s = notes_.seconds();
}

int JobRunner::layer_by_height() const {
    constexpr float first_mm = 0.1F;  // in single precision, as on the board: 0.3 mm is one layer of 0.2 more
    const auto height = static_cast<float>(notes_.layer_mm());
    if (!on_.job.active() || height == 0) {
        return on_.job.layer;
    }
    const auto z = static_cast<float>(on_.motion.position(Axis::z));
    return static_cast<int>(std::max(0.0F, (z - first_mm) / height));
}

bool JobRunner::run_code(bool by_rule) {
    return filament::run_code(code_, by_rule, source_, line_);
}

void JobRunner::execute() {
    code_ = line_.letter == 0 ? nullptr : find_code(line_.letter, line_.code);
    held_ = code_ != nullptr && code_->needs == Needs::rest && on_.motion.busy();
    if (held_ || line_.letter == 0) {
        return;
    }
    on_.commands.begun = this;
    machine::FileCommands* const rules = on_.commands.of_files;
    const bool by_rule = rules != nullptr && rules->carry_out(text_, line_.letter, line_.code);
    unknown_codes_ += by_rule || run_code(false) ? 0U : 1U;
    on_.commands.begun = nullptr;
    if (code_ != nullptr && code_->needs == Needs::room) {
        on_.host.go_on();
    }
}

/// The file is gone. The job pauses, so that it can go on when the card is back.
void JobRunner::lose_file() {
    on_.control.pause_job(true);
    const bool there = storage_.look(on_.job.volume(), on_.job.path()) == Volume::Kind::unreadable;
    on_.events.raise(there ? event("job.file_unreadable") : event("job.file_lost"));
}

/// Reads some of the file ahead of the job, for its layers only. Ends when a comment told their number, at
/// the end of the file, and when the file fails (which the job finds out by itself).
void JobRunner::scout(std::uint64_t bytes) {
    const std::uint64_t enough = scout_.byte() + bytes;
    std::string_view text;
    GcodeReader::Result result = GcodeReader::Result::line;
    while (notes_.layers() == 0 && scout_.byte() < enough) {
        result = scout_.next(text);
        if (result == GcodeReader::Result::passing_over) {
            continue;
        }
        if (result != GcodeReader::Result::line) {
            break;
        }
        if (text.starts_with(';')) {
            scout_notes_.take(text.substr(1));
            notes_.set_layers(scout_notes_.layers());
        }
    }
    if (result == GcodeReader::Result::end) {
        notes_.set_layers(scout_notes_.layer());
    }
    const bool over = result == GcodeReader::Result::end || result == GcodeReader::Result::failed;
    if (notes_.layers() != 0 || over) {
        on_.job.layers = notes_.layers();
        scout_.close();
    }
}

/// Looks into the end of the file for what its slicer tells only there.
void JobRunner::read_tail() {
    const Volume* volume = storage_.volume(on_.job.volume());
    if (volume == nullptr) {
        return;
    }
    std::uint64_t bytes = 0;
    volume->look(on_.job.path(), bytes);
    std::vector<char> tail(static_cast<std::size_t>(std::min(bytes, tail_bytes)));
    const auto got = volume->read(on_.job.path(), bytes - tail.size(), std::span<char>(tail));
    notes_.take_tail({tail.data(), std::min(got.value_or(0), tail.size())});
}

}  // namespace fauxboard::filament
