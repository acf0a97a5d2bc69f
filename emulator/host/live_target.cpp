#include "emulator/host/live_target.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "emulator/behaviour/wire_text.h"
#include "emulator/host/screen_plug.h"
#include "emulator/screen/screen_json.h"
#include "emulator/script/progress.h"

namespace fauxboard::host {
namespace {

using control::Json;
using control::TopicId;

/// Virtual time that may be skipped before the event loop gets its turn.
constexpr SimTime skip_at_once = std::chrono::minutes(1);
/// Between two looks at what is told when it has changed; of real time, since people look.
constexpr std::chrono::milliseconds look_pause{120};
/// A screen that looks on is given up when nobody has looked for so long.
constexpr SimTime mirror_patience = std::chrono::seconds(60);
constexpr std::array looked_at{TopicId::screen, TopicId::scenario, TopicId::drawing};

}  // namespace

LiveTarget::LiveTarget(Parts parts)
    : parts_(std::move(parts)), hub_(*this), drawings_(parts_.board), look_(parts_.loop, [this] { look(); }) {
    parts_.live.follow(
        [this](SimTime now) { return std::min(hub_.on_moved(now), curves_.take(parts_.board, now)); });
}

LiveTarget::~LiveTarget() {
    parts_.live.follow({});
}

void LiveTarget::on_end() {
    if (looking_) {
        look();
    }
    hub_.on_end();
}

std::size_t LiveTarget::faults_in_force() const {
    return (parts_.faults != nullptr ? parts_.faults->list().size() : 0) +
           parts_.board.machine().faults.list().size();
}

// What passes.
// -----------------------------------------------------------------------------------------------

void LiveTarget::on_received(SimTime now, board::Channel channel, std::string_view line,
                             board::Verdict verdict) {
    talk_.add(now, board::other_end(channel), line, control::refusal(verdict));
    hub_.on_received(now, channel, line, verdict);
}

void LiveTarget::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    hub_.on_sent(now, channel, line);
    if (channel != board::Channel::main) {
        return talk_.add(now, board::own_end(channel), line);
    }
    talk_.add_said(now, line);
    if (mirror_) {
        mirror_->hear(now, line);
        if (!looking_ && now - mirror_used_ > mirror_patience) {
            parts_.loop.post([this, life = std::weak_ptr(life_)] {
                if (!life.expired() && !looking_) mirror_.reset();
            });
        }
    }
}

void LiveTarget::on_link(SimTime now, link::LinkState state, std::string_view why) {
    hub_.on_link(now, link::state_name(state), why);
}

// Time.
// -----------------------------------------------------------------------------------------------

/// Skips a stretch and posts itself for the next one: a jump of days must not make the clients deaf.
void LiveTarget::skip_on() {
    const SimTime left = skip_to_ - parts_.clock.now();
    if (left > SimTime{0}) {
        parts_.clock.skip(std::min(left, skip_at_once));
        parts_.loop.post([this, life = std::weak_ptr(life_)] {
            if (!life.expired()) skip_on();
        });
    }
}

SimTime LiveTarget::skip(SimTime by) {
    const SimTime now = parts_.clock.now();
    const bool under_way = skip_to_ > now;
    skip_to_ = std::max(skip_to_, now) + by;
    if (!under_way) {
        parts_.loop.post([this, life = std::weak_ptr(life_)] {
            if (!life.expired()) skip_on();
        });
    }
    return skip_to_;
}

Json LiveTarget::status() const {
    const link::LinkStats& stats = parts_.link.stats();
    return {{"speed", parts_.speed},
            {"link",
             {{"kind", parts_.link.kind()},
              {"path", parts_.link.path()},
              {"state", link::state_name(parts_.link.state())},
              {"bytes_in", stats.bytes_in},
              {"bytes_out", stats.bytes_out},
              {"bytes_lost", stats.bytes_lost}}}};
}

// What people look at.
// -----------------------------------------------------------------------------------------------

ScreenMirror* LiveTarget::mirror() {
    if (!parts_.screen) {
        return nullptr;
    }
    mirror_used_ = parts_.live.now();
    if (!mirror_) {
        mirror_.emplace(ScreenMirror::Parts{parts_.screen, parts_.clock,
                                            [this](std::string_view line) {
                                                parts_.live.visit([&](board::Board& board, SimTime now) {
                                                    board.hear(now, line);
                                                });
                                            },
                                            [this] { return parts_.link.state() != link::LinkState::up; },
                                            [this](SimTime at, const screen::Judgement& judgement) {
                                                hub_.publish(TopicId::judged, at, screen::to_json(judgement));
                                            }},
                        talk_.last_said());
    }
    return &*mirror_;
}

Json LiveTarget::screen(SimTime /*now*/) {
    if (plug_ != nullptr) {
        return screen::face_json(plug_->screen().standpoint());
    }
    ScreenMirror* looking_on = mirror();
    if (looking_on == nullptr) {
        return nullptr;
    }
    Json face = screen::face_json(looking_on->screen().standpoint());
    face["note"] =
        parts_.link.state() == link::LinkState::up
            ? "Looks on: shows what the board tells the screen on its line. Its buttons are requests "
              "of their own."
            : "The screen of this panel: nobody else is on the line.";
    return face;
}

Json LiveTarget::press(board::Board& board, SimTime now, const control::Press& press) {
    screen::PressResult result;
    if (plug_ != nullptr) {
        result = plug_->press(press.button, press.row, press.input);
    } else if (ScreenMirror* looking_on = mirror()) {
        result = looking_on->press(press.button, press.row, press.input, now);
        for (const std::string& line : looking_on->take_requests()) {
            board.hear(now, line);
        }
    } else {
        return View::press(board, now, press);
    }
    if (!result.pressed) {
        throw control::ControlError(control::ErrorCode::refused, result.sentence + ".");
    }
    Json sent = Json::array();
    for (const std::string& line : result.sent) {
        sent.push_back(behaviour::from_wire(line));
    }
    return {{"sent", std::move(sent)}, {"screen", screen(now)}};
}

Json LiveTarget::scenario() {
    return player_ == nullptr ? Json(nullptr) : script::progress_json(*player_);
}

Json LiveTarget::drawing(const board::Board& /*board*/, SimTime /*now*/) {
    return drawings_.whole();
}

/// A drawing grows: only what is new is told.
void LiveTarget::look_at_drawing() {
    looking_ = true;
    parts_.live.visit([this](board::Board& board, SimTime now) {
        board.refresh(now);
        if (const Json news = drawings_.news(); !news.is_null()) {
            hub_.publish(TopicId::drawing, now, {{"drawing", news}});
        }
    });
}

/// Somebody looks: what is told when it has changed is looked at now and then, for as long as it is wanted.
void LiveTarget::on_wanted() {
    const auto wants = [this](TopicId topic) { return hub_.wanted(topic); };
    if (!looking_ && (std::any_of(looked_at.begin(), looked_at.end(), wants) || wants(TopicId::judged))) {
        looking_ = true;
        shown_.clear();
        look_.after(look_pause);
    }
}

void LiveTarget::look() {
    looking_ = hub_.wanted(TopicId::judged);
    if (looking_) {
        mirror();
    }
    if (hub_.wanted(TopicId::screen)) {
        look_at(TopicId::screen, screen(parts_.live.now()));
    }
    if (hub_.wanted(TopicId::scenario)) {
        look_at(TopicId::scenario, scenario());
    }
    if (hub_.wanted(TopicId::drawing)) {
        look_at_drawing();
    }
    if (looking_) {
        look_.after(look_pause);
    }
}

void LiveTarget::look_at(TopicId topic, const Json& now) {
    looking_ = true;
    std::string text = now.dump(-1, ' ', true, Json::error_handler_t::replace);
    std::string& before = shown_[topic];
    if (text != before) {
        before = std::move(text);
        hub_.publish(topic, parts_.live.now(),
                     {{std::string(control::topics()[static_cast<std::size_t>(topic)].name), now}});
    }
}

}  // namespace fauxboard::host
