#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/operand.h"
#include "emulator/behaviour/written.h"

namespace fauxboard::behaviour {

/// A line with places for values, compiled when the profile loads: "L1 X{position.x:.3f} F{motion.feed:d}".
///
/// Between braces stands a reference (see parse_reference) and, after a colon, a format: `.1f` decimals, `d`
/// a whole number (cut off, as the firmware's casts do), `s` text, `lower` text in small letters, `upper` in
/// capitals. `{{` and `}}` are braces. A number with decimals must name its format; whole numbers, booleans
/// and texts need none.
class FrameTemplate {
  public:
    FrameTemplate() = default;
    /// Throws ExpressionError.
    FrameTemplate(std::string_view source, const Names& names);

    /// Writes the line into `out`; what does not fit is cut and `cut` set. A control
    /// character out of a text (a file name) becomes '?', so that nothing can break the line.
    Written render(const Scope& scope, std::span<char> out, bool& cut) const;

  private:
    enum class Style : std::uint8_t { literal, fixed, signed_fixed, whole, hex, time, text, lower, upper };
    struct Part {
        Style style = Style::literal;
        std::uint8_t sum = 0;  ///< literal: XOR of its bytes
        int decimals = 0;
        std::size_t most = std::string_view::npos;  ///< of a text: so many bytes
        std::size_t from = 0;                       ///< literal: place in literals_
        std::size_t size = 0;
        Operand operand;
    };

    static Written write_number(const Part& part, double value, std::span<char> room);
    Written put_literal(const Part& part, std::span<char> room, bool& cut) const;
    void add_literal(std::string_view text);
    void add_value(std::string_view inside, const Names& names);

    std::string literals_;
    std::vector<Part> parts_;
};

}  // namespace fauxboard::behaviour
