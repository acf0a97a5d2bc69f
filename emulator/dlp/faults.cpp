// What can go wrong with the MKS DLP board and its machine.

#include <array>

#include "emulator/dlp/event_rows.h"
#include "emulator/dlp/kind.h"
#include "emulator/dlp/printer.h"
#include "emulator/machine/fault_row.h"

namespace fauxboard::dlp {
namespace {

using machine::FaultParameter;
using Values = const machine::FaultValues&;
using machine::fault_row;
using enum machine::FaultUnit;

constexpr std::array panel_failed_event{event("panel.failed")};
constexpr std::array homing_failed_events{event("print.homing_failed"), event("platform.homing_failed")};
constexpr std::array read_error_event{event("print.read_error")};
constexpr std::array power_lost_event{event("power.lost")};

constexpr std::array clock_event{event("clock.not_set")};

constexpr std::array<std::string_view, 2> levels{"low", "high"};
constexpr std::array<std::string_view, 2> switches{"lower", "upper"};
constexpr FaultParameter switch_parameter{"switch", choice, 0, 0, 1, "which switch", switches};

constexpr std::array crc_parameters{
    FaultParameter{"share", percent, 1, 0, 100, "how many of the packets arrive damaged"}};
constexpr std::array line_parameters{
    FaultParameter{"line", number, 0, 0, 2559, "line whose packets always arrive damaged"}};
constexpr std::array pin_parameters{
    FaultParameter{"level", choice, 0, 0, 1, "what it says: low is bad, high is good", levels}};
constexpr std::array white_parameters{
    FaultParameter{"share", percent, 100, 0, 100, "how often it goes wrong; of real ones one in seven"}};
constexpr std::array switch_only{switch_parameter};
constexpr std::array slow_parameters{
    FaultParameter{"factor", number, 5, 1, 1000, "how many times as long a picture takes"}};
constexpr std::array cut_parameters{
    FaultParameter{"share", percent, 50, 0, 100, "how much of the next writing is done by then"}};
constexpr std::array lost_parameters{
    FaultParameter{"share", percent, 5, 1, 100, "how much of each way is lost"}};

constexpr std::array shift_parameters{
    FaultParameter{"x", number, 40, -480, 480, "pixels to the right of the finger"},
    FaultParameter{"y", number, 0, -320, 320, "pixels below it"}};

/// Changes what is wrong with the FPGA.
template <class F>
void fpga(Printer& p, F change) {
    change(p.board.panel.fpga().trouble);
}

/// The same of the platform.
template <class F>
void platform(Printer& p, F change) {
    PlatformTrouble trouble = p.board.platform.trouble();
    change(trouble);
    p.board.platform.set_trouble(trouble, p.now());
}

void set_switch(Printer& p, Values v, SwitchState state) {
    platform(p, [&](PlatformTrouble& trouble) { (v[0] == 0 ? trouble.lower : trouble.upper) = state; });
}

void slow_stick(Printer& p, double factor) {
    p.board.print.load_factor = factor;
}

constexpr std::array table{
    fault_row<Printer>(
        "panel_crc",
        "some packets to the UV panel arrive damaged: the board sends them again, up to five times", {}, "",
        crc_parameters, never,
        [](Printer& p, Values v) { fpga(p, [&](auto& t) { t.bad_share = v[0] / 100; }); },
        [](Printer& p, Values) { fpga(p, [](auto& t) { t.bad_share = 0; }); }, nullptr),
    fault_row<Printer>(
        "panel_line",
        "one line of the UV panel's pictures never arrives: after five more tries it keeps what it had", {},
        "", line_parameters, never,
        [](Printer& p, Values v) { fpga(p, [&](auto& t) { t.bad_line = static_cast<unsigned>(v[0]); }); },
        [](Printer& p, Values) { fpga(p, [](auto& t) { t.bad_line.reset(); }); }, nullptr),
    fault_row<Printer>(
        "panel_pin_stuck", "the pin that tells of a packet's checksum always says the same", {}, "",
        pin_parameters, never,
        [](Printer& p, Values v) { fpga(p, [&](auto& t) { t.stuck_pin = v[0] != 0; }); },
        [](Printer& p, Values) { fpga(p, [](auto& t) { t.stuck_pin.reset(); }); }, nullptr),
    fault_row<Printer>(
        "panel_read_back",
        "the FPGA's command byte reads back wrong: the board writes it five times and goes on", {}, "", {},
        never, [](Printer& p, Values) { fpga(p, [](auto& t) { t.wrong_read_back = true; }); },
        [](Printer& p, Values) { fpga(p, [](auto& t) { t.wrong_read_back = false; }); }, nullptr),
    fault_row<Printer>(
        "panel_sdram",
        "the SDRAM behind the FPGA is dead: checksums are good, nothing is stored, the panel is all white",
        {}, "", {}, never, [](Printer& p, Values) { fpga(p, [](auto& t) { t.sdram_stuck = true; }); },
        [](Printer& p, Values) { fpga(p, [](auto& t) { t.sdram_stuck = false; }); }, nullptr),
    fault_row<Printer>(
        "panel_white",
        "the board resets the FPGA without telling it to be quiet first: while a picture was read, its SDRAM "
        "then comes up dead, and the panel is all white until a clean reset",
        {}, "", white_parameters, never,
        [](Printer& p, Values v) {
            fpga(p, [&](auto& t) { t.unclean_share = v[0] / 100; });
            p.board.panel.reset_rudely = true;
        },
        [](Printer& p, Values) {
            fpga(p, [](auto& t) { t.unclean_share = FpgaTrouble{}.unclean_share; });
            p.board.panel.reset_rudely = false;
        },
        nullptr),
    fault_row<Printer>(
        "panel_id_missing",
        "the controllers of the UV panel do not answer with their id when the board starts or wakes",
        panel_failed_event, "", {}, never, [](Printer& p, Values) { p.board.panel.id_missing = true; },
        [](Printer& p, Values) { p.board.panel.id_missing = false; }, nullptr),
    fault_row<Printer>(
        "switch_open", "a switch at the end of the axis never closes: homing runs its whole way and fails",
        homing_failed_events, "", switch_only, never,
        [](Printer& p, Values v) { set_switch(p, v, SwitchState::never_closes); },
        [](Printer& p, Values v) { set_switch(p, v, SwitchState::works); }, nullptr),
    fault_row<Printer>(
        "switch_closed", "a switch at the end of the axis never opens: homing fails before it begins",
        homing_failed_events, "", switch_only, never,
        [](Printer& p, Values v) { set_switch(p, v, SwitchState::never_opens); },
        [](Printer& p, Values v) { set_switch(p, v, SwitchState::works); }, nullptr),
    fault_row<Printer>(
        "stick_slow", "the stick is slow: a layer's picture takes longer to load", {}, "", slow_parameters,
        never, [](Printer& p, Values v) { slow_stick(p, v[0]); },
        [](Printer& p, Values) { slow_stick(p, 1); }, nullptr),
    fault_row<Printer>(
        "stick_errors",
        "the stick is there and gives nothing: a print pauses in the dark, and resuming tries again",
        read_error_event, "", {}, never, [](Printer& p, Values) { p.read_errors = true; },
        [](Printer& p, Values) { p.read_errors = false; }, nullptr),
    fault_row<Printer>(
        "eeprom_cut",
        "the supply fails in the middle of the next writing to the EEPROM; half a second later the board "
        "starts",
        power_lost_event, "the next writing", cut_parameters, never,
        [](Printer& p, Values v) { p.cut_next_write(v[0] / 100); },
        [](Printer& p, Values) { p.cut_next_write(std::nullopt); },
        [](const Printer& p, Values) { return !p.cuts_next_write(); }),
    fault_row<Printer>(
        "led_dead", "the UV lamp stays dark; the board counts its time and notices nothing", {}, "", {},
        never, [](Printer& p, Values) { p.board.lamp.fail(p.now()); },
        [](Printer& p, Values) { p.board.lamp.dead = false; }, nullptr),
    fault_row<Printer>(
        "steps_lost", "the motor loses steps: the platform is not where the board counts it", {}, "",
        lost_parameters, never,
        [](Printer& p, Values v) { platform(p, [&](auto& t) { t.lost_share = v[0] / 100; }); },
        [](Printer& p, Values) { platform(p, [](auto& t) { t.lost_share = 0; }); }, nullptr),
    fault_row<Printer>(
        "clock_dead",
        "the clock chip beside the board does not answer: a box says so when it is set, and the board goes "
        "by "
        "its own clock (0.08, with use_external_clock = 1)",
        clock_event, "", {}, never, [](Printer& p, Values) { p.board.external_clock.dead = true; },
        [](Printer& p, Values) { p.board.external_clock.dead = false; }, nullptr),
    fault_row<Printer>(
        "touch_shifted",
        "the touch sensor feels the finger beside where it is, until it is calibrated (0.08) or mended", {},
        "", shift_parameters, never,
        [](Printer& p, Values v) {
            p.board.sensor_shift = {v[0], v[1]};
        },
        [](Printer& p, Values) { p.board.sensor_shift = {}; }, nullptr),
};

}  // namespace

std::span<const machine::FaultInfo> own_faults() {
    return table;
}

}  // namespace fauxboard::dlp
