#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

void edit(LineEdit& line, const Values&, Dice&) {
    line.bytes.resize(line.text_size());
}

}  // namespace

constinit const Kind merge{.name = "merge",
                           .help = "the line end is lost, so that the line and the next become one",
                           .attributes = {},
                           .edit = edit};

}  // namespace fauxboard::fault::rows
