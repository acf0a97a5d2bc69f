#include "emulator/host/live_board.h"

#include <algorithm>
#include <utility>

namespace fauxboard::host {
namespace {

/// Messages in a row before the event loop gets its turn: a clock set faster than this computer can follow
/// must not make the board deaf.
constexpr int steps_per_turn = 1024;
constexpr std::size_t bytes_at_once = 512;

}  // namespace

LiveBoard::LiveBoard(board::Board& board, link::Link& link, Clock& clock, LiveObserver* observer)
    : board_(board),
      link_(link),
      clock_(clock),
      alarm_(clock.make_alarm([this] { wake(); })),
      observer_(observer) {}

void LiveBoard::start(SimTime duration, std::function<void()> on_end) {
    end_ = duration;
    on_end_ = std::move(on_end);
    running_ = true;
    clock_.start();
    board_.power_on(SimTime{0});
    send_output();
    alarm_->at(SimTime{0});
}

SimTime LiveBoard::now() const {
    return running_ ? std::min(clock_.now(), end_) : board_.time();
}

void LiveBoard::send_output() {
    if (!board_.output().empty()) {
        link_.write(board_.output());
    }
    if (const bool crowded = board_.crowded(board::Channel::main); crowded != held_) {
        held_ = crowded;
        link_.hold(held_);
    }
    for (const auto& line : side_lines_) {
        line->send_output();
    }
    board_.clear_output();
    board_.take_datagrams([this](std::uint64_t peer, std::string_view bytes) {
        if (datagram_sender_) {
            datagram_sender_(peer, bytes);
        }
    });
}

/// Does what is due up to `now`, or as much of it as fits into one turn.
void LiveBoard::catch_up(SimTime now) {
    for (int i = 0; i < steps_per_turn; ++i) {
        due_ = board_.advance(now);
        send_output();
        if (due_ > now) {
            return;
        }
    }
}

void LiveBoard::settle(SimTime now) {
    if (now >= end_ && due_ > now) {
        running_ = false;
        alarm_->at(machine::never);
        std::exchange(on_end_, {})();
        return;
    }
    alarm_->at(std::min({due_, show_due_, end_}));
}

/// The follower sees the machine as it is now, not as it was when something last happened.
void LiveBoard::show(SimTime now) {
    if (follower_ && show_due_ <= now && due_ > now) {
        board_.refresh(now);
        catch_up(now);
        show_due_ = follower_(now);
    }
}

void LiveBoard::wake() {
    if (running_) {
        const SimTime at = now();
        catch_up(at);
        show(at);
        settle(at);
    }
}

void LiveBoard::visit(const std::function<void(board::Board& board, SimTime now)>& use) {
    if (!running_) {
        use(board_, board_.time());
        return;
    }
    const SimTime at = now();
    catch_up(at);
    use(board_, due_ > at ? at : board_.time());
    send_output();
    catch_up(at);
    if (follower_) {
        show_due_ = at;
    }
    settle(at);
}

link::LinkListener& LiveBoard::attach(board::Channel channel, link::Link& link) {
    board_.connect(channel, true);
    return *side_lines_.emplace_back(std::make_unique<SideLine>(*this, channel, link));
}

void LiveBoard::take(board::Channel channel, std::string_view bytes) {
    if (!running_) {
        return;
    }
    const SimTime at = now();
    if (due_ <= at) {
        catch_up(at);
    }
    while (!bytes.empty()) {
        // Output that piles up makes requests wait, and in the end get lost; so take it in between.
        const std::string_view piece = bytes.substr(0, bytes_at_once);
        bytes.remove_prefix(piece.size());
        board_.receive(due_ > at ? at : board_.time(), piece, channel);
        send_output();
        catch_up(at);
    }
    settle(at);
}

void LiveBoard::on_state(link::LinkState state, std::string_view why) {
    if (observer_ != nullptr) {
        observer_->on_link(now(), state, why);
    }
}

void LiveBoard::reload(std::shared_ptr<const behaviour::Profile> profile) {
    if (!running_) {
        return;
    }
    const SimTime at = now();
    catch_up(at);
    board_.reload(std::move(profile));
    catch_up(at);
    settle(at);
}

}  // namespace fauxboard::host
