#include "emulator/screen/talk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace fauxboard::screen {
namespace {

/// "M21" is how "M21" and "M21 S" start, and not "M211".
bool is_command(std::string_view body, std::string_view start) {
    return body.starts_with(start) && (body.size() == start.size() || body[start.size()] == ' ');
}

}  // namespace

void Talk::power_on(SimTime now) {
    forget(now);
    before_.clear();
    spoke_ = false;
}

void Talk::forget(SimTime now) {
    over_ = taken_;
    if (under_way_) {
        before_ = std::move(*under_way_);
    }
    urgent_.clear();
    waiting_.clear();
    under_way_.reset();
    unowed_ = 0;
    wait_ = nullptr;
    stalled_ = false;
    heard_ = now;
}

bool Talk::overtakes(std::string_view body) const {
    return std::any_of(rules_.at_once.begin(), rules_.at_once.end(),
                       [&](const std::string& start) { return is_command(body, start); });
}

bool Talk::queue(std::string body) {
    std::deque<std::string>& queue = overtakes(body) ? urgent_ : waiting_;
    if (queue.size() >= rules_.most_waiting) {
        return false;
    }
    taken_ += &queue == &waiting_ ? 1 : 0;
    queue.push_back(std::move(body));
    return true;
}

bool Talk::has(std::string_view body) const {
    return under_way_ == body || std::find(waiting_.begin(), waiting_.end(), body) != waiting_.end();
}

std::optional<std::string> Talk::next(SimTime now, std::uint64_t came) {
    if (!urgent_.empty()) {
        std::string body = std::move(urgent_.front());
        urgent_.pop_front();
        ++unowed_;
        spoke_ = true;
        return body;
    }
    if (under_way_ || waiting_.empty()) {
        return std::nullopt;
    }
    under_way_ = std::move(waiting_.front());
    waiting_.pop_front();
    came_ = came;
    heard_ = now;
    spoke_ = true;
    for (const TalkRules::Wait& wait : rules_.waits) {
        if (is_command(*under_way_, wait.command)) {
            wait_ = &wait;
            stalled_ = false;
        }
    }
    return under_way_;
}

void Talk::finish() {
    before_ = std::move(*under_way_);
    under_way_.reset();
    ++over_;
    stalled_ = wait_ != nullptr;
}

Talk::Ack Talk::acknowledge(std::uint64_t came) {
    if (!under_way_) {
        if (unowed_ != 0) {
            --unowed_;
            return {};
        }
        return spoke_
                   ? Ack{Verdict::runs_ahead,
                         fmt::format("one acknowledgement more than there were commands: since it came for "
                                     "one before, up to \"{}\", the screen ran one command ahead",
                                     before_)}
                   : Ack{Verdict::ignored, "nothing was asked yet"};
    }
    Ack out;
    if (came <= came_ && unowed_ != 0) {
        --unowed_;  // for the one that overtook
    } else if (came <= came_ && over_ != 0) {
        out = {Verdict::runs_ahead,
               fmt::format(
                   "two acknowledgements for one command (\"{}\"): this one is taken for that of \"{}\", "
                   "which had not left when it came; from here on the screen runs one command ahead",
                   before_, *under_way_)};
    }
    finish();
    if (stalled_) {
        out = {std::max(out.verdict, Verdict::stalls),
               (out.why.empty() ? "" : out.why + "; ") +
                   fmt::format("\"{}\" is acknowledged without its answer: {}", before_, wait_->why)};
    }
    return out;
}

void Talk::answered(std::string_view command) {
    if (wait_ != nullptr && wait_->command == command) {
        wait_ = nullptr;
        stalled_ = false;
    }
}

SimTime Talk::timeout_due() const {
    return under_way_ ? heard_ + rules_.timeout : machine::never;
}

std::string Talk::give_up(SimTime now) {
    finish();
    heard_ = now;
    return before_;
}

std::string Talk::dead() const {
    return wait_ == nullptr ? std::string{}
                            : fmt::format("the screen waits for the answer to {} and does not react{}",
                                          wait_->command, stalled_ ? ": " + wait_->why : "");
}

}  // namespace fauxboard::screen
