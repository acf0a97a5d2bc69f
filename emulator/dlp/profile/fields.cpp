// Print, platform, lamp, panel, files, settings, clock.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "emulator/behaviour/field_rows.h"
#include "emulator/dlp/printer.h"
#include "emulator/dlp/profile/tables.h"

namespace fauxboard::dlp {
namespace {

using behaviour::Field;
using behaviour::Value;
using enum behaviour::FieldType;

constexpr behaviour::FieldRows<Printer> row;

/// A value that is only shown; `F` takes the board and the time.
template <class F>
constexpr Field seen(std::string_view path, behaviour::FieldType type, std::string_view unit,
                     std::string_view help, F) {
    return row.shown(path, type, unit, help, [](const Printer& p) { return F{}(p.board, p.now()); });
}

/// A value that is changed, too; `S` takes the board and a number.
template <class G, class S>
constexpr Field changed(std::string_view path, behaviour::FieldType type, std::string_view unit, double min,
                        double max, std::string_view help, G, S) {
    return row.handled(
        path, type, unit, min, max, help, [](const Printer& p) { return G{}(p.board, p.now()); },
        [](Printer& p, const Value& v) { S{}(p.board, v.number, p.now()); });
}

/// A number that lies in the board's state; `F` gives a reference to it.
template <class F>
constexpr Field kept(std::string_view path, behaviour::FieldType type, std::string_view unit, double min,
                     double max, std::string_view help, F) {
    return row.handled(
        path, type, unit, min, max, help, [](const Printer& p) { return F{}(p.board); },
        [](Printer& p, const Value& v) {
            auto& slot = F{}(p.board);
            slot = static_cast<std::remove_reference_t<decltype(slot)>>(v.number);
        });
}

#define FAUXBOARD_DLP_SEEN(expression) [](const MksBoard& b, SimTime now) { return (void)now, (expression); }
#define FAUXBOARD_DLP_PLACE(member) \
    [](auto& b) -> auto& {          \
        return b.member;            \
    }

std::string_view setup_error(const MksBoard& b) {
    return !b.setup_opened()                            ? "not_opened"
           : !b.setup_report()                          ? ""
           : b.setup_report()->result == AcfgResult::ok ? ""
                                                        : to_string(b.setup_report()->result);
}

constexpr std::array print_rows{
    seen(
        "print.state", text, "",
        "of the motion: idle, homing_preup, homing_fast, homing_up, homing_slow, free_moving, move_to_layer, "
        "light_pause, light, lift, drop, pause_lift, last_lift",
        FAUXBOARD_DLP_SEEN(to_string(b.print.state()))),
    seen("print.active", boolean, "", "a print is under way, its homing and its last lift included",
         FAUXBOARD_DLP_SEEN(b.print.active())),
    seen("print.finishing", boolean, "", "its last lift is under way",
         FAUXBOARD_DLP_SEEN(b.print.finishing())),
    seen("print.cancelled", boolean, "", "somebody stopped it", FAUXBOARD_DLP_SEEN(b.print.cancelled())),
    seen("print.paused", boolean, "", "it is to pause, or does", FAUXBOARD_DLP_SEEN(b.print.paused())),
    seen("print.standing", boolean, "", "it has paused, and the platform stands",
         FAUXBOARD_DLP_SEEN(b.print.standing())),
    seen("print.file", text, "", "name of its file",
         FAUXBOARD_DLP_SEEN(std::string_view(b.print.path()).substr(b.print.path().rfind('/') + 1))),
    seen("print.path", text, "", "path of its file on the stick",
         FAUXBOARD_DLP_SEEN(std::string_view(b.print.path()))),
    seen("print.layer", integer, "", "layer under way, from 1", FAUXBOARD_DLP_SEEN(b.print.layer())),
    seen("print.layers", integer, "", "layers of the file", FAUXBOARD_DLP_SEEN(b.print.layers())),
    seen("print.z_mm", number, "mm", "height of the layer above Z=0",
         FAUXBOARD_DLP_SEEN(b.print.plan().z_mm)),
    seen("print.percent", number, "%", "layer of layers, in the board's 32-bit floats",
         FAUXBOARD_DLP_SEEN(b.print.percent())),
    seen("print.elapsed_s", integer, "s", "printed so far; homing, pauses and the last lift are left out",
         FAUXBOARD_DLP_SEEN(std::floor(to_seconds(b.print.elapsed(now))))),
    seen("print.wall_s", integer, "s", "since its start, all included",
         FAUXBOARD_DLP_SEEN(std::floor(to_seconds(b.print.wall(now))))),
    seen("print.estimate_s", integer, "s", "what the board takes for the whole print",
         FAUXBOARD_DLP_SEEN(b.print.estimate_s())),
    seen("print.antialiasing", integer, "", "pictures of a layer",
         FAUXBOARD_DLP_SEEN(b.print.antialiasing())),
    seen("print.sublayer", integer, "", "picture of the layer that is exposed, from 1; 0 in the dark",
         FAUXBOARD_DLP_SEEN(b.print.sublayer())),
    seen("print.has_individual", boolean, "", "the file has settings for each layer",
         FAUXBOARD_DLP_SEEN(b.print.file() && b.print.file()->individual())),
    changed("print.individual", boolean, "", 0, 1, "they rule, from the next layer on that is read",
            FAUXBOARD_DLP_SEEN(
                b.print.changes.individual.value_or(b.print.file() && b.print.file()->individual())),
            [](MksBoard& b, double v, SimTime) { b.print.changes.individual = v != 0; }),
    seen("print.problem", text, "", "why the last file could not be opened or read",
         FAUXBOARD_DLP_SEEN(std::string_view(b.print.problem()))),
    seen("print.bad_layers", integer, "", "layers of which the panel never took a line",
         FAUXBOARD_DLP_SEEN(b.print.bad_layers())),
};

/// A setting of the print that can be changed while it runs (0.08).
#define FAUXBOARD_DLP_CHANGE(path, unit, most, help, member, common)                               \
    changed(path, number, unit, 0, most, help ", from the next layer on that is read",             \
            FAUXBOARD_DLP_SEEN(                                                                    \
                b.print.changes.member.value_or(b.print.file() ? (b.print.file()->common) : 0.0)), \
            [](MksBoard& b, double v, SimTime) { b.print.changes.member = v; })

constexpr std::array change_rows{
    FAUXBOARD_DLP_CHANGE("print.bottom_light_s", "s", 86'400, "exposure of a bottom layer", bottom_light_s,
                         bottom_exposure_s()),
    FAUXBOARD_DLP_CHANGE("print.light_s", "s", 86'400, "exposure of a layer", light_s, common().exposure_s),
    FAUXBOARD_DLP_CHANGE("print.light_pause_s", "s", 86'400, "dark before the exposure", light_pause_s,
                         common().light_off_s),
    FAUXBOARD_DLP_CHANGE("print.lift_mm", "mm", 1000, "lift", lift_mm, common().lift_mm),
    FAUXBOARD_DLP_CHANGE("print.lift_mm_s", "mm/s", 100, "speed of the lift", lift_mm_s, common().lift_mm_s),
    FAUXBOARD_DLP_CHANGE("print.drop_mm_s", "mm/s", 100, "speed of the way down", drop_mm_s,
                         common().drop_mm_s),
};

constexpr std::array machine_rows{
    seen("platform.z", number, "mm", "place of the platform as the board counts it",
         FAUXBOARD_DLP_SEEN(b.platform.position(now))),
    seen("platform.height", number, "mm", "the same above Z=0",
         FAUXBOARD_DLP_SEEN(b.platform.position(now) - static_cast<double>(b.settings.general.zero_pos_mm))),
    seen("platform.true_z", number, "mm", "where it really is, over the lower switch",
         FAUXBOARD_DLP_SEEN(b.platform.true_position(now))),
    kept("platform.zero", number, "mm", -32'000, 32'000, "Z=0 as the user set it",
         FAUXBOARD_DLP_PLACE(settings.general.zero_pos_mm)),
    seen("platform.homed", boolean, "", "the board knows where it is", FAUXBOARD_DLP_SEEN(b.print.homed())),
    seen("platform.moving", boolean, "", "it moves", FAUXBOARD_DLP_SEEN(b.platform.busy())),
    seen("platform.homing", boolean, "", "it is being homed", FAUXBOARD_DLP_SEEN(b.print.homing())),
    seen("platform.going", text, "", "up, down, or nothing",
         FAUXBOARD_DLP_SEEN(std::string_view(b.platform.speed() > 0   ? "up"
                                             : b.platform.speed() < 0 ? "down"
                                                                      : ""))),
    seen("platform.speed", number, "mm/s", "highest of the move under way; down is negative",
         FAUXBOARD_DLP_SEEN(b.platform.speed())),
    seen("motor.state", text, "", "off, hold, run", FAUXBOARD_DLP_SEEN(to_string(b.motor.state()))),
    seen("motor.current_ma", number, "mA", "current of the motor",
         FAUXBOARD_DLP_SEEN(b.motor.current_ma(b.settings.motor))),
    seen("switch.lower", boolean, "", "the lower switch is closed",
         FAUXBOARD_DLP_SEEN(b.platform.lower_closed(now))),
    seen("switch.upper", boolean, "", "the upper switch is closed",
         FAUXBOARD_DLP_SEEN(b.platform.upper_closed(now))),
    seen("lamp.on", boolean, "", "the UV lamp shines", FAUXBOARD_DLP_SEEN(b.lamp.on())),
    seen("lamp.left_ms", integer, "ms", "until it goes out by itself",
         FAUXBOARD_DLP_SEEN(b.lamp.left(now) / ms(1))),
    seen("lamp.exposure_s", number, "s", "how long it shone last",
         FAUXBOARD_DLP_SEEN(to_seconds(b.lamp.last()))),
    seen("fan.uv", boolean, "", "the fan of the lamp runs", FAUXBOARD_DLP_SEEN(b.lamp.fan())),
    seen("fan.board", boolean, "",
         "the board's own fan runs (0.08); setup.mb_fan_mode: 0 off, 1 with the lamp's fan, 2 always",
         FAUXBOARD_DLP_SEEN(b.board_fan())),
    seen("buzzer.sounding", boolean, "", "the buzzer sounds", FAUXBOARD_DLP_SEEN(b.sound().until > now)),
    seen("buzzer.last_ms", integer, "ms", "its last sound", FAUXBOARD_DLP_SEEN(b.sound().last / ms(1))),
    seen("panel.awake", boolean, "", "the controllers of the UV panel are awake",
         FAUXBOARD_DLP_SEEN(b.panel.awake())),
    seen("panel.powered", boolean, "", "the UV panel has its supply", FAUXBOARD_DLP_SEEN(b.panel.powered())),
    seen("panel.showing", boolean, "", "it shows a picture", FAUXBOARD_DLP_SEEN(b.panel.showing())),
    seen("panel.white", boolean, "", "it is all white, whatever it was sent",
         FAUXBOARD_DLP_SEEN(b.panel.white())),
    seen("panel.command", integer, "", "command byte of the FPGA, without its version",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().command())),
    seen("panel.bank", integer, "", "bank that the command byte names",
         FAUXBOARD_DLP_SEEN(bank_of(b.panel.fpga().command()))),
    seen("panel.lit", integer, "pixels", "lit ones that can be seen", FAUXBOARD_DLP_SEEN(b.panel.lit())),
    seen("panel.md5", text, "", "of the 2560 packets of the picture in that bank",
         FAUXBOARD_DLP_SEEN(std::string_view(b.panel.fpga().md5(bank_of(b.panel.fpga().command()))))),
    seen("panel.bank0_lit", integer, "pixels", "lit ones in the work bank",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().lit_pixels(0))),
    seen("panel.bank1_lit", integer, "pixels", "lit ones in the bank of the test images",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().lit_pixels(1))),
    seen("panel.bank2_lit", integer, "pixels", "lit ones in the clean bank",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().lit_pixels(2))),
    seen("panel.bank3_lit", integer, "pixels", "lit ones in the spare bank",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().lit_pixels(3))),
    seen("fpga.version", integer, "", "version nibble that is read back",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().version())),
    seen("fpga.packets", integer, "", "packets that came, since power-on",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().counters().packets)),
    seen("fpga.crc_errors", integer, "", "of them with a wrong checksum",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().counters().crc_errors)),
    seen("fpga.commands", integer, "", "command bytes written",
         FAUXBOARD_DLP_SEEN(b.panel.fpga().counters().commands)),
    seen("fpga.failed_commands", integer, "", "commands that never read back in five times",
         FAUXBOARD_DLP_SEEN(b.panel.counters().failed_commands)),
    seen("fpga.retries", integer, "", "packets sent again", FAUXBOARD_DLP_SEEN(b.panel.counters().resends)),
    seen("fpga.data_retries", integer, "", "of them with light",
         FAUXBOARD_DLP_SEEN(b.panel.counters().data_retries)),
    seen("fpga.fill_retries", integer, "", "of them all dark",
         FAUXBOARD_DLP_SEEN(b.panel.counters().fill_retries)),
    seen("fpga.failed_lines", integer, "", "lines given up after five times",
         FAUXBOARD_DLP_SEEN(b.panel.counters().failed_lines)),
};

#define FAUXBOARD_DLP_VIEW(expression, otherwise) \
    FAUXBOARD_DLP_SEEN(b.viewed().file ? (b.viewed().file->expression) : (otherwise))

constexpr std::array view_rows{
    seen("view.ok", boolean, "", "the file chosen can be printed",
         FAUXBOARD_DLP_SEEN(b.viewed().file.has_value())),
    seen("view.problem", text, "", "why not", FAUXBOARD_DLP_SEEN(std::string_view(b.viewed().problem))),
    seen("view.name", text, "", "its name", FAUXBOARD_DLP_SEEN(std::string_view(b.viewed().name))),
    seen("view.path", text, "", "its path on the stick",
         FAUXBOARD_DLP_SEEN(std::string_view(b.viewed().path))),
    seen("view.bytes", integer, "bytes", "its size", FAUXBOARD_DLP_SEEN(b.viewed().bytes)),
    seen("view.date", text, "", "when it was written: YYYY-MM-DD HH:MM",
         FAUXBOARD_DLP_SEEN(std::string_view(b.viewed().date))),
    seen("view.layers", integer, "", "layers", FAUXBOARD_DLP_VIEW(layers(), 0U)),
    seen("view.seconds", integer, "s", "estimate of its print",
         FAUXBOARD_DLP_VIEW(estimate_s(b.settings.motor, b.config().firmware), 0U)),
    seen("view.thickness", number, "mm", "of a layer", FAUXBOARD_DLP_VIEW(thickness_mm(), 0.0)),
    seen("view.antialiasing", integer, "", "pictures of a layer", FAUXBOARD_DLP_VIEW(antialiasing(), 0U)),
    seen("view.light_s", number, "s", "exposure", FAUXBOARD_DLP_VIEW(common().exposure_s, 0.0)),
    seen("view.bottom_light_s", number, "s", "exposure of bottom layers",
         FAUXBOARD_DLP_VIEW(bottom_exposure_s(), 0.0)),
    seen("view.light_pause_s", number, "s", "dark before the exposure",
         FAUXBOARD_DLP_VIEW(common().light_off_s, 0.0)),
    seen("view.lift_mm", number, "mm", "lift", FAUXBOARD_DLP_VIEW(common().lift_mm, 0.0)),
    seen("view.lift_mm_s", number, "mm/s", "its speed", FAUXBOARD_DLP_VIEW(common().lift_mm_s, 0.0)),
    seen("view.drop_mm_s", number, "mm/s", "speed of the way down",
         FAUXBOARD_DLP_VIEW(common().drop_mm_s, 0.0)),
    seen("view.resin_ml", number, "ml", "resin", FAUXBOARD_DLP_VIEW(resin_ml(), 0.0)),
    seen("view.individual", boolean, "", "layers have settings of their own",
         FAUXBOARD_DLP_VIEW(individual(), false)),
    seen("view.too_high", boolean, "", "the model is higher than the axis",
         FAUXBOARD_DLP_VIEW(too_high(b.settings.motor), false)),
    seen("files.folder", text, "", "folder shown: /, /dir/, /dir/sub/",
         FAUXBOARD_DLP_SEEN(std::string_view(b.files.shown()))),
    seen("files.root", boolean, "", "it is the root", FAUXBOARD_DLP_SEEN(b.files.folder().empty())),
    seen("files.count", integer, "", "entries of it that are listed",
         FAUXBOARD_DLP_SEEN(b.files.files().size())),
    seen("files.stick", boolean, "", "a stick is in", FAUXBOARD_DLP_SEEN(b.stick().present() && !b.dozing())),
};

constexpr double most_factor = 100;
constexpr double most_shift = 10'000;

/// Coefficient `I` of the touch sensor's calibration.
template <std::size_t I>
constexpr Field calibration_row(std::string_view path, double most) {
    return kept(
        path, number, most == most_shift ? "px" : "", -most, most,
        "calibration of the touch sensor (0.08): x = xx X + xy Y + x0, y = yx X + yy Y + y0",
        [](auto& b) -> auto& { return b.settings.general.touch[I]; });
}

constexpr std::array other_rows{
    kept("setup.language", integer, "", 0, 1, "0 English, 1 Russian",
         FAUXBOARD_DLP_PLACE(settings.general.language)),
    kept("setup.pause_lift", number, "mm", 0, 1000, "lift beyond that of the layer, on a pause",
         FAUXBOARD_DLP_PLACE(settings.general.pause_lift_mm)),
    kept("setup.buzzer", boolean, "", 0, 1, "the buzzer may sound",
         FAUXBOARD_DLP_PLACE(settings.general.buzzer)),
    kept("setup.end_lift", number, "mm", 0, 1000, "lift after a print (0.08)",
         FAUXBOARD_DLP_PLACE(settings.general.end_lift_mm)),
    seen("setup.busy", text, "", "nothing, loading or saving",
         FAUXBOARD_DLP_SEEN(std::string_view(b.setup_task() == SetupTask::loading  ? "loading"
                                             : b.setup_task() == SetupTask::saving ? "saving"
                                                                                   : ""))),
    seen("setup.error", text, "",
         "of the settings file loaded last: nothing, unknown_section, unknown_param, invalid_value, "
         "not_opened",
         FAUXBOARD_DLP_SEEN(setup_error(b))),
    seen("setup.error_line", integer, "", "line of it",
         FAUXBOARD_DLP_SEEN(b.setup_report() ? b.setup_report()->line : 0U)),
    seen("setup.file", text, "", "its path as the board tells it: 0:/NAME",
         FAUXBOARD_DLP_SEEN(std::string_view(b.setup_file()))),
    seen("uvtest.image", integer, "", "test image chosen, 1 to 3", FAUXBOARD_DLP_SEEN(b.uv_test.image())),
    seen("uvtest.loading", boolean, "", "it is on its way to the panel",
         FAUXBOARD_DLP_SEEN(b.uv_test.loading())),
    seen("uvtest.light", boolean, "", "the lamp is on by hand", FAUXBOARD_DLP_SEEN(b.uv_test.light())),
    seen("uvtest.display", boolean, "", "the panel is on by hand", FAUXBOARD_DLP_SEEN(b.uv_test.display())),
    seen("clock.external", boolean, "", "the clock chip beside the board answers (0.08)",
         FAUXBOARD_DLP_SEEN(!b.external_clock.dead)),
    seen("touch.shift_x", number, "px", "how far to the right of the finger the touch sensor feels it",
         FAUXBOARD_DLP_SEEN(b.sensor_shift.x)),
    seen("touch.shift_y", number, "px", "how far below it", FAUXBOARD_DLP_SEEN(b.sensor_shift.y)),
    calibration_row<0>("setup.touch_xx", most_factor),
    calibration_row<1>("setup.touch_xy", most_factor),
    calibration_row<2>("setup.touch_x0", most_shift),
    calibration_row<3>("setup.touch_yx", most_factor),
    calibration_row<4>("setup.touch_yy", most_factor),
    calibration_row<5>("setup.touch_y0", most_shift),
    seen("clock.weekday", integer, "", "1 Monday to 7 Sunday", FAUXBOARD_DLP_SEEN(b.calendar.weekday(now))),
    kept("counters.led_s", integer, "s", 0, 4e9, "the lamp has shone", FAUXBOARD_DLP_PLACE(counters.led_s)),
    kept("counters.display_s", integer, "s", 0, 4e9, "the panel has worked",
         FAUXBOARD_DLP_PLACE(counters.display_s)),
    kept("counters.fan_s", integer, "s", 0, 4e9, "the fan has run", FAUXBOARD_DLP_PLACE(counters.fan_s)),
    kept("counters.print_s", integer, "s", 0, 4e9, "time of all prints",
         FAUXBOARD_DLP_PLACE(counters.print_s)),
    kept("counters.on_s", integer, "s", 0, 4e9, "the board was on (0.08)",
         FAUXBOARD_DLP_PLACE(counters.on_s)),
    seen("watch.broken", integer, "", "what must never happen and did, all of the next ones",
         FAUXBOARD_DLP_SEEN(b.watch.broken())),
    seen("watch.lit_moving", integer, "",
         "moments in which the lamp was on, not by hand, and the platform moved",
         FAUXBOARD_DLP_SEEN(b.watch.lit_moving)),
    seen("watch.into_model", integer, "", "moments in which the platform was lower than what it had printed",
         FAUXBOARD_DLP_SEEN(b.watch.into_model)),
    seen("watch.wrong_pictures", integer, "", "pictures displayed that are not the file's",
         FAUXBOARD_DLP_SEEN(b.watch.wrong_pictures)),
    seen("watch.lit_at_end", integer, "", "ends of prints with the lamp on",
         FAUXBOARD_DLP_SEEN(b.watch.lit_at_end)),
    seen("watch.exposure_error_ms", number, "ms", "most that an exposure differed from the file's",
         FAUXBOARD_DLP_SEEN(b.watch.exposure_error_ms)),
    seen("eeprom.writing", boolean, "", "bytes are being written", FAUXBOARD_DLP_SEEN(b.eeprom.writing())),
    seen("board.ready", boolean, "", "the start is over", FAUXBOARD_DLP_SEEN(b.ready())),
    seen("board.step", text, "",
         "of the start: periphery, clock, panel_configuring, panel_to_sleep, panel_preparing, usb",
         FAUXBOARD_DLP_SEEN(b.start_step(now))),
    seen("board.dozing", boolean, "", "idle under its screensaver: no stick, no panel",
         FAUXBOARD_DLP_SEEN(b.dozing())),
};

/// Part `Member` of the clock.
template <int Moment::*Member>
constexpr Field clock_row(std::string_view path, double min, double max, std::string_view help) {
    return row.handled(
        path, integer, "", min, max, help,
        [](const Printer& p) { return p.board.calendar.at(p.now()).*Member; },
        [](Printer& p, const Value& v) {
            Moment moment = p.board.calendar.at(p.now());
            moment.*Member = static_cast<int>(v.number);
            moment.day = std::min(moment.day, month_length(moment.year, moment.month));
            p.board.calendar.set(moment, p.now());
        });
}
constexpr std::array clock_rows{
    clock_row<&Moment::year>("clock.year", 2000, 2099, "of the board's clock"),
    clock_row<&Moment::month>("clock.month", 1, 12, "same"),
    clock_row<&Moment::day>("clock.day", 1, 31, "same"),
    clock_row<&Moment::hour>("clock.hour", 0, 23, "same"),
    clock_row<&Moment::minute>("clock.minute", 0, 59, "same"),
    clock_row<&Moment::second>("clock.second", 0, 59, "same"),
};

/// A parameter of settings files as a field: setup.NAME, as it is in force. One that is told in the unit of
/// the file, as all but times are, can be set, too, within the bounds that hold for the file.
template <std::size_t I>
Field parameter_row() {
    static const std::string path = "setup." + std::string(parameters()[I].value_name);
    const Parameter& parameter = parameters()[I];
    const auto get = [](const Printer& p) {
        return parameters()[I].since <= p.board.config().firmware ? parameters()[I].get(p.board.settings)
                                                                  : 0.0;
    };
    if (parameter.unit == "ms") {
        return row.shown(path, number, parameter.unit, parameter.help, get);
    }
    constexpr double furthest = 1e9;  // of a parameter that files do not bound
    return row.handled(
        path, parameter.whole ? integer : number, parameter.unit, std::max(parameter.least, -furthest),
        std::min(parameter.most, furthest), parameter.help, get, [](Printer& p, const Value& v) {
            const Parameter& own = parameters()[I];
            static_cast<void>(own.take(p.board.settings, read_number(fmt::format("{:.6f}", v.number)), own,
                                       p.board.config().firmware));
        });
}

template <std::size_t... I>
std::vector<Field> all_rows(std::index_sequence<I...>) {
    std::vector<Field> rows;
    const auto add = [&rows](const auto& part) { rows.insert(rows.end(), part.begin(), part.end()); };
    add(print_rows), add(change_rows), add(machine_rows), add(view_rows), add(clock_rows), add(other_rows);
    (rows.push_back(parameter_row<I>()), ...);
    return rows;
}

}  // namespace

std::span<const Field> fields() {
    static const std::vector<Field> table = all_rows(std::make_index_sequence<parameter_count>{});
    return table;
}

}  // namespace fauxboard::dlp
