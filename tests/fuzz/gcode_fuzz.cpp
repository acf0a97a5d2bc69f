// Arbitrary bytes as the file of a print, carried out by a whole board in virtual time.
//
// The input's first line is a script, the rest is the file. The script begins with two digits: the first adds
// up 1 (no pacing) and 2 (run it again in other pieces of time: the talk must be the same), the second
// chooses the profile. Its steps stand behind them, parted by blanks, a letter each and a number for some:
//   x90    the file is its text this many times over (256 KiB at most)
//   g      the file is chosen and started
//   p r s  pause, resume, stop
//   u      the user answers a file that waits
//   m123   on at this byte
//   o i b  the card goes out, comes in, breaks
//   f v    the file vanishes, comes back
//   e t    reading fails, works again
//   d      power off and on
//   a1500  ms go by
//   q      where it stands is asked

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <string>

#include "protocol/framing.h"
#include "tests/fuzz/support.h"
#include "tests/support/printers.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::fuzz {
namespace {

using machine::JobStatus;
using machine::SimTime;

constexpr std::array<std::string_view, 3> profiles{"geeetech-a30t", "geeetech-a30", "geeetech-a30t-no-card"};
constexpr std::string_view file_name = "f.gcode";
constexpr std::size_t most_file_bytes = 256UL * 1024;
constexpr std::size_t most_steps = 64;
/// Of one script: virtual, and lines of the file. What comes after that is not played.
constexpr SimTime longest = std::chrono::minutes(10);
constexpr std::uint64_t many_lines = 20'000;
constexpr std::size_t many_stops = 20'000;
/// The stretch in which the work is bounded, and the bound on the lines: 4 KiB each 10 ms, were they all
/// empty, and the line in which each 4 KiB end.
constexpr SimTime stretch = std::chrono::milliseconds(100);
constexpr std::uint64_t most_stretch_lines = 11 * (4096 + 1);
/// Of one stop: 16 KiB without pacing, and one more rule.
constexpr std::size_t output_bound = 64UL * 1024;

class Print {
  public:
    Print(unsigned mode, std::size_t profile, std::string_view text, bool small_steps)
        : text_(text),
          small_steps_(small_steps),
          board_(shipped_profile(profiles[profile % profiles.size()]), services(),
                 {(mode & 1U) == 0, 7, nullptr}) {
        board_.power_on(now_);
        provide(1);
    }

    void step(char letter, std::uint64_t number);
    /// The job is stopped; the board must still answer.
    void finish();
    const std::string& transcript() const { return transcript_; }

  private:
    machine::Services services() {
        machine::Services made;
        made.sd = &disk_;
        return made;
    }
    void provide(std::uint64_t times);
    void ask(std::string_view body);
    void pass(SimTime time, std::uint64_t most_lines = many_lines);
    void pass_stretch(SimTime time);
    void take(SimTime time, std::string_view output);
    void watch();

    std::string_view text_;
    bool small_steps_;
    testing::MemoryDisk disk_;
    SimTime now_{0};
    board::Board board_;
    std::string transcript_;
    std::uint64_t file_bytes_ = 0;
    bool answered_ = false;
    bool moved_ = false;  ///< by M26: then the place may go back
    std::uint64_t lines_played_ = 0;
    std::uint64_t lines_ = 0;  ///< of the job, when last looked at; and so on
    std::uint64_t byte_ = 0;
    std::uint64_t executed_ = 0;
    int progress_ = 0;
};

/// Puts the file on the disk, its text `times` over, made while it is read.
void Print::provide(std::uint64_t times) {
    const std::uint64_t most = text_.empty() ? 0 : most_file_bytes / text_.size();
    file_bytes_ = text_.size() * std::clamp<std::uint64_t>(times, 1, std::max<std::uint64_t>(most, 1));
    disk_.put(std::string(file_name), file_bytes_, [this](std::uint64_t offset, std::span<char> out) {
        for (std::size_t i = 0; i < out.size();) {
            i += text_.copy(out.data() + i, out.size() - i, (offset + i) % text_.size());
        }
    });
}

/// What must hold of the job at any moment.
void Print::watch() {
    const machine::Job& job = board_.machine().job;
    const filament::JobRunner& runner = testing::filament_printer(board_.machine()).runner;
    require(job.byte() <= job.bytes(), "the place is beyond the end of the file");
    require(job.progress_percent() >= 0 && job.progress_percent() <= 100, "progress is no percentage");
    require(job.layer >= 0 && job.layers >= 0, "there are fewer layers than none");
    const std::uint64_t lines = runner.counts().lines;  // starts anew with a job, and stays behind it
    const bool same_job = lines >= lines_;
    lines_played_ += same_job ? lines - lines_ : lines;
    lines_ = lines;
    if (!same_job || !job.active()) {
        byte_ = executed_ = 0;
        progress_ = 0;
    }
    if (!job.active() || moved_) {
        return;
    }
    require(runner.executed_byte() <= job.byte(), "more is carried out than was read");
    require(job.byte() >= byte_, "the place in the file went back");
    require(runner.executed_byte() >= executed_, "the place carried out went back");
    require(job.progress_percent() >= progress_, "progress went back");
    byte_ = job.byte();
    executed_ = runner.executed_byte();
    progress_ = job.progress_percent();
}

void Print::take(SimTime time, std::string_view output) {
    check_output(output, true);
    require(output.size() <= output_bound, "output grows without bound");
    answered_ = answered_ || output.find("L9 DN:") != std::string_view::npos;
    transcript_.append(std::to_string(time.count())).append(" ").append(output);
    watch();
}

void Print::ask(std::string_view body) {
    board_.receive(now_, protocol::frame(body));
    if (!board_.output().empty()) {
        take(board_.time(), board_.output());
        board_.clear_output();
    }
    watch();
}

/// At most one stretch.
void Print::pass_stretch(SimTime time) {
    const std::uint64_t before = lines_played_;
    const SimTime end = now_ + time;
    while (now_ < end) {
        now_ = small_steps_ ? std::min(end, now_ + SimTime{17'300}) : end;
        advance_to(board_, now_, many_stops, [this](SimTime t, std::string_view bytes) { take(t, bytes); });
    }
    watch();
    require(lines_played_ - before <= most_stretch_lines, "the file is read without a rest");
}

/// Ends early when `most_lines` of the file were played in this run.
void Print::pass(SimTime time, std::uint64_t most_lines) {
    const SimTime end = now_ + time;
    while (now_ < end && lines_played_ < most_lines) {
        pass_stretch(std::min(stretch, end - now_));
    }
}

void Print::step(char letter, std::uint64_t number) {
    switch (letter) {
        case 'x':
            return provide(number);
        case 'g':
            ask("M23 f.gcode");
            return ask("M24");
        case 'p':
            return ask("M25");
        case 'r':
            return ask("M24");
        case 's':
            return ask("M2103");
        case 'u':
            return ask("M108");
        case 'm':
            moved_ = true;
            return ask("M26 S" + std::to_string(number));
        case 'q':
            ask("M27");
            return ask("M2101");
        case 'o':
        case 'i':
        case 'b':
            board_.world(now_, letter == 'o' ? "card out" : letter == 'i' ? "card in" : "card broken");
            return;
        case 'f':
            disk_.remove(file_name);
            return;
        case 'v':
            return provide(text_.empty() ? 1 : file_bytes_ / text_.size());
        case 'e':
        case 't':
            return disk_.set_failing(letter == 'e');
        case 'd':
            board_.power_on(now_);
            return watch();
        case 'a':
            return pass(
                std::min(SimTime{static_cast<std::int64_t>(std::min<std::uint64_t>(number, 600'000)) * 1000},
                         longest - std::min(now_, longest)));
        default:
            return;
    }
}

void Print::finish() {
    ask("M2103");
    constexpr std::uint64_t all = machine::never.count();  // of one file, until the request is taken
    pass(std::chrono::seconds(60), all);
    ask("M2103");  // the first one may have found the queue full
    pass(std::chrono::seconds(10), all);
    require(!board_.machine().job.active(), "a job cannot be stopped");
    if (board_.machine().hung()) {  // the file said M112
        board_.power_on(now_);
        pass(std::chrono::seconds(60), all);
    }
    answered_ = false;
    ask("M115");
    pass(std::chrono::seconds(10), all);
    require(answered_, "the board does not answer any more");
}

std::string play(std::string_view input, bool small_steps) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    std::string_view script = input.substr(0, end);
    const auto digit = [&](std::size_t i) {
        return i < script.size() ? static_cast<unsigned char>(script[i]) : 0U;
    };
    Print print(digit(0) - '0', digit(1), input.substr(std::min(end + 1, input.size())), small_steps);
    script.remove_prefix(std::min<std::size_t>(script.size(), 2));
    for (std::size_t steps = 0; !script.empty() && steps < most_steps; ++steps) {
        const std::string_view word = script.substr(0, std::min(script.find(' '), script.size()));
        script.remove_prefix(std::min(word.size() + 1, script.size()));
        std::uint64_t number = 0;
        if (!word.empty()) {
            std::from_chars(word.data() + 1, word.data() + word.size(), number);
            print.step(word[0], number);
        }
    }
    print.finish();
    return print.transcript();
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string input(data, data + std::min<std::size_t>(size, 8192));
    const std::string said = fauxboard::fuzz::play(input, false);
    if (!input.empty() && ((static_cast<unsigned char>(input[0]) - '0') & 2U) != 0) {
        fauxboard::fuzz::require(fauxboard::fuzz::play(input, true) == said,
                                 "in other pieces of time the board says something else");
    }
    return 0;
}
