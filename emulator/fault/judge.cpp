#include "emulator/fault/judge.h"

#include <algorithm>
#include <limits>

#include "emulator/fault/kind.h"

namespace fauxboard::fault {
namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

/// Silence and disconnection without a rule for lines come once.
bool comes_once(const FaultSpec& spec) {
    return spec.trigger.at.has_value() || (spec.kind->interrupt != nullptr && !spec.trigger.by_line());
}

SimTime end_of(const Trigger& trigger, SimTime begin) {
    if (trigger.until) {
        return *trigger.until;
    }
    return trigger.length && *trigger.length < machine::never - begin ? begin + *trigger.length
                                                                      : machine::never;
}

}  // namespace

Judge::Judge(const FaultSpec& spec, Direction direction, SimTime added)
    : probability_(spec.trigger.probability.value_or(1)),
      every_(spec.trigger.every.value_or(1)),
      after_(spec.trigger.after.value_or(0)),
      limit_(comes_once(spec) ? 1 : spec.trigger.count.value_or(no_limit)),
      begin_(std::max(added, spec.trigger.at ? *spec.trigger.at : spec.trigger.from.value_or(added))),
      end_(end_of(spec.trigger, begin_)),
      seed_(spec.seed),
      stream_(static_cast<std::uint64_t>(direction)),
      dice_(seed_, stream_, 0) {}

bool Judge::line() {
    ++seen_;
    dice_ = Dice(seed_, stream_, seen_);
    const bool lucky = dice_.fraction() < probability_;
    if (!lucky || seen_ <= after_ || (seen_ - after_) % every_ != 0) {
        return false;
    }
    ++acted_;
    return true;
}

}  // namespace fauxboard::fault
