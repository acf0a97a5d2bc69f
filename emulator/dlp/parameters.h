#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "emulator/dlp/settings.h"

namespace fauxboard::dlp {

/// The three ways in which the board's parser reads a number; each parameter uses one of them.
struct NumberViews {
    float decimal = 0;          ///< as atof
    std::int32_t whole = 0;     ///< as atoi, kept within 32 bits
    std::uint32_t counted = 0;  ///< as strtoul: "-1" is 4294967295
};
/// Reads a number as far as it is one; what follows it is passed over.
NumberViews read_number(std::string_view text);

enum class Section : std::uint8_t { general, z_motor, printing };

/// One parameter of a settings file: the parser, the board's fields and the reference read this row.
struct Parameter {
    Section section;
    std::string_view name;        ///< as in the file
    std::string_view value_name;  ///< as it is told: times in ms
    std::string_view unit;        ///< of the value told
    std::string_view help;
    bool whole;    ///< a number without decimals
    double least;  ///< in the unit of the file
    double most;   ///< the same; a program may allow less
    /// Puts the number read into the settings, within the bounds of its row. False when that changed it.
    bool (*take)(Settings&, const NumberViews&, const Parameter&, Firmware);
    double (*get)(const Settings&);
    Firmware since = Firmware::v001;
};

constexpr std::size_t parameter_count = 29;
/// All of them; those of 0.01 first within each section.
std::span<const Parameter, parameter_count> parameters();

}  // namespace fauxboard::dlp
