// What is set on the board: a settings file, the screen's own settings, the clock, the touch sensor; and
// kept.

#include "emulator/dlp/mks_board.h"

namespace fauxboard::dlp {
namespace {

/// Until a settings file is read off the stick.
constexpr SimTime read_time = ms(100);

}  // namespace

bool MksBoard::set_zero(SimTime now) {
    if (!print.homed() || print.state() != PrintState::idle || task_ != SetupTask::none) {
        return false;
    }
    settings.general.zero_pos_mm = static_cast<float>(platform.position(now));
    return keep_general(Event::platform_zero_set, now);
}

bool MksBoard::load_setup(std::string_view name, SimTime now) {
    if (task_ != SetupTask::none || print.active()) {
        return false;
    }
    setup_path_ = files.path_of(name);
    setup_file_ = "0:/" + setup_path_;
    task_ = SetupTask::loading;
    report_.reset();
    setup_opened_ = true;
    read_due_ = now + read_time;
    return true;
}

void MksBoard::read_setup(SimTime now) {
    const auto source = stick_.open(setup_path_);
    setup_opened_ = source != nullptr;
    if (!setup_opened_) {
        return end_setup(Event::setup_failed);
    }
    std::uint64_t at = 0;
    report_ = read_acfg(
        [&](char* out, std::size_t room) {
            const std::size_t got = source->read(at, std::span(out, room));
            at += got;
            return got;
        },
        settings, config_.firmware);
    raise(Event::setup_changed);
    if (report_->result != AcfgResult::ok) {
        return end_setup(Event::setup_failed);
    }
    write_block(Block::motor, now);
    write_block(Block::general, now);
    task_event_ = Event::setup_loaded;
}

void MksBoard::end_setup(Event event) {
    task_ = SetupTask::none;
    task_event_.reset();
    raise(event);
}

bool MksBoard::keep_general(Event done, SimTime now) {
    if (task_ != SetupTask::none) {
        return false;
    }
    task_ = SetupTask::saving;
    task_event_ = done;
    write_block(Block::general, now);
    return true;
}

bool MksBoard::save_setup(SimTime now) {
    return keep_general(Event::setup_saved, now);
}

bool MksBoard::calibrate_touch(const std::array<GlassPoint, 3>& read, SimTime now) {
    const auto calibration = calibrate(read, settings.general.rotate_display != 0);
    if (!calibration || task_ != SetupTask::none) {
        raise(Event::touch_not_calibrated);
        return false;
    }
    settings.general.touch = *calibration;
    return keep_general(Event::touch_calibrated, now);
}

void MksBoard::reset_touch(SimTime now) {
    settings.general.touch = no_calibration;
    write_block(Block::general, now);
}

void MksBoard::set_clock(const Moment& moment, SimTime now) {
    calendar.set(moment, now);
    if (uses_external_clock()) {
        external_clock.calendar = calendar;
    } else if (settings.general.external_clock != 0) {
        raise(Event::clock_not_set);
    }
}

bool MksBoard::set_language(int language, SimTime now) {
    if (language < 0 || language > 1) {
        return false;
    }
    settings.general.language = static_cast<std::uint8_t>(language);
    write_block(Block::general, now);
    raise(Event::setup_changed);
    return true;
}

}  // namespace fauxboard::dlp
