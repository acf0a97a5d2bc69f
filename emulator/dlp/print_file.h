#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/dlp/settings.h"
#include "emulator/sliced/picture_runs.h"
#include "emulator/sliced/sliced_file.h"

namespace fauxboard::dlp {

/// What rules one layer of a print.
struct LayerPlan {
    double z_mm = 0;  ///< above Z=0
    double exposure_s = 0;
    double light_off_s = 0;
    double lift_mm = 0;
    double lift_mm_s = 0;
    double drop_mm_s = 0;

    bool operator==(const LayerPlan&) const = default;
};

/// A file that this board can print: of its panel's size, with what it lacks filled in as the board does.
class PrintFile {
  public:
    /// The problem, a sentence, when it is none.
    static sliced::Outcome<PrintFile> open(const sliced::ByteSource& source);

    std::uint32_t layers() const { return file_.header().layers; }
    std::uint32_t bottom_layers() const { return file_.header().bottom_layers; }
    std::uint32_t antialiasing() const { return file_.header().level_sets; }
    double thickness_mm() const { return static_cast<double>(file_.header().layer_height_mm); }
    double resin_ml() const { return static_cast<double>(file_.header().resin_ml); }
    bool individual() const { return file_.header().individual; }
    /// As the file's header has it: what its preview page shows, and what layers without settings of their
    /// own get. Its exposure is that of a normal layer.
    const LayerPlan& common() const { return common_; }
    double bottom_exposure_s() const { return bottom_exposure_s_; }
    const sliced::SlicedFile& file() const { return file_; }

    /// Layer `n`, from 0.
    sliced::Outcome<LayerPlan> layer(const sliced::ByteSource& source, std::uint32_t n) const;
    /// Picture `sublayer` of layer `n`.
    sliced::Outcome<sliced::PictureRuns> picture(const sliced::ByteSource& source, std::uint32_t n,
                                                 std::uint32_t sublayer) const;

    /// Model higher than the platform can go, in the board's 32-bit floats.
    bool too_high(const MotorSettings& motor) const;
    /// What the board takes for the print's duration, s.
    std::uint32_t estimate_s(const MotorSettings& motor, Firmware firmware) const;

  private:
    explicit PrintFile(sliced::SlicedFile file) : file_(std::move(file)) {}
    sliced::SlicedFile file_;
    LayerPlan common_;
    double bottom_exposure_s_ = 0;
};

/// How long decoding and sending one picture takes the board.
double picture_load_s(Firmware firmware);

}  // namespace fauxboard::dlp
