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
    explicit NoticeKeeper(std::function<void(ReplayNotice)> out) : out_(std::move(out)) {}
    void on_received(SimTime, board::Channel, std::string_view, board::Verdict) override {}
    void on_sent(SimTime, board::Channel, std::string_view) override {}
    void on_notice(SimTime now, board::Level level, std::string_view text) override {
        if (told_ < max_notices) {
            ++told_;
            out_({now, level, std::string(text)});
        }
    }

  private:
    std::function<void(ReplayNotice)> out_;
    std::size_t told_ = 0;
};

/// One run. The board's clock starts with its power-on; `shift_` is where that lies in the recording.
class Player {
  public:
    Player(std::shared_ptr<const behaviour::Profile> profile, const ReplayTalk& talk,
           const ReplayOptions& options)
        : talk_(talk),
          keeper_([this](ReplayNotice notice) { tell(std::move(notice)); }),
          wire_(profile->line.baud),
          board_(std::move(profile), options.services, {true, options.seed, &keeper_}) {}

    board::Counters play(SimTime tail);

  private:
    void align();
    void say(RecordedLine line);
    void tell(ReplayNotice notice);
    void advance(SimTime now);
    void take_output();
    void do_entry(SimTime now, const RecordedLine& entry);
    void do_to_machine(SimTime now, const RecordedLine& entry);

    const ReplayTalk& talk_;
    NoticeKeeper keeper_;
    WireClock wire_;
    board::Board board_;
    SimTime shift_{0};
    bool aligned_ = false;
    std::vector<RecordedLine> early_;  ///< said before shift_ was known
    std::vector<ReplayNotice> early_notices_;
};

void Player::say(RecordedLine line) {
    if (!aligned_) {
        early_.push_back(std::move(line));
        return;
    }
    line.t += shift_;
    talk_.on_line(line);
}

void Player::tell(ReplayNotice notice) {
    if (!aligned_) {
        early_notices_.push_back(std::move(notice));
    } else if (talk_.on_notice) {
        notice.t += shift_;
        talk_.on_notice(notice);
    }
}

/// Cuts what the board handed over into lines and notes when each has gone over the wire.
void Player::take_output() {
    std::string_view rest = board_.output();
    while (!rest.empty()) {
        const std::size_t size = std::min(rest.find('\n'), rest.size() - 1) + 1;
        std::string_view line = rest.substr(0, size);
        const SimTime end = wire_.send(board_.time(), line.size());
        line = line.substr(0, line.find_last_not_of("\r\n") + 1);
        say({end, From::board, std::string(line)});
        rest.remove_prefix(size);
    }
    board_.clear_output();
    board_.take_datagrams([this](std::uint64_t peer, std::string_view bytes) {
        say({board_.time(), From::module, std::string(bytes), peer});
    });
}

void Player::advance(SimTime now) {
    take_output();  // what an action said at once
    while (board_.advance(now) <= now || !board_.output().empty()) {
        take_output();
    }
}

void Player::align() {
    if (talk_.first_board_line) {
        advance(SimTime{0});
        if (!early_.empty()) {
            shift_ = *talk_.first_board_line - early_.front().t;
        }
    }
    aligned_ = true;
    for (RecordedLine& line : early_) {
        say(std::move(line));
    }
    early_.clear();
    for (ReplayNotice& notice : early_notices_) {
        tell(std::move(notice));
    }
    early_notices_.clear();
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
        case From::fault:  // what one did to what the board said; what it made the board hear is recorded so
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

board::Counters Player::play(SimTime tail) {
    board_.power_on(SimTime{0});
    align();
    SimTime end{0};
    while (const auto entry = talk_.next()) {
        // What was done before the board first spoke was done when it was switched on.
        const SimTime now =
            entry->from == From::world ? std::max(entry->t - shift_, SimTime{0}) : entry->t - shift_;
        if (now - end > longest_gap) {
            throw ReplayError(fmt::format(
                "at {:.6f} s: nothing for {} days before; a recording is silent for 366 days at most",
                machine::to_seconds(entry->t),
                std::chrono::duration_cast<std::chrono::hours>(now - end).count() / 24));
        }
        end = std::max(end, now);
        if (now >= SimTime{0}) {
            advance(now);
            do_entry(now, *entry);
        }
    }
    advance(end + tail);
    return board_.counters();
}

}  // namespace

board::Counters replay(std::shared_ptr<const behaviour::Profile> profile, const ReplayTalk& talk,
                       const ReplayOptions& options) {
    return Player(std::move(profile), talk, options).play(options.tail);
}

ReplayResult replay(std::shared_ptr<const behaviour::Profile> profile,
                    const std::vector<RecordedLine>& recording, const ReplayOptions& options) {
    ReplayResult result;
    auto at = recording.begin();
    const auto first = std::find_if(recording.begin(), recording.end(),
                                    [](const RecordedLine& line) { return line.from == From::board; });
    ReplayTalk talk;
    talk.next = [&] { return at == recording.end() ? std::nullopt : std::optional(*at++); };
    talk.first_board_line = first == recording.end() ? std::nullopt : std::optional(first->t);
    talk.on_line = [&](const RecordedLine& line) { result.lines.push_back(line); };
    talk.on_notice = [&](const ReplayNotice& notice) { result.notices.push_back(notice); };
    result.counters = replay(std::move(profile), talk, options);
    return result;
}

}  // namespace fauxboard::record
