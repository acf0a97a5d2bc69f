#pragma once

#include <array>
#include <cstdint>

namespace fauxboard::filament {

/// Shares of the three extruder channels, percent; they add up to 100.
using Ratio = std::array<int, 3>;

/// Packs shares as the screen line does: A + 256 B + 65536 C. (0,0,100) is 6553600.
constexpr std::uint32_t pack(const Ratio& r) {
    return static_cast<std::uint32_t>(r[0]) | static_cast<std::uint32_t>(r[1]) << 8U |
           static_cast<std::uint32_t>(r[2]) << 16U;
}

/// The shares behind a packed number. False when it is not one (negative, fraction, sum other than 100).
bool unpack(double packed, Ratio& out);

/// Three-channel mixing hotend: ratio, tools, modes and height templates (M135, M165, M2135 to M2138, T0 to
/// T3).
class Mixer {
  public:
    void power_on() { *this = Mixer{}; }

    const Ratio& ratio() const { return ratio_; }
    /// M165: weights of any scale, normalised to percents; the rest of the rounding goes to the largest
    /// share. False, and nothing changed, when none is positive.
    bool set_weights(double a, double b, double c);
    bool set_packed(double packed);
    /// Gives channel `index` (0..2) `percent`; the others keep their proportion in what is left. False when
    /// out of range.
    bool set_share(int index, double percent);
    /// T0..T3: the tool's own ratio comes into force. T3 is the free one, which set_packed and set_share also
    /// write.
    bool select_tool(int tool);
    int tool() const { return tool_; }

    /// 0 off, 1 fixed ratio, 2 chosen template, 3 template by heights. Shown as mode x 256.
    bool set_mode(int mode);
    int mode() const { return mode_; }

    /// Template 1..8: pairs for T0 and T1 over 2, 10, 20 and 50 mm, from all of the tool to none of
    /// it. 9..14: the custom ones, which keep what set_start/set_end say.
    bool select_template(int number);
    int template_number() const { return template_; }
    bool set_start(double packed) { return unpack(packed, start_); }
    bool set_end(double packed) { return unpack(packed, end_); }
    bool set_start_height(double mm);
    bool set_end_height(double mm);
    const Ratio& start() const { return start_; }
    const Ratio& end() const { return end_; }
    double start_height_mm() const { return start_height_; }
    double end_height_mm() const { return end_height_; }

  private:
    Ratio ratio_{100, 0, 0};
    std::array<Ratio, 4> tools_{{{100, 0, 0}, {0, 100, 0}, {0, 0, 100}, {34, 33, 33}}};
    Ratio start_{100, 0, 0};
    Ratio end_{100, 0, 0};
    double start_height_ = 0;
    double end_height_ = 0;
    int tool_ = 0;
    int mode_ = 0;
    int template_ = 0;
};

}  // namespace fauxboard::filament
