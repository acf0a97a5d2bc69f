// Single frames a real A30T screen and a real A30T board sent, from the published notes on that screen: every
// checksum must verify, every field must be known, and the parts must give the same bytes again.

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "protocol/annotate.h"

using namespace fauxboard::protocol;

namespace {

// What each button sends; all printed checksums are right.
constexpr std::string_view button_frames[] = {
    "N-0 G28*62",
    "N-0 G28 X0*118",
    "N-0 G28 Y0*119",
    "N-0 G28 Z0*116",
    "N-0 M17*56",
    "N-0 M18*55",
    "N-0 G91*60",
    "N-0 G1 F6000 X30.00*48",
    "N-0 G90*61",
    "N-0 G1 F6000 X-30.00*29",
    "N-0 G1 F6000 Y30.00*49",
    "N-0 G1 F6000 Y-30.00*28",
    "N-0 G1 F500 Z30.00*1",
    "N-0 G1 F500 Z-30.00*44",
    "N-0 L1 S1*76",
    "N-0 L1 S2*79",
    "N-0 L1 S3*78",
    "N-0 L1 S4*73",
    "N-0 L1 S0*77",
    "N-0 M2140 S0*122",
    "N-0 M2140 S1*123",
    "N-0 M2140 S2*120",
    "N-0 M2140 S3*121",
    "N-0 M2140 S5*127",
    "N-0 M2140 S6*124",
    "N-0 M500*11",
    "N-0 M92 X1.00*82",
    "N-0 M92 Y1.00*83",
    "N-0 M92 Z1.00*80",
    "N-0 M92 E1.00*79",
    "N-0 M2140 R0*123",
    "N-0 M290 Z0.01*96",
    "N-0 M290 Z-0.01*77",
    "N-0 M290 Z0*79",
    "N-0 M2011 P0 S0.01*16",
    "N-0 M2011 P0 S-0.01*61",
    "N-0 M2011 P1 S0.01*17",
    "N-0 M2011 P1 S-0.01*60",
    "N-0 M2011 P0 S0*63",
    "N-0 M2011 P1 S0*62",
    "N-0 M2107 S0*121",
    "N-0 M2107 S6*127",
    "N-0 M2107 S7*126",
    "N-0 M2107 S10*72",
    "N-0 M2107 S9*112",
    "N-0 M2107 S1*120",
    "N-0 M2107 S2*123",
    "N-0 M2107 S3*122",
    "N-0 M2107 S4*125",
    "N-0 M2107 S5*124",
    "N-0 M2107 S8*113",
    "N-0 G1 F1000 Z10*25",
    "N-0 L101*15",
    "N-0 M2120 P5*122",
    "N-0 M2120 P9 S0*53",
    "N-0 M2120 P9 S1*52",
    "N-0 M2120 P0 S1*61",
    "N-0 M2120 P0 S0*60",
    "N-0 M2120 P7 S0*59",
    "N-0 M2120 P6*121",
    "N-0 M2120 P1 S0*61",
    "N-0 M2120 P1 S1*60",
    "N-0 M2120 P1 S2*63",
    "N-0 L2 S2*76",
    "N-0 L2 S3*77",
    "N-0 L2 S0*78",
    "N-0 L2 S1*79",
    "N-0 M2120 P3 S0*63",
    "N-0 M2120 P4 S0*56",
    "N-0 M2120 P3 S1*62",
    "N-0 M2120 P4 S1*57",
    "N-0 M2120 P3 S2*61",
    "N-0 M2120 P4 S2*58",
    "N-0 M2120 P3 S3*60",
    "N-0 M2120 P4 S3*59",
    "N-0 M2120 P2 S-0.50*56",
    "N-0 M165 A1.0 B0.0 C0.0*67",
    "N-0 M165 A0.0 B1.0 C0.0*67",
    "N-0 M165 A0.0 B0.0 C1.0*67",
    "N-0 M104 S200.0*84",
    "N-0 M104 S0.0*86",
    "N-0 M2105 S5*126",
    "N-0 M2105 S4*127",
    "N-0 M2105 S2*121",
    "N-0 M2105 S3*120",
    "N-0 M220 S1*76",
    "N-0 M106 P0 S255*8",
    "N-0 M106 P0 S0*10",
    "N-0 M105*10",
    "N-0 M20 LCD*87",
    "N-0 M2139*55",
    "N-0 M2139 P0 S1*53",
    "N-0 M2139 P0 S0*52",
    "N-0 M2139 P1 S1*52",
    "N-0 M2139 P1 S0*53",
    "N-0 M2139 P1 E51*23",
    "N-0 M2139 P1 E50*22",
    "N-0 M2139 P2 S1*55",
    "N-0 M2139 P2 S0*54",
    "N-0 M2139 P2 W1234*6",
    "N-0 M2139 P2 E16*23",
    "N-0 M115*11",
    "N-0 N-0 M2134 FW:V1.02.xx*39",
    "N-0 M502*9",
    "N-0 M2106 P0 S1*57",
    "N-0 M2106 P0 S0*56",
    "N-0 M27*59",
    // Buttons whose frames the notes print bare.
    "M2138 S0",
    "M2138 S1",
    "M2138 S3",
    "M2135 P6553600",
    "M2137 A25600",
    "M2137 B100",
    "M2137 C10",
    "M2137 D20",
};

constexpr std::string_view board_frames[] = {
    "N-0 L1 X198.200 Y160.000 Z15.000 F100*61",
    "N-0 L2 B:21.3 /0.0 /0 T0:27.0 /0.0 /0 T1:89.9 /0.0 /0 T2:107.5 /0.0 /0 SD:0 F0:100 F2:50 R:10 FR:5*111",
    "N-0 L3 PS:1 VL:0 MT:0 FT:0 AL:1 ST:1 WF:0 MR:100 FN:A30T/A30Tcube_colored.gco PG:0 TM:0 LA:0 LC:0*92",
    "N-0 L3 PS:2 VL:0 MT:1 FT:0 AL:1 ST:1 WF:0 MR:100 FN:A30T/A30Tcube_colored.gco PG:0 TM:0 LA:0 LC:0*94",
    "N-0 L3 PS:4 VL:0 MT:1 FT:0 AL:1 ST:1 WF:0 MR:100 FN:A30T/A30Tcube_colored.gco PG:100 TM:0 LA:1 LC:0*88",
    "N-0 L3 PS:0 VL:0 MT:1 FT:255 AL:0 ST:1 WF:0 MR:100 FN: PG:0 TM:0 LA:0 LC:0*7",
    "N-0 L7 begin file list:0*65",
    "N-0 L7 P0 Main/A30T*122",
    "N-0 L7 P4 4. Troubleshooting Guide*116",
    "N-0 L7 end file list:0*73",
    "N-0 L10 S8.50*94",
    "N-0 L11 P0 S-2.67*60",
    "N-0 L18 P26 S12*50",
    "N-0 L22 MS:0 MR:6553600 SP:100 EP:100 SH:0.00 EH:0.00*61",
    "N-0 L23 SE:1 BE:1 BP:50 CE:0 HE:0 SP:0 ST:16 HC:0 HO:0*22",
    "N-0 L24 P0 A80.00 B80.00 C400.00 D390.00*115",
    "N-0 L24 P1 A150 B150 C20 D25 E1 F5*126",
    "N-0 L24 P2 A500 B500 C500 D500 E50 F1000*120",
    "N-0 L24 P6 A0.01 B0.00*125",
    "N-0 L2 B:0.0 /0.0 /0 T0:0.0 /0.0 /0 T1:0.0 /0.0 /0 T2:0.0 /0.0 /0 SD:1 F0:0 F2:50 R:100 FR:0*100",
    "N-0 L18 P26 S1*0",
    "N-0 L21 P0 S0*63",
    // Malformed or bare, as the board sends them.
    "N-0 L14 Pausing... please try again later.*",
    "N-0 L14 file select succeed!:a30tcube_colored.gco",
    "SD printing byte 0/0",
    "Start Print:SD1:/A30T/A30Tcube_colored.gco",
    "Stop Print",
    "M2107 Z:8.00",
    "M2107 ok",
    "M2107 fail",
    "M2107 save success",
    // An A30 board: no T1, T2, no MR.
    "L2 B:21.3 /0.0 /0 T0:27.0 /0.0 /0 SD:0 F0:100 F2:50 R:10 FR:5",
    "L3 PS:0 VL:0 MT:1 FT:255 AL:0 ST:1 WF:0 FN: PG:0 TM:0 LA:0 LC:0",
};

void check(std::string_view wire, Direction direction) {
    CAPTURE(wire);
    const DecodedLine line = decode_line(wire, direction);
    CHECK(line.known());
    CHECK(line.checksum_ok());
    CHECK(encode_line(line) == wire);
    CHECK(explain(line).find("unknown") == std::string::npos);
}

}  // namespace

TEST_CASE("what the screen's buttons send") {
    for (const std::string_view wire : button_frames) {
        check(wire, Direction::to_board);
        if (wire.starts_with("N-0 ")) {
            CHECK(unframe(wire, ChecksumPolicy::required).fault == FrameFault::none);
        }
    }
}

TEST_CASE("what the board sends") {
    for (const std::string_view wire : board_frames) {
        check(wire, Direction::to_screen);
    }
}

TEST_CASE("the one printed frame that does not verify: its author took the serial number out") {
    const DecodedLine line = decode_line(
        "N-0 L9 DN:GEEETECH-A30T;DM:A30T;SN:<removed>;FV:V1.xx.03;PV:320.00 x 320.00 x 420.00;HV:V1.6;*6",
        Direction::to_screen);
    CHECK(line.known());
    CHECK_FALSE(line.checksum_ok());
    CHECK(line.checksum_expected == 102);
}
