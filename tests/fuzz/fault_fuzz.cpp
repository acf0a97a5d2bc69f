// A line under arbitrary faults, fed arbitrary bytes at arbitrary times.
//
// The input is a script, one step a line:
//   f drop:every=2      a fault is added; a wrong one is refused with a sentence
//   c 1 slow:rate=9B/s  the fault of that id is changed (one digit)
//   d 1                 the fault of that id is removed
//   x                   all are cleared
//   s ~M115|            bytes for the screen: ~ is LF, ` is CR, ^ is NUL, | is CR LF
//   b ~M115|            bytes for the board
//   a 1500              ms go by

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emulator/fault/faults.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using fault::FaultLine;
using fault::Faults;
using machine::SimTime;

constexpr std::size_t many_steps = 200;
constexpr SimTime longest_wait{3'600'000'000};

/// The spec, if the text is right; then both of its forms must give it again.
std::optional<fault::FaultSpec> parse(std::string_view text) {
    try {
        const fault::FaultSpec spec = fault::fault_from_text(text);
        require(fault::fault_from_text(fault::fault_to_text(spec)) == spec,
                "a spec changes on its way to text");
        require(fault::fault_from_json(fault::fault_to_json(spec)) == spec,
                "a spec changes on its way to JSON");
        return spec;
    } catch (const fault::FaultSpecError& error) {
        require(!error.problems().empty() && error.problems().front().starts_with("fault"),
                "an error says nothing");
        return std::nullopt;
    }
}

/// One run of one script; `chunk` is how many bytes are pushed at once. Its transcript is all that came out,
/// each direction for itself.
class Run {
  public:
    explicit Run(std::size_t chunk) : chunk_(chunk) {}
    void step(std::string_view line);
    void finish();
    const std::string& to_screen() const { return to_screen_; }
    const std::string& to_board() const { return to_board_; }

  private:
    void add(std::string_view text);
    void push(FaultLine& line, std::string_view bytes);
    void pass(SimTime time);
    void take();

    std::size_t chunk_;
    SimTime now_{0};
    Faults faults_;
    std::string to_screen_;
    std::string to_board_;
};

void Run::take() {
    for (FaultLine* line : {&faults_.to_screen(), &faults_.to_board()}) {
        require(line->held() <= FaultLine::most_held + fault::LineCutter::longest + 2, "too much is held");
        std::string& all = line == &faults_.to_screen() ? to_screen_ : to_board_;
        all.append(line->output());
        line->clear_output();
    }
}

void Run::push(FaultLine& line, std::string_view bytes) {
    for (; !bytes.empty(); bytes.remove_prefix(std::min(chunk_, bytes.size()))) {
        const std::string_view piece = bytes.substr(0, chunk_);
        line.push(now_, piece);
        const std::size_t lines = piece.size() + 2;
        require(line.output().size() <=
                    lines * (FaultLine::most_growth + 2 * fault::LineCutter::longest) + FaultLine::most_held,
                "output grows without bound");
        take();
    }
}

void Run::pass(SimTime time) {
    now_ += time;
    const SimTime next = faults_.advance(now_);
    require(next > now_, "what is due is left undone");
    take();
}

void Run::add(std::string_view text) {
    const auto spec = parse(text);
    if (!spec) {
        return;
    }
    try {
        faults_.add(now_, *spec);
    } catch (const fault::FaultSpecError&) {
        require(faults_.list(now_).size() >= FaultLine::most_faults, "refused though there is room");
    }
}

void Run::step(std::string_view line) {
    if (line.size() > 1 && line[1] != ' ') {
        return;
    }
    const std::string_view text = line.substr(std::min<std::size_t>(line.size(), 2));
    unsigned number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    switch (line[0]) {
        case 'f':
            add(text);
            break;
        case 'c':
            if (const auto spec = parse(text.substr(std::min<std::size_t>(text.size(), 2)))) {
                try {
                    faults_.change(now_, number, *spec);
                } catch (const fault::FaultSpecError&) {
                    require(faults_.list(now_).size() >= FaultLine::most_faults,
                            "refused though there is room");
                }
            }
            break;
        case 'd':
            faults_.remove(now_, number);
            break;
        case 'x':
            faults_.clear(now_);
            break;
        case 's':
            push(faults_.to_screen(), unescape(text));
            break;
        case 'b':
            push(faults_.to_board(), unescape(text));
            break;
        case 'a':
            pass(std::min(SimTime{std::int64_t{number} * 1000}, longest_wait));
            break;
        default:
            break;
    }
}

/// Cleared, the line is a wire.
void Run::finish() {
    faults_.clear(now_);
    take();
    require(faults_.connected(now_), "cleared, the link is down");
    require(faults_.to_screen().held() + faults_.to_board().held() == 0, "cleared, bytes are held");
    require(faults_.advance(now_) == machine::never, "cleared, it wants to be called");
    for (FaultLine* line : {&faults_.to_screen(), &faults_.to_board()}) {
        line->push(now_, "half a l");
        require(line->output() == "half a l", "cleared, bytes do not pass at once");
        line->clear_output();
    }
}

void play(std::string_view script, Run& run) {
    std::size_t steps = 0;
    for_each_line(script, [&](std::string_view line) {
        if (steps++ < many_steps && !line.empty()) {
            run.step(line);
        }
    });
    run.finish();
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string script(data, data + std::min<std::size_t>(size, 4096));
    fauxboard::fuzz::Run whole(1 << 20);
    fauxboard::fuzz::play(script, whole);
    fauxboard::fuzz::Run split(3);
    fauxboard::fuzz::play(script, split);
    fauxboard::fuzz::require(whole.to_screen() == split.to_screen() && whole.to_board() == split.to_board(),
                             "another split of the same bytes is spoiled otherwise");
    return 0;
}
