#include "emulator/record/screen_judge.h"

#include <fmt/format.h>

#include <utility>

#include "emulator/screen/frame_reader.h"

namespace fauxboard::record {
namespace {

using screen::Verdict;

class Judge {
  public:
    explicit Judge(std::shared_ptr<const screen::ScreenProfile> profile)
        : profile_(std::move(profile)), values_(profile_->values.power_on()) {}

    void operator()(const TranscriptEntry& entry, const protocol::DecodedLine&,
                    std::vector<LineMark>& marks) {
        if (entry.from != RecordedLine::From::board) {
            return;
        }
        const screen::Taken taken = screen::take_received(*profile_, entry.bytes, values_);
        if (taken.judgement.verdict != Verdict::ok) {
            mark(taken.judgement.verdict, taken.judgement.why, marks);
        }
        if (taken.restarts()) {
            values_ = profile_->values.power_on();
        }
    }

  private:
    void mark(Verdict verdict, const std::string& why, std::vector<LineMark>& marks) const {
        marks.push_back({std::string(screen::verdict_words(verdict)),
                         fmt::format("{}: {}: {}", profile_->name, screen::verdict_words(verdict), why)});
    }

    std::shared_ptr<const screen::ScreenProfile> profile_;
    std::vector<screen::Shown> values_;
};

}  // namespace

LineJudge screen_judge(std::shared_ptr<const screen::ScreenProfile> profile) {
    return Judge(std::move(profile));
}

}  // namespace fauxboard::record
