#pragma once

#include <optional>
#include <string>

#include "emulator/dlp/panel_line.h"
#include "emulator/sliced/picture_runs.h"

namespace fauxboard::dlp {

/// A layer's picture as the lines of the panel, one at a time: pixels with half the light or more are lit.
class LineReader {
  public:
    explicit LineReader(sliced::PictureRuns runs) : runs_(std::move(runs)) {}

    /// The next of 2560 lines. A picture that ends early or goes wrong is dark from there on.
    void next(PanelLine& line);
    /// What was wrong with the picture so far, a sentence; empty when nothing.
    const std::string& problem() const { return runs_.problem(); }

  private:
    sliced::PictureRuns runs_;
    sliced::Run run_{};
    bool over_ = false;
};

}  // namespace fauxboard::dlp
