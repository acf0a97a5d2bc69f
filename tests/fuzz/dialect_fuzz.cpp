// The lines that are spoken as a host speaks, both open at once: whatever comes, each command that is taken
// gets exactly one ok, on its own line.
//
// The input is a script: a digit, then one step a line. The digit adds up 2 (run it again byte by byte: the
// answers must be the same). Steps:
//   m M105~     bytes on the screen's line: ~ is LF, ` is CR, ^ is NUL, | is CR LF
//   h M105~     the same on the USB side
//   n G28       a line with the next number and the right checksum, on the USB side
//   w card out  something done to the machine; unknown names are refused
//   a 1500      ms go by

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "emulator/machine/memory_volume.h"
#include "protocol/framing.h"
#include "protocol/host_line.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using board::Board;
using board::Channel;
using machine::SimTime;

constexpr std::size_t lines = 2;
constexpr SimTime longest{900'000'000};  ///< virtual, of one script
constexpr std::size_t many_stops = 20'000;

/// Marlin as shipped, without the few codes that by the firmware's own word have no ok or two, without those
/// that say a text of the host's, which may be "ok", and without the one that ends all talk.
std::shared_ptr<const behaviour::Profile> profile() {
    static const auto loaded = behaviour::load_profile(
        {"dialect.json", R"({ "name": "dialect", "protocol": "marlin", "extends": "marlin",
            "host_requests": { "M105": { "send": "M105" }, "M112": {}, "M118": {}, "M997": {}, "M999": {} },
            "events": { "heater.nozzle_abnormal": {}, "heater.bed_abnormal": {},
                        "motion.homing_failed": {} } })"},
        shipped_finder());
    return loaded;
}

/// Counts the commands that were taken.
class Counter final : public board::Observer {
  public:
    explicit Counter(const behaviour::Profile& profile) : most_chars_(profile.machine->host.line_chars) {}
    void on_received(SimTime, Channel channel, std::string_view line, board::Verdict verdict) override {
        std::array<char, 512> room;
        const bool blank = protocol::read_host_line(line, room, most_chars_).find_first_not_of(' ') ==
                           std::string_view::npos;
        taken_[static_cast<std::size_t>(channel)] += verdict == board::Verdict::accepted && !blank ? 1U : 0U;
    }
    void on_sent(SimTime, Channel channel, std::string_view line) override {
        oks_[static_cast<std::size_t>(channel)] += line.starts_with("ok") ? 1U : 0U;
    }
    void on_notice(SimTime, board::Level, std::string_view) override {}

    std::uint64_t taken(std::size_t line) const { return taken_[line]; }
    std::uint64_t oks(std::size_t line) const { return oks_[line]; }

  private:
    std::size_t most_chars_;
    std::array<std::uint64_t, behaviour::channel_count> taken_{};
    std::array<std::uint64_t, behaviour::channel_count> oks_{};
};

/// One run of one script. The transcript is everything said, and when.
class Run {
  public:
    static constexpr std::size_t heads = 1;

    Run(const std::array<unsigned, heads>&, bool split)
        : split_(split),
          counter_(*profile()),
          board_(profile(), {&card_, nullptr, nullptr, nullptr}, {true, 7, &counter_}) {
        card_.create("a.g");
        card_.append("a.g", 0, "G4 S1\nM400\nM0\n");
        board_.connect(Channel::host, true);
        board_.power_on(now_);
        pass(SimTime{1'000'000});
    }

    void step(std::string_view line);
    void finish();
    const std::string& transcript() const { return transcript_; }

  private:
    void feed(Channel channel, std::string_view bytes);
    void pass(SimTime time);
    void take();
    void count();

    bool split_;
    machine::MemoryVolume card_;
    Counter counter_;
    SimTime now_{0};
    Board board_;
    std::string transcript_;
};

/// Every command taken has its ok, but for those that wait and the one that runs; so has every line that was
/// asked for again.
void Run::count() {
    const machine::HostSide& host = board_.machine().host_side();
    for (std::size_t i = 0; i < lines; ++i) {
        const std::uint64_t open =
            board_.waiting(static_cast<Channel>(i)) + (host.running() && host.speaker == i ? 1 : 0);
        require(counter_.oks(i) + open == counter_.taken(i) + host.lines[i].resends,
                "a command has no ok, or more than one");
    }
}

void Run::take() {
    for (const Channel channel : {Channel::main, Channel::host}) {
        const std::string_view output = board_.output(channel);
        require(output.empty() || output.ends_with('\n'), "a line without an end");
        transcript_.append(board::other_end(channel))
            .append(std::to_string(board_.time().count()))
            .append(output);
    }
    board_.clear_output();
    count();
}

void Run::feed(Channel channel, std::string_view bytes) {
    if (bytes.empty()) {
        return;  // no link hands over nothing; a call at all makes the board catch up
    }
    if (!split_) {
        board_.receive(now_, bytes, channel);
        take();
        return;
    }
    for (const char& byte : bytes) {
        board_.receive(now_, {&byte, 1}, channel);
    }
    take();
}

void Run::pass(SimTime time) {
    now_ = std::min(now_ + time, longest);
    for (std::size_t stops = 0; stops < many_stops && board_.advance(now_) <= now_; ++stops) {
        take();
    }
    take();
}

void Run::step(std::string_view line) {
    const std::string_view rest = line.substr(std::min<std::size_t>(line.size(), 2));
    if (line[0] == 'm' || line[0] == 'h') {
        feed(line[0] == 'm' ? Channel::main : Channel::host, unescape(rest));
    } else if (line[0] == 'n') {
        std::string framed =
            "N" + std::to_string(board_.machine().host_side().lines[1].last + 1) + " " + unescape(rest);
        framed += "*" + std::to_string(protocol::xor_checksum(framed)) + "\n";
        feed(Channel::host, framed);
    } else if (line[0] == 'w') {
        board_.world(now_, rest);
        take();
    } else if (line[0] == 'a') {
        unsigned ms = 0;
        std::from_chars(rest.data(), rest.data() + rest.size(), ms);
        pass(SimTime{1000} * std::min(ms, 120'000U));
    }
}

void Run::finish() {
    pass(SimTime{60'000'000});
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fauxboard::fuzz::play_fuzzed<fauxboard::fuzz::Run>(data, size);
}
