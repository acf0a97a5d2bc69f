#include "emulator/control/hub.h"

#include <algorithm>

#include "emulator/behaviour/wire_text.h"

namespace fauxboard::control {
namespace {

/// Notices kept for one answer: a bound, not a wish.
constexpr std::size_t most_heard = 32;

std::string_view name(board::Level level) {
    switch (level) {
        case board::Level::debug:
            return "debug";
        case board::Level::info:
            return "info";
        case board::Level::warning:
            return "warning";
        case board::Level::error:
            break;
    }
    return "error";
}

Json event(std::string_view topic, SimTime now) {
    return {{"event", topic}, {"t", machine::to_seconds(now)}};
}

}  // namespace

/// The event is made only if somebody wants it: lines pass at any rate.
template <class Wanted, class Make>
void Hub::tell(Wanted&& wanted, Make&& make) {
    Json made;
    for (Session* session : sessions_) {
        if (wanted(session->subscriptions)) {
            if (made.is_null()) {
                made = make();
            }
            session->tell(made);
        }
    }
}

SimTime Hub::on_moved(SimTime now) {
    SimTime next = machine::never;
    for (Session* session : sessions_) {
        next = std::min(next, session->on_moved(target_.board(), now));
    }
    return next;
}

void Hub::on_link(SimTime now, std::string_view state, std::string_view why) {
    tell([](const auto& s) { return s.link; },
         [&] {
             Json made = event("link", now);
             made["state"] = state;
             made["why"] = why;
             return made;
         });
}

void Hub::on_reload() {
    for (Session* session : sessions_) {
        session->on_reload(target_.board());
    }
}

void Hub::on_end() {
    for (Session* session : sessions_) {
        session->on_end();
    }
}

void Hub::on_received(SimTime now, board::Channel channel, std::string_view line, board::Verdict verdict) {
    tell([](const auto& s) { return s.traffic; },
         [&] {
             Json made = event("traffic", now);
             made["from"] = board::other_end(channel);
             made["line"] = behaviour::from_wire(line);
             if (verdict != board::Verdict::accepted) {
                 made["refused"] = verdict == board::Verdict::bad_frame ? "bad frame" : "queue full";
             }
             return made;
         });
}

void Hub::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    tell([](const auto& s) { return s.traffic; },
         [&] {
             Json made = event("traffic", now);
             made["from"] = board::own_end(channel);
             made["line"] = behaviour::from_wire(line);
             return made;
         });
}

void Hub::on_notice(SimTime now, board::Level level, std::string_view text) {
    if (heard_ != nullptr && heard_->size() < most_heard) {
        heard_->push_back({{"level", name(level)}, {"text", text}});
    }
    tell([](const auto& s) { return s.notices; },
         [&] {
             Json made = event("notice", now);
             made["level"] = name(level);
             made["text"] = text;
             return made;
         });
}

}  // namespace fauxboard::control
