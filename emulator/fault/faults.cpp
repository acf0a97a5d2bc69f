#include "emulator/fault/faults.h"

#include <algorithm>

namespace fauxboard::fault {
namespace {

/// A disconnection that no line brings is one event, which takes the link from both directions wherever it
/// is.
bool comes_to_both_at_once(const FaultSpec& spec) {
    return spec.kind->interrupt != nullptr && spec.kind->interrupt(spec.values).link_down &&
           !spec.trigger.by_line();
}

void refuse_printer(const FaultSpec& spec) {
    if (spec.kind->printer != nullptr) {
        throw FaultSpecError({"fault \"" + std::string(spec.kind->name) +
                              "\": it is the printer that breaks, and a line has none; expected a fault of "
                              "lines, or a board that is run (`fauxboard run`)"});
    }
}

bool wants(const FaultSpec& spec, Direction direction) {
    if (spec.direction == Direction::both) {
        return direction == Direction::to_screen || !comes_to_both_at_once(spec);
    }
    return spec.direction == direction;
}

bool full(const FaultLine& line, FaultId id) {
    return line.size() >= FaultLine::most_faults && !line.has(id);
}

}  // namespace

void Faults::put(SimTime now, FaultId id, const FaultSpec& spec) {
    // A full line refuses before the other one is touched.
    FaultLine* lines[] = {&to_screen_, &to_board_};
    const Direction directions[] = {Direction::to_screen, Direction::to_board};
    if (wants(spec, Direction::to_board) && full(to_board_, id)) {
        std::swap(lines[0], lines[1]);
    }
    for (FaultLine* line : lines) {
        const Direction direction = directions[line == &to_board_ ? 1 : 0];
        if (wants(spec, direction)) {
            line->put(now, id, spec);
        } else {
            line->remove(now, id);
        }
    }
}

FaultId Faults::add(SimTime now, const FaultSpec& spec) {
    refuse_printer(spec);
    put(now, last_id_ + 1, spec);
    return ++last_id_;
}

bool Faults::change(SimTime now, FaultId id, const FaultSpec& spec) {
    if (!to_screen_.has(id) && !to_board_.has(id)) {
        return false;
    }
    refuse_printer(spec);
    put(now, id, spec);
    return true;
}

bool Faults::remove(SimTime now, FaultId id) {
    const bool in_first = to_screen_.remove(now, id);
    const bool in_second = to_board_.remove(now, id);
    return in_first || in_second;
}

void Faults::clear(SimTime now) {
    to_screen_.clear(now);
    to_board_.clear(now);
}

std::vector<FaultStatus> Faults::list(SimTime now) const {
    std::vector<FaultStatus> all = to_screen_.list(now);
    for (FaultStatus& status : to_board_.list(now)) {
        const auto same =
            std::find_if(all.begin(), all.end(), [&](const FaultStatus& s) { return s.id == status.id; });
        if (same == all.end()) {
            all.push_back(std::move(status));
            continue;
        }
        same->seen += status.seen;
        same->acted += status.acted;
        same->over = same->over && status.over;
        same->by[1] = status.by[1];
    }
    std::sort(all.begin(), all.end(), [](const FaultStatus& a, const FaultStatus& b) { return a.id < b.id; });
    return all;
}

SimTime Faults::advance(SimTime now) {
    const SimTime first = to_screen_.advance(now);
    return std::min(first, to_board_.advance(now));
}

}  // namespace fauxboard::fault
