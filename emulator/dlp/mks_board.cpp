#include "emulator/dlp/mks_board.h"

#include <algorithm>
#include <limits>

namespace fauxboard::dlp {
namespace {

/// From power-on to the main menu: panel, its test image, stick.
constexpr SimTime start_time = ms(2000);
/// Between two savings of the working times (0.08), besides those at the end of a print.
constexpr SimTime hour = ms(3'600'000);

/// Steps of the start, and when each begins.
struct StartStep {
    SimTime begin;
    std::string_view name;
};
constexpr SimTime panel_time = ms(300);
constexpr std::array<StartStep, 6> start_steps{{{ms(0), "periphery"},
                                                {ms(150), "clock"},
                                                {panel_time, "panel_configuring"},
                                                {ms(1200), "panel_to_sleep"},
                                                {ms(1300), "panel_preparing"},
                                                {ms(1850), "usb"}}};

/// Which events the board sounds its message buzzer with.
constexpr std::array loud{Event::print_not_opened, Event::print_homing_failed, Event::platform_homing_failed,
                          Event::print_finished,   Event::print_cancelled,     Event::setup_failed};

std::uint32_t add_seconds(std::uint32_t to, SimTime time) {
    const std::uint64_t sum = to + static_cast<std::uint64_t>(std::max(time, SimTime{0}) / ms(1000));
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(sum, std::numeric_limits<std::uint32_t>::max()));
}

}  // namespace

MksBoard::MksBoard(const BoardConfig& config, Stick& stick, machine::EepromCells* cells, std::uint64_t seed,
                   Listener& listener)
    : settings(default_settings(config.firmware)),
      quirks(config.quirks),
      platform(config.platform),
      panel(seed, config.fpga_version),
      print({platform, lamp, panel, stick, settings, quirks, *this, config.firmware}),
      uv_test(panel, lamp, *this),
      files(stick, config.lists_ctb),
      eeprom(cells),
      config_(config),
      stick_(stick),
      listener_(listener) {
    if (config.clock) {
        calendar.set(*config.clock, SimTime{0});
        external_clock.calendar = calendar;
    }
}

void MksBoard::power_on(SimTime now) {
    now_ = started_ = now;
    supplied_ = true;
    eeprom.cut();
    Kept kept = default_kept(config_.firmware);
    std::array<BlockState, all_blocks.size()> found{};
    for (const Block block : all_blocks) {
        found[static_cast<std::size_t>(block)] = take_block(block, eeprom.bytes(), config_.firmware, kept);
    }
    settings = kept.settings;
    counters = kept.counters;
    for (const Block block : all_blocks) {
        if (found[static_cast<std::size_t>(block)] != BlockState::good) {
            write_block(block, now);
        }
    }
    if (uses_external_clock()) {
        calendar = external_clock.calendar;
    }
    platform.stop(now);
    platform.power_on();
    lamp.power_on();
    motor.power_on();
    print.power_on();
    uv_test.power_on();
    view_ = {};
    sound_ = {};
    watch = {};
    task_ = SetupTask::none;
    task_event_.reset();
    report_.reset();
    setup_opened_ = true;
    setup_file_.clear();
    dozing_ = false;
    read_due_ = never;
    panel_due_ = now + panel_time;
    hour_due_ = config_.firmware == Firmware::v008 ? now + hour : never;
    files.home();
    ready_due_ = now + start_time;
}

void MksBoard::start_panel(SimTime now) {
    if (!panel.set_up(!quirks.reset_without_command, now)) {
        raise(Event::panel_failed);
        return;
    }
    uv_test.load(now + UvPanel::set_up_time);
}

void MksBoard::cut_power(SimTime now) {
    supplied_ = false;
    eeprom.advance(now);
    eeprom.cut();
    panel.cut_power();
    lamp.power_on();
    platform.stop(now);
}

std::string_view MksBoard::start_step(SimTime now) const {
    if (ready()) {
        return {};
    }
    std::string_view name;
    for (const StartStep& step : start_steps) {
        if (now - started_ >= step.begin) {
            name = step.name;
        }
    }
    return name;
}

SimTime MksBoard::next_event() const {
    return std::min({platform.next_event(), lamp.next_event(), print.next_event(), uv_test.next_event(),
                     motor.next_event(), eeprom.next_event(), read_due_, panel_due_, hour_due_, ready_due_});
}

void MksBoard::advance(SimTime now) {
    for (SimTime next = next_event(); next <= now; next = next_event()) {
        now_ = next;
        platform.advance(next);
        lamp.advance(next);
        eeprom.advance(next);
        if (motor.advance(next)) {
            print.forget_home();
            raise(Event::motor_off);
        }
        print.advance(next);
        uv_test.advance(next);
        if (read_due_ <= next) {
            read_due_ = never;
            read_setup(next);
        }
        if (hour_due_ <= next) {
            hour_due_ += hour;
            counters.on_s = add_seconds(counters.on_s, hour);
            count(print.worked_so_far(next), next);
        }
        if (panel_due_ <= next) {
            panel_due_ = never;
            start_panel(next);
        }
        if (task_event_ && !eeprom.writing()) {
            end_setup(*task_event_);
        }
        if (ready_due_ <= next) {
            ready_due_ = never;
            raise(Event::board_ready);
        }
        settle(next);
    }
    now_ = std::max(now_, now);
    eeprom.advance(now);
}

void MksBoard::settle(SimTime now) {
    now_ = std::max(now_, now);
    print.advance(now);
    motor.follow(print.state() != PrintState::idle, settings.motor, now);
    if (const auto worked = print.take_worked()) {
        count(worked, now);
    }
    watch.look(lamp.on() && !uv_test.light(), platform.busy(), print.active() && print.homed(),
               platform.position(now));
}

/// What a print adds to the working times, which are kept.
void MksBoard::count(const std::optional<Print::Worked>& worked, SimTime now) {
    if (worked) {
        counters.led_s = add_seconds(counters.led_s, worked->lit);
        if (!quirks.display_not_counted) {
            counters.display_s = add_seconds(counters.display_s, worked->lit);
        }
        counters.fan_s = add_seconds(counters.fan_s, worked->wall);
        counters.print_s = add_seconds(counters.print_s, worked->wall);
    }
    write_block(Block::counters, now);
}

void MksBoard::watch_event(Event event) {
    switch (event) {
        case Event::print_exposed:
            watch.exposed(lamp.last(), print.plan().exposure_s / print.antialiasing());
            break;
        case Event::print_displayed:
            watch.wrong_pictures += print.active() && (panel.white() || !print.picture_arrived()) ? 1U : 0U;
            break;
        case Event::print_finished:
        case Event::print_cancelled:
            watch.lit_at_end += lamp.on() ? 1U : 0U;
            break;
        default:
            break;
    }
}

void MksBoard::raise(Event event) {
    watch_event(event);
    if (std::find(loud.begin(), loud.end(), event) != loud.end()) {
        sound_for(settings.general.buzzer_msg_ms);
    }
    if (event == Event::files_changed || event == Event::files_deleted) {
        previews.forget();
        files.refresh();
    }
    listener_.raise(event);
}

void MksBoard::sound_for(std::uint32_t time_ms) {
    if (settings.general.buzzer != 0 && time_ms != 0) {
        sound_ = {now_ + ms(time_ms), ms(time_ms)};
    }
}

void MksBoard::touch_sound(SimTime now) {
    now_ = std::max(now_, now);
    sound_for(settings.general.buzzer_touch_ms);
}

void MksBoard::write_block(Block block, SimTime now) {
    eeprom.write(address_of(block), block_bytes(block, {settings, counters}, config_.firmware), now);
}

bool MksBoard::print_file(const std::string& path, SimTime now) {
    if (!ready()) {
        return false;
    }
    wake(now);  // who starts a print does not wait for a touch
    if (uv_test.light() || uv_test.display()) {
        uv_test.leave(now);
        uv_test.advance(uv_test.next_event() == never ? now : uv_test.next_event());
    }
    const bool started = print.start(path, now);
    settle(now);
    return started;
}

bool MksBoard::print_viewed(SimTime now) {
    return !view_.path.empty() && print_file(view_.path, now);
}

bool MksBoard::view(std::string_view name) {
    const ListedFile* const listed = files.find(name);
    if (listed == nullptr || listed->kind != FileKind::print) {
        return false;
    }
    view_ = {listed->entry.name, files.path_of(name), listed->entry.bytes, listed->date, {}, {}};
    const auto source = stick_.open(view_.path);
    if (!source) {
        view_.problem = "There is no such file, or it cannot be read.";
        return true;
    }
    auto file = PrintFile::open(*source);
    if (file) {
        view_.file = std::move(*file);
    } else {
        view_.problem = file.problem();
    }
    return true;
}

bool MksBoard::delete_viewed() {
    if (view_.path.empty() || (print.active() && print.path() == view_.path)) {
        raise(Event::files_not_deleted);
        return false;
    }
    const bool done = stick_.remove(view_.path);
    if (done) {
        view_ = {};
    }
    raise(done ? Event::files_deleted : Event::files_not_deleted);
    return done;
}

bool MksBoard::board_fan() const {
    constexpr std::uint8_t with_lamp = 1;
    constexpr std::uint8_t always = 2;
    return supplied_ &&
           (settings.general.fan_mode == always || (settings.general.fan_mode == with_lamp && lamp.fan()));
}

bool MksBoard::choose_image(unsigned image, SimTime now) {
    return !print.active() && uv_test.choose(image, from_seconds(picture_load_s(config_.firmware)), now);
}

void MksBoard::doze(SimTime now) {
    if (!print.active() && !dozing_) {
        dozing_ = true;
        uv_test.leave(now);
        panel.power_off(now);
    }
}

void MksBoard::wake(SimTime now) {
    if (dozing_) {
        dozing_ = false;
        start_panel(now);
        files.home();
        raise(Event::files_changed);
    }
}

void MksBoard::reset_counters(SimTime now) {
    counters = {};
    write_block(Block::counters, now);
}

void MksBoard::stick_changed() {
    previews.forget();
    files.home();
    listener_.raise(Event::files_changed);
}

}  // namespace fauxboard::dlp
