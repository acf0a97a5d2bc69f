#include "emulator/screen/screen.h"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/framing.h"

namespace fauxboard::screen {
namespace {

constexpr std::size_t max_judgements = 512;
constexpr std::size_t max_findings = 256;
constexpr std::size_t max_answers = 64;
constexpr std::size_t max_output = 64UL * 1024;

}  // namespace

Screen::Screen(std::shared_ptr<const ScreenProfile> profile)
    : profile_(std::move(profile)),
      intake_(profile_->line.buffer_bytes, profile_->line.byte_time, profile_->line.tick,
              profile_->line.lf_only),
      talk_(profile_->talk),
      values_(profile_->values.power_on()),
      page_(profile_->main_page),
      before_(profile_->main_page) {}

void Screen::power_on(SimTime now) {
    catch_up(now);
    restart(std::max(now, time_));
}

void Screen::restart(SimTime now) {
    intake_.start(now);
    answers_.clear();
    talk_.power_on(now);
    polls_due_.assign(profile_->talk.polls.size(), now + profile_->line.deaf);
    jammed_ = false;
    values_ = profile_->values.power_on();
    page_ = before_ = profile_->main_page;
    tell_page();
    on_ = hello_due_ = true;
    time_ = power_on_ = touched_ = now;
}

void Screen::receive(SimTime now, std::string_view bytes) {
    catch_up(now);
    if (!ready()) {
        counters_.bytes_unheard += bytes.size();
        return;
    }
    if (!jammed_) {
        intake_.receive(std::max(now, time_), bytes);
    }
}

SimTime Screen::advance(SimTime now) {
    while (output_.empty() && next_due() <= now) {
        step(next_due());
    }
    if (output_.empty()) {
        time_ = std::max(time_, now);
    }
    return next_due();
}

void Screen::catch_up(SimTime now) {
    while (next_due() <= now) {
        step(next_due());
    }
    time_ = std::max(time_, now);
}

SimTime Screen::idle_due() const {
    return ready() && !page().stays && !profile_->idle_target.empty() ? touched_ + profile_->idle
                                                                      : machine::never;
}

SimTime Screen::next_due() const {
    if (!on_) {
        return machine::never;
    }
    if (hello_due_) {
        return power_on_ + profile_->line.deaf;
    }
    const SimTime due = std::min({idle_due(), intake_.next_look(), talk_due()});
    return answers_.empty() ? due : std::min(due, answers_.front().at);
}

void Screen::step(SimTime due) {
    time_ = std::max(time_, due);
    if (hello_due_) {
        hello_due_ = false;
        put(profile_->line.hello);
    } else if (!answers_.empty() && answers_.front().at <= due) {
        const std::string body = std::move(answers_.front().body);
        answers_.pop_front();
        send(body);
    } else if (talk_due() <= due) {
        talk_on();
    } else if (intake_.next_look() <= due && idle_due() > due) {
        drain();
    } else {
        const Scope scope{values_, 0, {}, 0};
        touched_ = due;
        open(standpoint().destination(profile_->idle_target, scope).value_or(profile_->main_page));
    }
}

void Screen::drain() {
    const std::size_t lost = intake_.drain(time_, [this](const IntakeLine& line) { take(line); });
    if (lost != 0) {
        counters_.bytes_lost += lost;
        Judgement judgement;
        judgement.at = time_;
        judgement.line = "(receive buffer)";
        judgement.verdict = Verdict::rest_dropped;
        judgement.why = fmt::format("more than {} bytes came without a pause; those behind are lost",
                                    profile_->line.buffer_bytes);
        record(std::move(judgement));
    }
}

void Screen::take(const IntakeLine& line) {
    Taken taken = take_received(*profile_, line.text, values_);
    Judgement& judgement = taken.judgement;
    judgement.at = time_;
    judgement.number = ++counters_.lines_received;
    talk_.heard(time_);
    const std::size_t jams_at = profile_->line.jams_at;
    if (jams_at != 0 && line.text.size() >= jams_at) {
        jammed_ = true;
        taken.how.clear();
        judgement.verdict = Verdict::jams;
        judgement.why = fmt::format("a line of {} bytes or more: the screen never reads again", jams_at);
    }
    if (std::any_of(taken.how.begin(), taken.how.end(),
                    [](const FrameCase* one) { return one->acknowledges; })) {
        acknowledge(judgement, line.came);
    }
    ++counters_.verdicts[static_cast<std::size_t>(judgement.verdict)];
    record(judgement);
    act_on(taken);
}

void Screen::act_on(const Taken& taken) {
    if (taken.restarts()) {
        ++(taken.judgement.verdict == Verdict::would_crash ? counters_.crashes : counters_.restarts);
        restart(time_);
        return;
    }
    for (const FrameCase* how : taken.how) {
        act_on(*how);
    }
}

void Screen::act_on(const FrameCase& how) {
    if (how.forgets) {
        talk_.forget(time_);
    }
    for (const std::string& command : how.answers) {
        talk_.answered(command);
    }
    const Scope scope{values_, 0, {}, 0};
    for (const Send& answer : how.answer) {
        if (!all_hold(answer.when, scope)) {
            continue;
        }
        if (profile_->talk.queued) {
            send(answer.line.render(scope));
        } else if (answers_.size() < max_answers) {
            answers_.push_back({std::max(time_, intake_.arrived() + profile_->line.answer_after),
                                answer.line.render(scope)});
        }
    }
    if (const auto to = standpoint().destination(how.opens, scope)) {
        touched_ = time_;
        open(*to);
    }
}

void Screen::record(Judgement judgement) {
    if (judgement.verdict != Verdict::ok) {
        const auto same = std::find_if(findings_.begin(), findings_.end(), [&](const Finding& finding) {
            return finding.first.verdict == judgement.verdict && finding.first.why == judgement.why &&
                   finding.first.frame == judgement.frame;
        });
        if (same != findings_.end()) {
            ++same->times;
        } else if (findings_.size() < max_findings) {
            findings_.push_back({judgement, 1});
        }
    }
    if (judgements_.size() == max_judgements) {
        judgements_.pop_front();
    }
    judgements_.push_back(std::move(judgement));
}

void Screen::open(std::size_t page_id) {
    if (page_id != page_) {
        before_ = page_;
    }
    page_ = page_id;
    tell_page();
    const Scope scope{values_, 0, {}, 0};
    std::vector<const Send*> sends;
    for (const Send& one : page().send) {
        if (all_hold(one.when, scope)) sends.push_back(&one);
    }
    assume(page().assume, scope);
    send_all(sends, scope);
}

void Screen::send_all(const std::vector<const Send*>& sends, const Scope& scope) {
    for (const Send* one : sends) {
        send(one->line.render(scope));
    }
}

void Screen::send(std::string body) {
    // A name from the board may hold anything; a line of ours holds no control character.
    std::replace_if(
        body.begin(), body.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
    if (!profile_->talk.queued) {
        write(body);
    } else if (!talk_.queue(body)) {
        return;  // it has no room for more, and says nothing of it
    }
    sent_.push_back(std::move(body));
    if (sent_.size() > max_judgements) {
        sent_.clear();
    }
    talk_on();
}

void Screen::write(std::string_view body) {
    ++counters_.lines_sent;
    if (profile_->line.lf_only) {
        put(std::string(body) + '\n');
        return;
    }
    put(protocol::frame(
        body, profile_->line.framed_out ? protocol::FrameStyle::framed : protocol::FrameStyle::bare));
}

void Screen::put(std::string_view bytes) {
    if (output_.size() + bytes.size() > max_output) {
        counters_.output_lost += bytes.size();
        return;
    }
    output_.append(bytes);
}

PressResult Screen::touch(std::size_t id, std::size_t row, std::optional<double> input, SimTime now) {
    catch_up(now);
    PressResult result;
    const Button& button = profile_->buttons[id];
    const auto& here = page().buttons;
    const Standpoint at = standpoint();
    if (!ready()) {
        result.sentence = "the screen is not on yet";
    } else if (std::string dead = talk_.dead(); !dead.empty()) {
        result.sentence = std::move(dead);
    } else if (std::find(here.begin(), here.end(), id) == here.end()) {
        result.sentence = fmt::format("\"{}\" is not on the page that is open, {}", button.path, page().path);
    } else {
        result.sentence = at.hidden(button, row);
    }
    if (!result.sentence.empty()) {
        return result;
    }
    const std::size_t pressed_row = at.visible(button, row).value_or(1);
    const double typed = input.value_or(button.input ? button.input->normally : 0);
    // Whether and where are decided by what is shown before the touch; what is sent shows what comes of it.
    const std::string row_text(at.scope(button, pressed_row).row_text);
    const Scope scope{values_, pressed_row, row_text, typed};
    const auto to = at.destination(button.leads_to, scope);
    touched_ = time_;
    if (to && !(result.sentence = at.shut(*to)).empty()) {
        return result;
    }
    std::vector<const Send*> sends;
    for (const Send& one : button.send) {
        if (all_hold(one.when, scope)) sends.push_back(&one);
    }
    sent_.clear();
    assume(button.assume, scope);
    send_all(sends, scope);
    if (to) {
        open(*to);
    }
    result.pressed = true;
    result.button = id;
    result.sent = std::move(sent_);
    sent_.clear();
    return result;
}

PressResult Screen::press(std::string_view path, std::size_t row, std::optional<double> input, SimTime now) {
    catch_up(now);
    const Resolved meant = resolve(*profile_, values_, page_, path);
    const auto& here = page().buttons;
    if (!meant.button || std::find(here.begin(), here.end(), *meant.button) == here.end()) {
        return press(path, now);
    }
    return touch(*meant.button, row != 0 ? row : meant.row, input ? input : meant.input, now);
}

PressResult Screen::press(std::string_view path, SimTime now) {
    catch_up(now);
    PressResult result;
    const Resolved meant = resolve(*profile_, values_, page_, path);
    if (!meant.button) {
        result.sentence = meant.sentence;
        return result;
    }
    const auto route = find_route(standpoint(), *meant.button, meant.row);
    if (!route) {
        result.sentence = find_obstacle(standpoint(), *meant.button, meant.row).why;
        return result;
    }
    std::vector<std::string> sent;
    for (const Step& step : *route) {
        result = touch(step.button, step.row, std::nullopt, now);
        sent.insert(sent.end(), result.sent.begin(), result.sent.end());
        if (!result.pressed) {
            result.sent = std::move(sent);
            return result;
        }
    }
    result = touch(*meant.button, meant.row, meant.input, now);
    result.sent.insert(result.sent.begin(), sent.begin(), sent.end());
    return result;
}

std::optional<std::string> Screen::get(std::string_view name) const {
    const auto id = profile_->values.find(name);
    if (!id) {
        return std::nullopt;
    }
    const Shown& value = values_[*id];
    switch (profile_->values.at(*id).kind) {
        case ValueKind::number:
            return short_text(value.number);
        case ValueKind::text:
            return printable(value.text);
        case ValueKind::list:
            break;
    }
    std::string out;
    for (const std::string& entry : value.list) {
        out += printable(entry) + '\n';
    }
    return out;
}

std::optional<double> Screen::number(std::string_view name) const {
    const auto id = profile_->values.find(name);
    return id && profile_->values.at(*id).kind == ValueKind::number ? std::optional(values_[*id].number)
                                                                    : std::nullopt;
}

}  // namespace fauxboard::screen
