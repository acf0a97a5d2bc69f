#include "emulator/screen/tour.h"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/framing.h"

namespace fauxboard::screen {
namespace {

constexpr unsigned most_touches = 40;  ///< on the way to one button
/// A status that was on its way when a button was pressed shows what was before it; the next comes within
/// this (L3, each 4.2 s).
constexpr SimTime status_round{5'000'000};
constexpr std::size_t most_goals = 8;  ///< preparations of preparations
constexpr SimTime shown_for{100'000};  ///< a frame shown to the screen is taken up within that

std::string quoted(const std::vector<std::string>& lines) {
    std::vector<std::string> out;
    for (const std::string& line : lines) {
        out.push_back('"' + printable(line) + '"');
    }
    return out.empty() ? "nothing" : fmt::format("{}", fmt::join(out, ", "));
}

std::vector<const Prepare*> pointers(const std::vector<Prepare>& steps) {
    std::vector<const Prepare*> out;
    for (const Prepare& step : steps) {
        out.push_back(&step);
    }
    return out;
}

std::string seconds(SimTime time) {
    return fixed_text(machine::to_seconds(time), 2) + " s";
}

}  // namespace

std::string_view tour_verdict_words(TourVerdict verdict) {
    return verdict == TourVerdict::met ? "met" : verdict == TourVerdict::not_met ? "not met" : "not pressed";
}

Tour::Tour(Screen& screen, std::vector<std::string> paths, SimTime slack)
    : screen_(screen),
      slack_(slack),
      paths_(std::move(paths)),
      order_(paths_.size()),
      seen_(screen.counters().lines_received),
      last_touch_(screen.time()) {
    listener_.set_slack(slack);
}

Tour::Tour(Screen& screen, SimTime slack) : Tour(screen, {}, slack) {
    order_.resize(screen.profile().buttons.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
        order_[i] = i;
    }
}

bool Tour::passed() const {
    return done() && std::all_of(results_.begin(), results_.end(),
                                 [](const TourResult& result) { return result.verdict == TourVerdict::met; });
}

SimTime Tour::advance(SimTime now) {
    for (;;) {
        if (done()) {  // the screen lives on
            const SimTime next = screen_.advance(now);
            collect();
            return next;
        }
        // Never past the moment at which the tour itself wants to do something.
        const SimTime screen_next = screen_.advance(std::min(now, std::max(due(), screen_.time())));
        collect();
        if (!screen_.output().empty() || done()) {
            return done() ? screen_next : std::min(screen_next, due());
        }
        const bool again = screen_.time() >= due() && step();
        if (!screen_.output().empty()) {
            return screen_.time();
        }
        if (!again && due() > now) {
            return std::min(screen_next, due());
        }
    }
}

void Tour::collect() {
    const auto& lines = screen_.judgements();
    for (const Judgement& line : lines) {
        if (line.number > seen_) {
            listener_.take(screen_, line);
            wake_ = std::min(wake_, screen_.time());
        }
    }
    seen_ = screen_.counters().lines_received;
    if (timeouts_ != screen_.counters().timeouts) {
        timeouts_ = screen_.counters().timeouts;
        listener_.look(screen_);
        wake_ = std::min(wake_, screen_.time());
    }
}

bool Tour::step() {
    if (!screen_.ready()) {
        hold_ = screen_.time() + shown_for;
        return false;
    }
    if (goals_.empty()) {
        if (done()) return false;
        start_next();
        return true;
    }
    Goal& goal = goals_.back();
    switch (goal.phase) {
        case Phase::preparing:
            return prepare(goal);
        case Phase::walking:
            return walk(goal);
        case Phase::listening_on_the_way:
        case Phase::listening:
            return listen(goal);
        case Phase::settling:
            break;
    }
    finish(goal);
    return true;
}

void Tour::start_next() {
    Goal goal;
    goal.recorded = true;
    if (!paths_.empty()) {
        start_press(goal, paths_[next_++]);
        goals_.push_back(std::move(goal));
        return;
    }
    goal.button = order_[next_++];
    goal.result.button = screen_.profile().buttons[goal.button].path;
    if (next_ == 1) {
        goal.steps = pointers(screen_.profile().tour_first);
    }
    const auto own = pointers(screen_.profile().buttons[goal.button].prepare);
    goal.steps.insert(goal.steps.end(), own.begin(), own.end());
    goals_.push_back(std::move(goal));
}

void Tour::start_press(Goal& goal, const std::string& path) {
    const auto page = static_cast<std::size_t>(&screen_.page() - screen_.profile().pages.data());
    const Resolved meant = resolve(screen_.profile(), screen_.values(), page, path);
    goal.result.button = path;
    if (!meant.button) {
        give_up(goal, meant.sentence);
        return;
    }
    goal.button = *meant.button;
    goal.row = meant.row;
    goal.input = meant.input;
    goal.phase = Phase::walking;
    name(goal);
}

/// Says in the goal's result which button, of which row, with what text is meant.
void Tour::name(Goal& goal) const {
    goal.result.button = screen_.profile().buttons[goal.button].path;
    if (goal.row != 0) goal.result.button += fmt::format(" {}", goal.row);
    if (goal.input) goal.result.button += '=' + short_text(*goal.input);
}

bool Tour::show_frame(std::string_view body) {
    screen_.receive(screen_.time(),
                    screen_.profile().line.lf_only ? std::string(body) + '\n' : protocol::frame(body));
    hold_ = screen_.time() + shown_for;
    return false;
}

bool Tour::prepare(Goal& goal) {
    const Scope scope{screen_.values(), 0, {}, 0};
    if (goal.prepared == goal.steps.size()) {
        goal.phase = Phase::walking;
        return true;
    }
    const Prepare& step = *goal.steps[goal.prepared];
    if (step.kind == Prepare::Kind::wait_for && limit_) {
        const bool here = all_hold(step.until, scope);
        if (!here && screen_.time() < *limit_) {
            wake_ = *limit_;  // or when a line comes
            return false;
        }
        if (!here) {
            goal.remark += fmt::format("; before it, in vain: a wait of {} until {}", seconds(step.limit),
                                       step.until.front().words(scope));
        }
        limit_.reset();
        ++goal.prepared;
        return true;
    }
    if (!all_hold(step.when, scope)) {
        ++goal.prepared;
        return true;
    }
    if (step.kind == Prepare::Kind::wait_for) {
        limit_ = screen_.time() + step.limit + slack_;
        return true;
    }
    ++goal.prepared;
    if (step.kind == Prepare::Kind::wait) {
        hold_ = screen_.time() + step.limit;
        return false;
    }
    if (step.kind == Prepare::Kind::receive) {
        return show_frame(step.text);
    }
    const auto page = static_cast<std::size_t>(&screen_.page() - screen_.profile().pages.data());
    const Resolved meant = resolve(screen_.profile(), screen_.values(), page, step.text);
    if (meant.button && goals_.size() < most_goals) {
        Goal before;
        before.button = *meant.button;
        before.row = meant.row;
        before.input = meant.input;
        name(before);
        before.steps = pointers(screen_.profile().buttons[*meant.button].prepare);
        goals_.push_back(std::move(before));
    }
    return true;
}

bool Tour::walk(Goal& goal) {
    const Button& button = screen_.profile().buttons[goal.button];
    const auto route = find_route(screen_.standpoint(), goal.button, goal.row);
    if (route && goal.touches < most_touches) {
        return route->empty() ? touch(goal) : touch_on_the_way(goal, route->front());
    }
    const Obstacle obstacle = find_obstacle(screen_.standpoint(), goal.button, goal.row);
    const SimTime known = last_touch_ + status_round + slack_;
    if (obstacle.hidden && screen_.time() < known) {
        wake_ = known;  // or when a line comes
        return false;
    }
    if (button.page != no_page && paths_.empty()) {
        const auto& frames = screen_.profile().pages[button.page].opened_by;
        if (goal.shown < frames.size()) {
            goal.remark +=
                fmt::format("; its page was opened by showing the screen \"{}\"", frames[goal.shown]);
            return show_frame(frames[goal.shown++]);
        }
    }
    give_up(goal, obstacle.why);
    return true;
}

void Tour::wait_for_lines() {
    wake_ = listener_.deadline();
    if (slack_ != SimTime{0}) {
        wake_ = std::min(wake_, screen_.time() + screen_.profile().idle / 2);
    }
}

bool Tour::touch_on_the_way(Goal& goal, const Step& step) {
    ++goal.touches;
    const Button& button = screen_.profile().buttons[step.button];
    listener_.expect(screen_, button, step.row, std::nullopt);
    last_touch_ = screen_.time();
    const PressResult pressed = screen_.touch(step.button, step.row, std::nullopt, screen_.time());
    if (!pressed.pressed) {
        give_up(goal, pressed.sentence);
        return true;
    }
    if (pressed.sent.empty()) {
        return true;
    }
    listener_.expect_acknowledged(screen_);
    listener_.start(screen_.time());
    goal.phase = Phase::listening_on_the_way;
    wait_for_lines();
    return true;
}

bool Tour::touch(Goal& goal) {
    const Button& button = screen_.profile().buttons[goal.button];
    listener_.expect(screen_, button, goal.row, goal.input);
    last_touch_ = screen_.time();
    const PressResult pressed = screen_.touch(goal.button, goal.row, goal.input, screen_.time());
    if (!pressed.pressed) {
        give_up(goal, pressed.sentence);
        return true;
    }
    goal.result.at = screen_.time();
    goal.result.sent = pressed.sent;
    if (pressed.sent.empty()) {
        listener_.expect_silence();
    } else {
        listener_.expect_acknowledged(screen_);
    }
    goal.result.expected = listener_.expected_words();
    listener_.start(screen_.time());
    goal.phase = Phase::listening;
    wait_for_lines();
    return true;
}

bool Tour::listen(Goal& goal) {
    const Listener::State state = listener_.state(screen_.time());
    if (state == Listener::State::waiting) {
        if (slack_ != SimTime{0}) {  // the page would not have fallen back before a reply in time
            screen_.touch_beside(screen_.time());
        }
        wait_for_lines();
        return false;
    }
    const bool on_the_way = goal.phase == Phase::listening_on_the_way;
    goal.phase = on_the_way ? Phase::walking : Phase::settling;
    if (on_the_way) {
        return true;
    }
    TourResult& result = goal.result;
    result.took = screen_.time() - listener_.started();
    result.came = listener_.came();
    const bool met = state == Listener::State::met;
    result.verdict = met ? TourVerdict::met : TourVerdict::not_met;
    result.sentence =
        fmt::format("{}: sent {}; expected {}; came {}{}{}", result.button, quoted(result.sent),
                    met ? fmt::format("{}", fmt::join(result.expected, ", and ")) : listener_.missing_words(),
                    quoted(result.came), met ? " within " + seconds(result.took) : "", goal.remark);
    if (paths_.empty()) {
        hold_ = screen_.time() + screen_.profile().buttons[goal.button].settle;
    }
    return true;
}

void Tour::give_up(Goal& goal, const std::string& why) {
    goal.result.verdict = TourVerdict::not_pressed;
    goal.result.at = screen_.time();
    goal.result.sentence = fmt::format("{}: not pressed: {}{}", goal.result.button, why, goal.remark);
    goal.phase = Phase::settling;
}

void Tour::finish(Goal& goal) {
    Goal done_goal = std::move(goal);
    goals_.pop_back();
    if (!paths_.empty() && done_goal.result.verdict == TourVerdict::not_pressed) {
        next_ = order_.size();
    }
    if (done_goal.recorded) {
        results_.push_back(std::move(done_goal.result));
    } else if (done_goal.result.verdict != TourVerdict::met && !goals_.empty()) {
        goals_.back().remark += fmt::format("; before it: {}", done_goal.result.sentence);
    }
}

}  // namespace fauxboard::screen
