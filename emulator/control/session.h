#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/control/names.h"
#include "emulator/control/ops.h"
#include "emulator/control/target.h"

namespace fauxboard::control {

class Hub;

/// One client: bytes of requests in, bytes of answers and events out. No socket, no clock.
///
/// Use: receive() while wants_input(), finish() when the client will send no more. `wake` tells, once until
/// take_output(), that there is output or that ready() has changed; it may be called from inside any call
/// that concerns the board, so it must only take note. Then: take_output() when the last output has been
/// written, proceed(), and close when dropped(), or when over() and nothing is left to write.
///
/// Memory is bounded: a line that is too long ends the session, requests wait while answers are not taken,
/// and events that find no room are counted and lost. A client that loses most_lost of them without taking
/// anything is dropped.
class Session {
  public:
    static constexpr std::size_t most_line = 16UL * 1024;  ///< bytes of one request
    static constexpr std::size_t most_waiting =
        256UL * 1024;  ///< bytes of output beyond which nothing is added
    static constexpr std::uint64_t most_lost = 10'000;

    Session(Hub& hub, std::function<void()> wake);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Bytes as they come; any split of them does the same.
    void receive(std::string_view bytes);
    /// The client's side is closed. What it asked is still answered; half a line is not carried out.
    void finish();
    /// Carries out requests that had to wait.
    void proceed();

    bool wants_input() const { return !over_ && !finished_ && !busy(); }
    /// Nothing more comes of it than the output there is.
    bool over() const;
    /// The client is not worth waiting for.
    bool dropped() const { return dropped_; }
    bool has_output() const { return !output_.empty(); }
    /// All output there is, whole lines.
    std::string take_output();

    // For ops.
    // -------------------------------------------------------------------------------------------

    /// What a client has subscribed to.
    struct Subscriptions {
        std::uint32_t topics = 0;   ///< bit() of each
        bool words = false;         ///< of traffic: with what the lines mean
        std::vector<Place> places;  ///< of state
        SimTime every{0};
        SimTime due{0};
        std::vector<Json> last;  ///< as last told, one for each place
    };
    Subscriptions subscriptions;
    bool wants(TopicId topic) const { return (subscriptions.topics & bit(topic)) != 0; }

    /// The request at hand is answered when virtual time has got to `until`; others wait.
    void answer_at(SimTime until) { until_ = until; }

    // For the hub.
    // -------------------------------------------------------------------------------------------

    /// Does what is due. When it next wants to be called, machine::never if not at all.
    SimTime on_moved(const board::Board& board, SimTime now);
    /// Something to be told unasked: {"event": ...}.
    void tell(const Json& event);
    /// The profile's variables may be others now.
    void on_reload(const board::Board& board);
    /// The run is over: what waits for an answer gets one that says so.
    void on_end();

  private:
    bool busy() const { return until_.has_value() || output_.size() >= most_waiting; }
    void carry_out(std::string_view line);
    Json answer_to(std::string_view line, bool& later);
    void answer(const Json& json);
    void close_with(ErrorCode code, const std::string& sentence);
    void sample(const board::Board& board, SimTime now);
    void wake();

    Hub& hub_;
    std::function<void()> wake_;
    std::string input_;
    std::string output_;
    std::optional<SimTime> until_;  ///< of the answer that comes later
    Json later_;                    ///< that answer
    std::uint64_t lost_ = 0;        ///< events, since the last take_output()
    bool woken_ = false;
    bool finished_ = false;
    bool over_ = false;
    bool dropped_ = false;
};

}  // namespace fauxboard::control
