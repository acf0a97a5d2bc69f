// What is done to a board from outside its lines: actions, frames on demand, a look at its values.

#include <algorithm>

#include "emulator/behaviour/action_words.h"
#include "emulator/board/board.h"

namespace fauxboard::board {
namespace {

/// Hands notices on, and keeps the first by which an action says that it was not done.
struct RefusalWatch final : behaviour::NoticeSink {
    explicit RefusalWatch(behaviour::NoticeSink& next) : next_(next) {}
    void notice(Level level, std::string_view text) override {
        if (level >= Level::warning && refusal.empty()) {
            refusal = text;
        }
        next_.notice(level, text);
    }
    std::string refusal;

  private:
    behaviour::NoticeSink& next_;
};

}  // namespace

bool Board::world(SimTime now, std::string_view phrase) {
    const behaviour::ActionInfo* info = behaviour::find_world_action(phrase);
    if (info == nullptr || std::any_of(info->args.begin(), info->args.end(),
                                       [](const behaviour::ArgInfo& a) { return a.required; })) {
        return false;
    }
    behaviour::ActionCall call;
    call.info = info;
    call.args.resize(info->args.size());
    act(now, call);
    return true;
}

std::string Board::act(SimTime now, const behaviour::ActionCall& call) {
    catch_up(now);
    machine_->advance(time_);
    if (options_.observer != nullptr) {
        options_.observer->on_world(time_, behaviour::action_words(call, scope(), profile_->variables));
    }
    RefusalWatch watch(*this);
    behaviour::ActionContext context{*machine_, variables_, watch};
    behaviour::run_action(call, scope(), profile_->variables, context);
    if (context.reset) {
        power_on(time_);
    }
    settle();
    run_host();
    return watch.refusal;
}

void Board::tinker(SimTime now, const std::function<void(machine::Machine& machine)>& use,
                   std::string_view words) {
    catch_up(now);
    machine_->advance(time_);
    if (!words.empty() && options_.observer != nullptr) {
        options_.observer->on_world(time_, words);
    }
    use(*machine_);
    machine_->advance(time_);
    settle();
}

void Board::send_frame(SimTime now, const behaviour::Send& entry) {
    refresh(now);
    send(entry, scope());
}

void Board::send_raw(SimTime now, std::string_view bytes) {
    catch_up(now);
    std::string message(bytes);
    if (!message.ends_with('\n')) {
        message += "\r\n";
    }
    emit(message);
}

void Board::refresh(SimTime now) {
    catch_up(now);
    machine_->advance(time_);
    settle();
}

}  // namespace fauxboard::board
