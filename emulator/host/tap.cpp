#include "emulator/host/tap.h"

namespace fauxboard::host {

using link::LinkState;

Tap::Tap(link::Link& a, link::Link& b, Clock& clock, TapObserver& observer)
    : clock_(clock), observer_(observer), a_(*this, TapSide::a, a), b_(*this, TapSide::b, b) {}

void Tap::open() {
    a_.link.open(a_);
    try {
        b_.link.open(b_);
    } catch (...) {
        a_.link.close();
        throw;
    }
}

void Tap::close() {
    a_.link.close();
    b_.link.close();
}

void Tap::pass(End& from, std::string_view bytes) {
    const SimTime read = clock_.now();
    End& to = end(other(from.side));
    to.link.write(bytes);
    if (to.link.state() == LinkState::up) {
        if (to.link.pending() == 0) {
            delay_.add(clock_.now() - read);
        } else if (!to.waiting_since) {
            to.waiting_since = read;
        }
        hold_or_go_on(from);
    }
    observer_.on_passed(read, from.side, bytes);
}

/// What an end that is away has not taken is lost, and no reason to wait.
void Tap::hold_or_go_on(End& from) {
    const End& to = end(other(from.side));
    from.link.hold(to.link.state() == LinkState::up && to.link.pending() != 0);
}

void Tap::drained(End& to) {
    if (to.waiting_since) {
        delay_.add(clock_.now() - *to.waiting_since);
        to.waiting_since.reset();
    }
    hold_or_go_on(end(other(to.side)));
}

void Tap::changed(End& at, LinkState state, std::string_view why) {
    if (at.link.state() != LinkState::up) {
        at.waiting_since.reset();
    }
    hold_or_go_on(end(other(at.side)));
    observer_.on_link(clock_.now(), at.side, state, why);
}

}  // namespace fauxboard::host
