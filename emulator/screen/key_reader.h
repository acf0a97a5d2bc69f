#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/screen/judgement.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::screen {

/// Reads the keys of one frame. The place in the text moves on as the firmware's pointer does.
class KeyReader {
  public:
    /// `frame_end` is where the checksum of a frame begins that this screen does not take off.
    KeyReader(std::string_view text, std::size_t frame_end, const ScreenProfile& profile,
              std::vector<Shown>& values, Judgement& judgement)
        : text_(text), frame_end_(frame_end), profile_(profile), values_(values), judgement_(judgement) {}

    /// False when the rest of the line is not taken.
    bool read_all(const std::vector<Read>& reads) {
        return std::all_of(reads.begin(), reads.end(), [this](const Read& read) { return read_one(read); });
    }
    void say(Verdict verdict, const std::string& why);

  private:
    bool read_one(const Read& read);
    bool take(const Read& read);
    void missing(const Read& read, std::size_t from);

    /// A key such as "S" or "R:" stands inside others ("SD:", "FR:"): only a key behind a blank was meant.
    bool belongs_to_another(const std::string& key) const;
    bool fail(Read::Bad bad, const std::string& why);
    double number(const Read& read);
    double kept(const Read& read, double number);
    void note_no_number(const Read& read, std::size_t used);
    bool take_number(const Read& read);
    bool take_text(const Read& read);
    bool take_entry(const Read& read);
    void start_list(const Read& read);
    void end_list(const Read& read);

    /// What was read goes on to the end of a frame, which this screen does not know for one.
    void note_frame(std::string_view what);
    bool append_entry(const Read& read);
    void carry(const Read& read);

    std::string_view text_;
    std::size_t frame_end_;
    const ScreenProfile& profile_;
    std::vector<Shown>& values_;
    Judgement& judgement_;
    std::size_t at_ = 0;
};

}  // namespace fauxboard::screen
