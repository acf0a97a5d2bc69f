#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/control/hub.h"
#include "emulator/host/clock.h"
#include "emulator/host/live_board.h"
#include "emulator/host/live_observer.h"
#include "emulator/link/link.h"
#include "emulator/link/local_listener.h"

namespace fauxboard::host {

/// The control channel of one live board: a Unix socket with a line of JSON for each request and answer,
/// apart from the tested line. What is said on it is the business of emulator/control; here are the socket,
/// its clients, and time.
class ControlServer final : public LiveObserver, private control::Target {
  public:
    static constexpr std::size_t most_clients = 128;

    struct Parts {
        link::EventLoop& loop;
        board::Board& board;
        LiveBoard& live;
        Clock& clock;
        const link::Link& link;
        fault::FaultControl* faults;                ///< null: the line takes none
        std::function<void()> quit;                 ///< ends the run; called from the event loop
        std::function<void(std::string_view)> say;  ///< what a person wants to know of the channel itself
    };
    /// All of it outlives this. Follows `live`, so make it before that is started; hand it to the observers.
    explicit ControlServer(Parts parts);
    ~ControlServer() override;

    /// Throws link::LinkError, see link::LocalPath::listen.
    void open(const std::string& path);
    /// Tells the clients that this is the end, as far as they read, and removes the socket. Idempotent.
    void close();
    /// A changed profile is in force.
    void on_reload() { hub_.on_reload(); }

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override {
        hub_.on_received(now, channel, line, verdict);
    }
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override {
        hub_.on_sent(now, channel, line);
    }
    void on_notice(SimTime now, board::Level level, std::string_view text) override {
        hub_.on_notice(now, level, text);
    }
    void on_link(SimTime now, link::LinkState state, std::string_view why) override;

  private:
    class Client;

    const board::Board& board() const override { return parts_.board; }
    void visit(const std::function<void(board::Board&, SimTime)>& use) override { parts_.live.visit(use); }
    SimTime skip(SimTime by) override;
    void quit() override;
    fault::FaultControl* faults() override { return parts_.faults; }
    control::Json status() const override;

    void take(link::UniqueFd socket);
    void turn_away(const link::UniqueFd& socket) const;
    void leave(const Client& client);
    template <class Task>
    void post(Task task);
    void queue(const std::shared_ptr<Client>& client);
    void serve_next();
    void skip_on();

    Parts parts_;
    control::Hub hub_;
    std::vector<std::shared_ptr<Client>> clients_;
    /// Who has said something that was not looked at yet. One request is carried out on a turn of the loop,
    /// each client's in turn: a client that floods us slows down itself, neither the others nor the line.
    std::deque<std::weak_ptr<Client>> queue_;
    link::LocalListener listener_;
    SimTime skip_to_{0};  ///< virtual time is to jump that far
    /// What is posted to the event loop finds this gone when this object is.
    std::shared_ptr<int> life_ = std::make_shared<int>();
};

}  // namespace fauxboard::host
