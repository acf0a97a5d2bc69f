#include "tools/screen_walk.h"

namespace fauxboard::tools {
namespace {

using host::SimTime;

/// By then the boot messages of a board that was switched on with the screen are over, and a board that does
/// not know the screen has asked it, once round its schedule, and has replied to the answer.
constexpr SimTime after_first_word{2'300'000};
/// A board that says anything unasked has said it by then: once round its schedule.
constexpr SimTime first_word{2'500'000};

}  // namespace

std::span<const screen::TourResult> ScreenWalk::results() const {
    return tour_ ? std::span(tour_->results()) : std::span<const screen::TourResult>();
}

SimTime ScreenWalk::on_turn(SimTime now) {
    host::LiveScreen& live = session_.live();
    if (!heard_ && live.lines_heard() != 0) {
        heard_ = now;
    }
    if (!heard_ && now >= session_.first_word_due()) {
        session_.fail(ExitCode::timed_out, session_.silence_sentence());
        return machine::never;
    }
    if (!started_) {
        const SimTime begin = heard_ ? *heard_ + after_first_word : live.line_start() + first_word;
        if (now < begin) {
            return std::min(begin, session_.first_word_due());
        }
        started_ = true;
        tour_ = make_tour(now);
        if (tour_) {
            live.lead(&*tour_);
            return now;
        }
    }
    for (; told_ < results().size(); ++told_) {
        on_result(results()[told_]);
    }
    const SimTime limit = heard_ ? machine::never : session_.first_word_due();
    if (tour_ && !tour_->done()) {
        return limit;
    }
    return heard_ ? on_done(now) : limit;
}

void ScreenWalk::on_link(link::LinkState state, std::string_view why) {
    if (state != link::LinkState::up) {
        session_.fail(ExitCode::no_port, why);
    }
}

}  // namespace fauxboard::tools
