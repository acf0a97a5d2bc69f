#pragma once

#include <memory>

#include "emulator/record/transcript_words.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::record {

/// Says what a touch screen would not have taken as it was meant: "would crash: the page table ends at 14".
/// Lines of the board are judged one after the other, with what the screen knows from those before.
LineJudge screen_judge(std::shared_ptr<const screen::ScreenProfile> profile);

}  // namespace fauxboard::record
