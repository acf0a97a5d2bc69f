#include "emulator/host/screen_plug.h"

#include <utility>

namespace fauxboard::host {

/// One end of a line that is memory.
class ScreenPlug::End final : public link::Link {
  public:
    explicit End(Clock& clock) : clock_(clock), alarm_(clock.make_alarm([this] { deliver(); })) {}
    void join(End& peer) { peer_ = &peer; }

    void open(link::LinkListener& listener) override {
        listener_ = &listener;
        held_ = false;
        inbox_.clear();
        tell_both("the virtual screen is plugged in");
    }
    void close() override {
        if (std::exchange(listener_, nullptr) != nullptr) {
            inbox_.clear();
            alarm_->at(machine::never);
            tell_both("the virtual screen is unplugged");
        }
    }
    void write(std::string_view message) override { peer_->take(message, stats_); }
    void hold(bool held) override {
        held_ = held;
        wake();
    }
    link::LinkState state() const override {
        return listener_ == nullptr          ? link::LinkState::opening
               : peer_->listener_ == nullptr ? link::LinkState::waiting
                                             : link::LinkState::up;
    }
    const link::LinkStats& stats() const override { return stats_; }
    std::string describe() const override { return "a virtual screen in this process"; }
    std::string kind() const override { return "screen"; }
    std::string path() const override { return "in-process"; }

  private:
    void take(std::string_view message, link::LinkStats& writer) {
        if (listener_ == nullptr || inbox_.size() + message.size() > pending_limit) {
            writer.bytes_lost += message.size();
            ++writer.writes_lost;
            return;
        }
        inbox_ += message;
        writer.bytes_out += message.size();
        wake();
    }
    void wake() {
        if (listener_ != nullptr && (!inbox_.empty() || !why_.empty())) {
            alarm_->at(clock_.now());
        }
    }
    void tell_both(const std::string& why) {
        for (End* end : {this, peer_}) {
            if (end->listener_ != nullptr) {
                end->why_ = why;
                end->wake();
            }
        }
    }
    void deliver() {
        if (!why_.empty() && listener_ != nullptr) {
            listener_->on_state(state(), std::exchange(why_, {}));
        }
        if (held_ || listener_ == nullptr || inbox_.empty()) {
            return;
        }
        const std::string piece = inbox_.substr(0, read_limit);
        inbox_.erase(0, piece.size());
        stats_.bytes_in += piece.size();
        listener_->on_bytes(piece);
        wake();
    }

    Clock& clock_;
    std::unique_ptr<Alarm> alarm_;
    End* peer_ = nullptr;
    link::LinkListener* listener_ = nullptr;
    bool held_ = false;
    std::string inbox_;
    std::string why_;  ///< news of the line, still to be told
    link::LinkStats stats_;
};

ScreenPlug::ScreenPlug(std::shared_ptr<const screen::ScreenProfile> profile, Clock& clock)
    : board_end_(std::make_unique<End>(clock)),
      screen_end_(std::make_unique<End>(clock)),
      screen_(std::move(profile)),
      live_(std::make_unique<LiveScreen>(screen_, *screen_end_, clock, nullptr, nullptr)) {
    board_end_->join(*screen_end_);
    screen_end_->join(*board_end_);
}

ScreenPlug::~ScreenPlug() = default;

link::Link& ScreenPlug::board_end() {
    return *board_end_;
}

void ScreenPlug::start() {
    screen_end_->open(*live_);
    live_->start();
}

void ScreenPlug::close() {
    screen_end_->close();
}

}  // namespace fauxboard::host
