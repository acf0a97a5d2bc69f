// Two clients of a control channel that send anything, at any time.
//
// The input is a script, one step a line:
//   > {"op": "get"}   a line of the first client; ^ stands for a NUL, ` for a CR
//   ~ {"op":          the same without its line end: the next one goes on with it
//   2 {"op": "get"}   a line of the second client
//   a 1500            ms go by
//   r                 the first client takes its output
//   x                 the first client leaves, and another comes
// Anything else is bytes of the first client, with their line end.

#include <algorithm>
#include <charconv>
#include <memory>
#include <string>

#include "emulator/control/hub.h"
#include "emulator/control/session.h"
#include "protocol/framing.h"
#include "tests/fuzz/support.h"
#include "tests/support/loose_faults.h"

namespace fauxboard::fuzz {
namespace {

using control::Json;
using control::Session;
using machine::SimTime;

constexpr std::size_t many_steps = 100;
constexpr SimTime longest_wait{600'000'000};
/// Virtual time that one script may take: a fuzzer wants many scripts.
constexpr SimTime longest_run{3'600'000'000};

/// What a client got: every line must be whole JSON, and an answer or an event.
void check_lines(std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        require(end != std::string_view::npos, "output ends in the middle of a line");
        const Json line = Json::parse(text.substr(0, end), nullptr, false);
        require(line.is_object(), "a line that is no JSON object");
        require(line.contains("ok") != line.contains("event"), "a line is neither answer nor event");
        if (line.contains("ok") && !line["ok"].get<bool>()) {
            require(line["error"]["code"] != "internal", "an internal error");
            require(!line["error"]["message"].get<std::string>().empty(), "an error says nothing");
        }
        text.remove_prefix(end + 1);
    }
}

class Run final : public control::Target {
  public:
    explicit Run(std::size_t chunk)
        : hub_(*this),
          board_(shipped_profile("geeetech-a30t"), {}, {false, 1, &hub_}),
          chunk_(chunk),
          first_(std::make_unique<Session>(hub_, [] {})),
          second_(std::make_unique<Session>(hub_, [] {})) {
        board_.power_on(SimTime{0});
        step(SimTime{1'000'000});
    }

    const board::Board& board() const override { return board_; }
    void visit(const std::function<void(board::Board&, SimTime)>& use) override {
        use(board_, now_);
        board_.clear_output();
    }
    SimTime skip(SimTime by) override {
        skip_to_ = std::max(skip_to_, now_) + by;
        return skip_to_;
    }
    void quit() override {}
    fault::FaultControl* faults() override { return &faults_; }
    Json status() const override { return Json::object(); }

    void line(std::string_view text);
    void finish();
    const std::string& transcript() const { return transcript_; }

  private:
    void step(SimTime to);
    void say(Session& session, std::string_view bytes);
    void take(Session& session);
    void renew();

    control::Hub hub_;
    board::Board board_;
    testing::LooseFaults faults_;
    std::size_t chunk_;
    SimTime now_{0};
    SimTime skip_to_{0};
    std::unique_ptr<Session> first_;
    std::unique_ptr<Session> second_;
    std::string transcript_;  ///< of the first client
};

void Run::step(SimTime to) {
    to = std::min(to, longest_run);
    for (;;) {
        board_.refresh(now_);
        board_.clear_output();
        const SimTime watch = hub_.on_moved(now_);
        require(watch > now_, "what is due is left undone");
        if (now_ >= to) {
            return;
        }
        const SimTime next = std::min(board_.advance(std::min(to, watch)), watch);
        board_.clear_output();
        now_ = std::clamp(next, board_.time(), to);
    }
}

void Run::take(Session& session) {
    const std::string output = session.take_output();
    require(output.size() < 4 * Session::most_waiting, "a session keeps too much");
    check_lines(output);
    if (&session == first_.get()) {
        transcript_ += output;
    }
}

void Run::say(Session& session, std::string_view bytes) {
    for (; !bytes.empty(); bytes.remove_prefix(std::min(chunk_, bytes.size()))) {
        // A host reads no further while the session wants nothing: time has to jump, or output be taken.
        for (int i = 0; i < 3 && !session.wants_input() && !session.over(); ++i) {
            step(skip_to_);
            take(session);
            session.proceed();
            if (now_ >= longest_run) {
                return;
            }
        }
        session.receive(bytes.substr(0, chunk_));
    }
}

void Run::renew() {
    first_->finish();
    take(*first_);
    first_ = std::make_unique<Session>(hub_, [] {});
}

void Run::line(std::string_view text) {
    std::string bytes(text);
    std::replace(bytes.begin(), bytes.end(), '^', '\0');
    std::replace(bytes.begin(), bytes.end(), '`', '\r');
    const bool command = text.size() == 1 || (text.size() > 1 && text[1] == ' ');
    const std::string_view rest = std::string_view(bytes).substr(std::min<std::size_t>(2, bytes.size()));
    if (command && text[0] == '>') {
        say(*first_, std::string(rest) + '\n');
    } else if (command && text[0] == '~') {
        say(*first_, rest);
    } else if (command && text[0] == '2') {
        say(*second_, std::string(rest) + '\n');
        take(*second_);
    } else if (command && text[0] == 'a') {
        unsigned ms = 0;
        std::from_chars(rest.data(), rest.data() + rest.size(), ms);
        step(now_ + std::min(SimTime{std::int64_t{ms} * 1000}, longest_wait));
    } else if (command && text[0] == 'r') {
        take(*first_);
        first_->proceed();
    } else if (command && text[0] == 'x') {
        renew();
    } else {
        say(*first_, bytes + '\n');
    }
}

/// The board still answers, and so does a client that comes now.
void Run::finish() {
    take(*first_);
    hub_.on_end();
    take(*first_);
    take(*second_);
    Session last(hub_, [] {});
    last.receive("{\"op\": \"status\"}\n");
    const Json answer = Json::parse(last.take_output(), nullptr, false);
    require(answer.is_object() && answer["ok"] == true, "a new client is not answered");
    board_.clear_output();
    board_.receive(now_, protocol::frame("M105"));
    board_.advance(now_);
    require(board_.output().find("L2 ") != std::string_view::npos, "the board does not answer any more");
}

std::string play(std::string_view script, std::size_t chunk) {
    Run run(chunk);
    std::size_t steps = 0;
    for_each_line(script, [&](std::string_view line) {
        if (steps++ < many_steps) {
            run.line(line);
        }
    });
    run.finish();
    return run.transcript();
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string script(data, data + std::min<std::size_t>(size, 4096));
    const std::string whole = fauxboard::fuzz::play(script, 1 << 20);
    // When time has to jump in the middle of a write depends on the split; answers without it do not.
    if (script.find("advance") == std::string::npos && script.size() < 1024) {
        fauxboard::fuzz::require(fauxboard::fuzz::play(script, 3) == whole,
                                 "another split of the same bytes is answered otherwise");
    }
    return 0;
}
