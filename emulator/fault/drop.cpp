#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

void edit(LineEdit& line, const Values&, Dice&) {
    line.bytes.clear();
}

}  // namespace

constinit const Kind drop{
    .name = "drop", .help = "the line is lost, with its line end", .attributes = {}, .edit = edit};

}  // namespace fauxboard::fault::rows
