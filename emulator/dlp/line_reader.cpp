#include "emulator/dlp/line_reader.h"

#include <algorithm>

namespace fauxboard::dlp {

void LineReader::next(PanelLine& line) {
    constexpr std::uint32_t half_light = 128;
    line.fill(0);
    std::uint32_t column = 0;
    while (column < panel_columns && !over_) {
        if (run_.pixels == 0 && !runs_.next(run_)) {
            over_ = true;
            return;
        }
        const std::uint32_t count = std::min(run_.pixels, panel_columns - column);
        if (run_.value >= half_light) {
            light(line, column, column + count);
        }
        run_.pixels -= count;
        column += count;
    }
}

}  // namespace fauxboard::dlp
