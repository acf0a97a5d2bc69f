#pragma once

// What the fuzz targets share: how a broken rule is reported, and what every line of a board must look like.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/behaviour/profile.h"
#include "emulator/board/board.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fauxboard::fuzz {

/// Ends the process with `rule` on stderr, so that the fuzzer keeps the input.
[[noreturn]] void fail(std::string_view rule);

inline void require(bool holds, std::string_view rule) {
    if (!holds) {
        fail(rule);
    }
}

/// Calls step(line) for each line of a script, empty ones too, their ends left off.
template <class Step>
void for_each_line(std::string_view script, Step&& step) {
    while (!script.empty()) {
        const std::size_t end = std::min(script.find('\n'), script.size());
        step(script.substr(0, end));
        script.remove_prefix(std::min(end + 1, script.size()));
    }
}

/// Bytes that a script's line cannot hold: "~" is LF, "`" CR, "|" both, "^" NUL.
inline std::string unescape(std::string_view text) {
    std::string bytes;
    for (const char c : text) {
        if (c == '|') {
            bytes += "\r\n";
        } else {
            bytes += c == '~' ? '\n' : c == '`' ? '\r' : c == '^' ? '\0' : c;
        }
    }
    return bytes;
}

/// A script's first byte is a digit, whose bits choose; see play_fuzzed() for bit 1.
constexpr unsigned mode_of(unsigned head) {
    return head - unsigned{'0'};
}

/// Plays a script, line by line, and returns the transcript. Its first `Run::heads` bytes choose what is
/// played on; a missing one is 0.
template <class Run>
std::string play_script(std::string_view script, bool split) {
    std::array<unsigned, Run::heads> heads{};
    for (std::size_t i = 0; i < heads.size() && i < script.size(); ++i) {
        heads[i] = static_cast<unsigned char>(script[i]);
    }
    Run run(heads, split);
    script.remove_prefix(std::min(script.size(), heads.size()));
    for_each_line(script, [&](std::string_view line) {
        if (!line.empty()) {
            run.step(line);
        }
    });
    run.finish();
    return run.transcript();
}

/// Plays what a fuzzer made up; twice, with the bytes split otherwise, when its first byte asks for that.
template <class Run>
int play_fuzzed(const std::uint8_t* data, std::size_t size) {
    const std::string script(data, data + std::min<std::size_t>(size, 8192));
    const std::string said = play_script<Run>(script, false);
    if (!script.empty() && (mode_of(static_cast<unsigned char>(script[0])) & 2U) != 0) {
        require(play_script<Run>(script, true) == said,
                "another split of the same bytes is answered otherwise");
    }
    return 0;
}

/// A profile as shipped, by name. Read once.
std::shared_ptr<const behaviour::Profile> shipped_profile(std::string_view name);

/// Finds the shipped profiles, and nothing else.
behaviour::SourceFinder shipped_finder();

/// Output of a board: whole lines, each ended by CR LF and without other control bytes but a tab, which a
/// text of the host's may have. With `checksums`, what starts as a frame also carries the right checksum,
/// unless it is one of the two lines that a real board leaves unfinished.
void check_output(std::string_view output, bool checksums);

/// Advances the board to `target`, stopping at each output, which goes to `take(time, bytes)` before it is
/// cleared. Checks that time never goes back, that every stop has output, and that the board wants to be
/// called again later than now. Gives up quietly after `max_stops` outputs.
template <class Take>
void advance_to(board::Board& board, machine::SimTime target, std::size_t max_stops, Take&& take) {
    for (std::size_t stops = 0; stops < max_stops; ++stops) {
        const machine::SimTime before = board.time();
        const machine::SimTime next = board.advance(target);
        require(board.time() >= before, "time went back");
        const std::string_view output = board.output();
        if (output.empty()) {
            require(next > target, "advance() stopped early without output");
            return;
        }
        take(board.time(), output);
        board.clear_output();
    }
}

}  // namespace fauxboard::fuzz
