// Arbitrary bytes as a settings file of the MKS DLP board.
//
// The input is the file as it stands; its first byte chooses the board's program.

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "emulator/dlp/acfg.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using dlp::AcfgReport;
using dlp::AcfgResult;
using dlp::Firmware;
using dlp::Settings;

/// Reads it in pieces of so many bytes.
AcfgReport read(std::string_view text, std::size_t piece, Settings& settings, Firmware firmware) {
    return dlp::read_acfg(
        [&](char* out, std::size_t room) {
            const std::size_t count = text.copy(out, std::min(room, piece));
            text.remove_prefix(count);
            return count;
        },
        settings, firmware);
}

void require_bounds(const Settings& settings) {
    const dlp::MotorSettings& motor = settings.motor;
    const dlp::GeneralSettings& general = settings.general;
    require(motor.invert_dir <= 1 && std::abs(motor.home_direction) == 1, "a switch that is neither");
    require(motor.steps_per_mm >= 1 && motor.steps_per_mm <= 200'000, "steps beyond their bounds");
    require(motor.feedrate >= 0.1F && motor.acceleration >= 0.1F, "a move that never ends");
    require(motor.current_vref >= 100 && motor.current_vref <= 1000, "a current beyond its bounds");
    require(motor.hold_time_ms <= 100'000'000 && motor.off_time_ms <= 4'294'920'000,
            "a time beyond its bounds");
    require(general.screensaver_ms <= 900'000'000 && general.buzzer_msg_ms <= 15'000,
            "a time beyond its bounds");
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard::fuzz;
    const std::string input(data, data + std::min<std::size_t>(size, 1U << 16));
    const Firmware firmware = !input.empty() && (input[0] & 1) != 0 ? Firmware::v008 : Firmware::v001;
    Settings whole = fauxboard::dlp::default_settings(firmware);
    Settings pieces = whole;
    const AcfgReport report = read(input, 4096, whole, firmware);
    const AcfgReport again = read(input, 3, pieces, firmware);
    require(report.result == again.result && report.line == again.line && whole == pieces,
            "read in pieces the file is another one");
    require((report.result == AcfgResult::ok) == (report.line == 0), "an error without its line");
    require(report.taken.size() <= AcfgReport::most_taken, "a file that grows what is told of it");
    require_bounds(whole);
    return 0;
}
