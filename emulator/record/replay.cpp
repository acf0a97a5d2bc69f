#include "emulator/record/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "emulator/behaviour/action_words.h"

namespace fauxboard::record {
namespace {

using machine::SimTime;
using From = RecordedLine::From;

constexpr std::size_t max_notices = 1000;

class NoticeKeeper final : public board::Observer {
  public:
    explicit NoticeKeeper(std::vector<ReplayNotice>& out) : out_(out) {}
    void on_received(SimTime, board::Channel, std::string_view, board::Verdict) override {}
    void on_sent(SimTime, board::Channel, std::string_view) override {}
    void on_notice(SimTime now, board::Level level, std::string_view text) override {
        if (out_.size() < max_notices) {
            out_.push_back({now, level, std::string(text)});
        }
    }

  private:
    std::vector<ReplayNotice>& out_;
};

/// One run. The board's clock starts with its power-on; `shift_` is where that lies in the recording.
class Player {
  public:
    Player(std::shared_ptr<const behaviour::Profile> profile, const ReplayOptions& options)
        : keeper_(result_.notices),
          wire_(profile->line.baud),
          board_(std::move(profile), options.services, {true, options.seed, &keeper_}) {}

    ReplayResult play(const std::vector<RecordedLine>& recording, SimTime tail);

  private:
    void align(const std::vector<RecordedLine>& recording);
    void advance(SimTime now);
    void take_output();
    void do_entry(SimTime now, const RecordedLine& entry);
    void do_to_machine(SimTime now, const RecordedLine& entry);

    ReplayResult result_;
    NoticeKeeper keeper_;
    WireClock wire_;
    board::Board board_;
    SimTime shift_{0};
};

/// Cuts what the board handed over into lines and notes when each has gone over the wire.
void Player::take_output() {
    std::string_view rest = board_.output();
    while (!rest.empty()) {
        const std::size_t size = std::min(rest.find('\n'), rest.size() - 1) + 1;
        std::string_view line = rest.substr(0, size);
        const SimTime end = wire_.send(board_.time(), line.size());
        line = line.substr(0, line.find_last_not_of("\r\n") + 1);
        result_.lines.push_back({end + shift_, From::board, std::string(line)});
        rest.remove_prefix(size);
    }
    board_.clear_output();
    board_.take_datagrams([this](std::uint64_t peer, std::string_view bytes) {
        result_.lines.push_back({board_.time() + shift_, From::module, std::string(bytes), peer});
    });
}

void Player::advance(SimTime now) {
    take_output();  // what an action said at once
    while (board_.advance(now) <= now || !board_.output().empty()) {
        take_output();
    }
}

void Player::align(const std::vector<RecordedLine>& recording) {
    const auto first = std::find_if(recording.begin(), recording.end(),
                                    [](const RecordedLine& line) { return line.from == From::board; });
    if (first == recording.end()) {
        return;
    }
    advance(SimTime{0});
    if (!result_.lines.empty()) {
        shift_ = first->t - result_.lines.front().t;
        for (RecordedLine& line : result_.lines) {
            line.t += shift_;
        }
    }
}

void Player::do_to_machine(SimTime now, const RecordedLine& entry) {
    try {
        for (const behaviour::ActionCall& call :
             behaviour::parse_action_words(entry.bytes, board_.profile())) {
            board_.act(now, call);
        }
    } catch (const behaviour::ActionWordsError& error) {
        throw ReplayError(
            fmt::format("at {:.6f} s: \"{}\" {}", machine::to_seconds(entry.t), entry.bytes, error.what()));
    }
}

void Player::do_entry(SimTime now, const RecordedLine& entry) {
    switch (entry.from) {
        case From::board:
        case From::usb:
        case From::module:
            break;
        case From::network:
            board_.receive_datagram(now, entry.peer, entry.bytes);
            break;
        case From::screen:
            board_.receive(now, entry.bytes + "\r\n");
            break;
        case From::host:
            board_.receive(now, entry.bytes + "\n", board::Channel::host);
            break;
        case From::world:
            do_to_machine(now, entry);
            break;
    }
}

ReplayResult Player::play(const std::vector<RecordedLine>& recording, SimTime tail) {
    board_.power_on(SimTime{0});
    align(recording);
    SimTime end{0};
    for (const RecordedLine& entry : recording) {
        const SimTime now = entry.t - shift_;
        end = std::max(end, now);
        if (now >= SimTime{0}) {
            advance(now);
            do_entry(now, entry);
        }
    }
    advance(end + tail);
    for (ReplayNotice& notice : result_.notices) {
        notice.t += shift_;
    }
    result_.counters = board_.counters();
    return std::move(result_);
}

}  // namespace

ReplayResult replay(std::shared_ptr<const behaviour::Profile> profile,
                    const std::vector<RecordedLine>& recording, const ReplayOptions& options) {
    return Player(std::move(profile), options).play(recording, options.tail);
}

}  // namespace fauxboard::record
