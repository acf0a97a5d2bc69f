// A whole touch screen, fed arbitrary bytes at arbitrary times and touched anywhere.
//
// The input is a script: one digit, then one step a line. The digit adds up 1 (the A30's screen, else the
// A30T's), 2 (run it again byte by byte: everything must be the same), 4 (a tour is under way), 8 (a screen
// that sends one command at a time; the digit behind 9 is ':'). Steps:
//   s L3 PS:1   a line from the board, framed rightly
//   r ~L1 X2|   bytes from the board as they are: ~ is LF, ` is CR, ^ is NUL, | is CR LF
//   p Home all  a touch by path
//   t 17 2      a touch of button 17, row 2, whatever page is open
//   a 1500      ms go by
//   j 30000     ms go by in which nobody calls the screen
//   o           power off and on

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "emulator/screen/tour.h"
#include "emulator/screen/tour_report.h"
#include "protocol/framing.h"
#include "tests/fuzz/screen_support.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using machine::SimTime;
using screen::Screen;

constexpr SimTime longest{900'000'000};  ///< virtual, of one script
constexpr std::size_t output_bound = 64UL * 1024;

/// One run of one script. The transcript is everything sent and when.
class Run {
  public:
    static constexpr std::size_t heads = 1;

    /// Mode: a digit.
    Run(const std::array<unsigned, heads>& head, bool split)
        : split_(split),
          screen_(shipped_screen((mode_of(head[0]) & 8U) != 0   ? "btt-tft"
                                 : (mode_of(head[0]) & 1U) != 0 ? "geeetech-a30"
                                                                : "geeetech-a30t")) {
        if ((mode_of(head[0]) & 4U) != 0) {
            tour_.emplace(screen_);
        }
        screen_.power_on(now_);
        pass(SimTime{2'000'000});
    }

    void step(std::string_view line);
    void finish();
    const std::string& transcript() const { return transcript_; }

  private:
    void feed(std::string_view bytes);
    void pass(SimTime time);
    void take();
    void touch(std::string_view numbers);
    void press(const screen::PressResult& result);

    bool split_;
    SimTime now_{0};
    Screen screen_;
    std::optional<screen::Tour> tour_;
    std::string transcript_;
    std::string last_;
};

void Run::take() {
    const std::string_view output = screen_.output();
    require(output.size() <= output_bound, "output grows without bound");
    require(output.empty() || output.ends_with('\n') || output.ends_with('\0'), "output ends inside a line");
    transcript_.append(std::to_string(screen_.time().count())).append(" ").append(output);
    last_ = output;
    screen_.clear_output();
}

void Run::feed(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += split_ ? 1 : bytes.size()) {
        screen_.receive(now_, split_ ? bytes.substr(at, 1) : bytes);
    }
    if (!screen_.output().empty()) {
        take();
    }
}

void Run::pass(SimTime time) {
    now_ += std::clamp(time, SimTime{0}, longest - std::min(now_, longest));
    for (std::size_t stops = 0; stops < 100'000; ++stops) {
        const SimTime before = screen_.time();
        const SimTime next = tour_ ? tour_->advance(now_) : screen_.advance(now_);
        require(screen_.time() >= before, "time went back");
        if (screen_.output().empty()) {
            require(next > now_ || tour_, "advance() stopped early without output");
            return;
        }
        take();
    }
    fail("the screen does not come to rest");
}

void Run::press(const screen::PressResult& result) {
    require(result.pressed == result.sentence.empty(), "a touch without a word, or with one too many");
    if (!screen_.output().empty()) {
        take();
    }
}

void Run::touch(std::string_view numbers) {
    std::size_t button = 0;
    std::size_t row = 0;
    const char* end = numbers.data() + numbers.size();
    const auto read = std::from_chars(numbers.data(), end, button);
    if (read.ptr != end) {
        std::from_chars(read.ptr + 1, end, row);
    }
    press(screen_.touch(button % screen_.profile().buttons.size(), row, std::nullopt, now_));
}

void Run::step(std::string_view line) {
    if (line.size() > 1 && line[1] != ' ') {
        return;
    }
    const std::string_view text = line.substr(std::min<std::size_t>(line.size(), 2));
    unsigned number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    const SimTime ms{std::int64_t{number} * 1000};
    switch (line[0]) {
        case 's':
            feed(protocol::frame(text));
            break;
        case 'r':
            feed(unescape(text));
            break;
        case 'p':
            press(screen_.press(text, now_));
            break;
        case 't':
            touch(text);
            break;
        case 'a':
            pass(ms);
            break;
        case 'j':
            now_ += std::min(ms, longest - std::min(now_, longest));
            break;
        case 'o':
            screen_.power_on(now_);
            break;
        default:
            break;
    }
}

/// Everything can be shown, nothing has grown, and the screen still answers.
void Run::finish() {
    for (const screen::Page& page : screen_.profile().pages) {
        const std::string text = screen_.show(page.path);
        require(!text.empty() && text.ends_with('\n'), "a page that cannot be shown");
        transcript_ += text;
    }
    require(screen_.judgements().size() <= 512 && screen_.findings().size() <= 256, "the records grow");
    transcript_ += screen::findings_text(screen_.findings());
    if (tour_) {
        require(tour_->results().size() <= tour_->total(), "more results than buttons");
        transcript_ += screen::tour_junit("x", tour_->results()) + screen::tour_json("x", tour_->results());
        tour_.reset();
    }
    const std::size_t length = transcript_.size();
    feed("\n");
    now_ += longest;
    screen_.power_on(now_);
    now_ += std::chrono::seconds(2);
    while (screen_.advance(now_) <= now_ || !screen_.output().empty())
        take();
    feed(protocol::frame("L21 P0 S0"));
    now_ += SimTime{100'000};
    while (screen_.advance(now_) <= now_ || !screen_.output().empty())
        take();
    // The A30 and A30T answer who they are; the other kind asks by itself.
    const bool asks = screen_.profile().line.lf_only;
    require(last_.find(asks ? "M105" : "M2134 FW:") != std::string::npos,
            "the screen does not answer any more");
    transcript_.resize(length);
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fauxboard::fuzz::play_fuzzed<fauxboard::fuzz::Run>(data, size);
}
