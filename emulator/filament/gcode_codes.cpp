// The codes of a job's file and of the lines that speak as a host: found by their letter and number. What
// they do stands in the gcode_*_codes.cpp, a table and its functions each.

#include "emulator/filament/gcode_codes.h"

#include <array>
#include <cstdint>

#include "emulator/filament/gcode_rows.h"

namespace fauxboard::filament {
namespace {

constexpr std::size_t most_codes = 2048;

std::size_t letter_index(char letter) {
    return letter == 'G' ? 0 : letter == 'M' ? 1 : letter == 'T' ? 2 : 3;
}

/// For each letter the row of each code: a job asks some hundred thousand times a second.
struct Index {
    Index() {
        for (const auto& table :
             {codes::motion_codes(), codes::heater_codes(), codes::job_codes(), codes::setting_codes()}) {
            for (const GcodeCode& row : table) {
                rows[letter_index(row.letter)][static_cast<std::size_t>(row.code)] = &row;
            }
        }
    }
    std::array<std::array<const GcodeCode*, most_codes>, 3> rows{};
};

}  // namespace

bool run_code(const GcodeCode* code, bool by_rule, GcodeSource& source, const GcodeLine& line) {
    if (code == nullptr || (code->by_rule && !by_rule)) {
        return false;
    }
    code->run(source, line);
    return true;
}

const GcodeCode* find_code(char letter, int code) {
    static const Index index;
    const std::size_t which = letter_index(letter);
    if (which >= index.rows.size() || code < 0 || code >= static_cast<int>(most_codes)) {
        return nullptr;
    }
    return index.rows[which][static_cast<std::size_t>(code)];
}

void stream_arc(GcodeSource& source) {
    Motion& motion = source.on.motion;
    motion.stream(source.arc.take(), source.arc.feed_mm_s() * motion.speed_percent() / 100.0, source.byte);
}

}  // namespace fauxboard::filament
