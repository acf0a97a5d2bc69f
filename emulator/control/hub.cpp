#include "emulator/control/hub.h"

#include <algorithm>

#include "emulator/behaviour/own_words.h"
#include "emulator/behaviour/wire_text.h"
#include "protocol/annotate.h"
#include "protocol/secrets.h"

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

std::string_view refusal(board::Verdict verdict) {
    switch (verdict) {
        case board::Verdict::bad_frame:
            return "bad frame";
        case board::Verdict::queue_full:
            return "queue full";
        case board::Verdict::accepted:
            break;
    }
    return {};
}

/// The event is made only if somebody wants it: lines pass at any rate.
template <class Make>
void Hub::tell(TopicId topic, Make&& make) {
    Json made;
    for (Session* session : sessions_) {
        if (session->wants(topic)) {
            if (made.is_null()) {
                made = make();
            }
            session->tell(made);
        }
    }
}

bool Hub::wanted(TopicId topic) const {
    return std::any_of(sessions_.begin(), sessions_.end(),
                       [topic](const Session* session) { return session->wants(topic); });
}

void Hub::publish(TopicId topic, SimTime now, const Json& members) {
    tell(topic, [&] {
        Json made = event(topics()[static_cast<std::size_t>(topic)].name, now);
        made.update(members);
        return made;
    });
}

void Hub::remove(Session& session) {
    hold(session, false);
    std::erase(sessions_, &session);
}

void Hub::hold(const Session& session, bool held) {
    const bool before = this->held();
    std::erase(holding_, &session);
    if (held) {
        holding_.push_back(&session);
    }
    if (before != this->held()) {
        target_.hold(this->held());
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
    publish(TopicId::link, now, {{"state", state}, {"why", why}});
}

void Hub::on_spoiled(SimTime now, const fault::Deed& deed) {
    tell(TopicId::spoiled, [&] {
        Json made = event("spoiled", now);
        made["from"] = deed.direction == fault::Direction::to_board ? board::other_end(board::Channel::main)
                                                                    : board::own_end(board::Channel::main);
        made["line"] = behaviour::from_wire(deed.line);
        made["kind"] = deed.kind;
        made["fault"] = deed.fault;
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
    tell_line(now, board::other_end(channel), line, protocol::Direction::to_board, verdict);
}

void Hub::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    tell_line(now, board::own_end(channel), line, protocol::Direction::to_screen, board::Verdict::accepted);
}

/// With its words only for those who asked for them, and only once.
void Hub::tell_line(SimTime now, std::string_view from, std::string_view heard, protocol::Direction direction,
                    board::Verdict verdict) {
    std::string line;  // as it may be shown to others
    Json bare;
    Json with_words;
    for (Session* session : sessions_) {
        if (!session->wants(TopicId::traffic)) {
            continue;
        }
        if (bare.is_null()) {
            line = protocol::mask_secrets(heard);
            bare = event("traffic", now);
            bare["from"] = from;
            bare["line"] = behaviour::from_wire(line);
            if (verdict != board::Verdict::accepted) {
                bare["refused"] = refusal(verdict);
            }
        }
        if (session->subscriptions.words && with_words.is_null()) {
            with_words = bare;
            with_words["words"] =
                behaviour::explain(target_.board().profile(), protocol::decode_line(line, direction));
        }
        session->tell(session->subscriptions.words ? with_words : bare);
    }
}

void Hub::on_notice(SimTime now, board::Level level, std::string_view text) {
    if (heard_ != nullptr && heard_->size() < most_heard) {
        heard_->push_back({{"level", name(level)}, {"text", text}});
    }
    tell(TopicId::notices, [&] {
        Json made = event("notice", now);
        made["level"] = name(level);
        made["text"] = text;
        return made;
    });
}

}  // namespace fauxboard::control
