#include "emulator/record/host_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace fauxboard::record {
namespace {

using machine::SimTime;
using Kind = HostLogLine::Kind;

/// What stands before a line of the wire: OctoPrint's words, then printcore's.
constexpr std::array<std::pair<std::string_view, Kind>, 4> speakers{{
    {"Send: ", Kind::sent},
    {"Recv: ", Kind::received},
    {"SENT: ", Kind::sent},
    {"RECV: ", Kind::received},
}};

/// What Python's logging puts before them where nobody told it otherwise.
constexpr std::array<std::string_view, 2> levels{"INFO:root:", "[INFO] "};

/// Every digit as '9', every letter as 'a': "9999-99-99 99:99:99,999".
std::string shape_of(std::string_view text) {
    std::string shape(text);
    for (char& c : shape) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        c = c >= '0' && c <= '9' ? '9' : letter ? 'a' : c;
    }
    return shape;
}

int number_at(std::string_view text, std::size_t at, std::size_t digits) {
    int value = 0;
    std::from_chars(text.data() + at, text.data() + at + digits, value);
    return value;
}

/// The stamp of Python's logging, which OctoPrint leaves as it is.
std::optional<HostLogLine::Stamp> read_stamp(std::string_view text) {
    constexpr std::string_view shape = "9999-99-99 99:99:99,999";
    if (text.size() < shape.size() || shape_of(text.substr(0, shape.size())) != shape) {
        return std::nullopt;
    }
    const std::chrono::year_month_day day{std::chrono::year{number_at(text, 0, 4)},
                                          std::chrono::month{static_cast<unsigned>(number_at(text, 5, 2))},
                                          std::chrono::day{static_cast<unsigned>(number_at(text, 8, 2))}};
    const int hours = number_at(text, 11, 2);
    const int minutes = number_at(text, 14, 2);
    const int seconds = number_at(text, 17, 2);
    if (!day.ok() || hours > 23 || minutes > 59 || seconds > 60) {
        return std::nullopt;
    }
    HostLogLine::Stamp stamp;
    stamp.day = std::chrono::sys_days{day};
    stamp.time_of_day = std::chrono::seconds{(hours * 60 + minutes) * 60 + seconds} +
                        std::chrono::milliseconds{number_at(text, 20, 3)};
    stamp.text = text.substr(0, shape.size());
    return stamp;
}

}  // namespace

std::optional<HostLogLine> read_host_log_line(std::string_view text) {
    constexpr std::string_view gap = " - ";
    HostLogLine out;
    out.stamp = read_stamp(text);
    if (out.stamp) {
        text.remove_prefix(out.stamp->text.size());
        if (!text.starts_with(gap)) {
            return std::nullopt;
        }
        text.remove_prefix(gap.size());
    }
    for (const std::string_view level : levels) {
        if (text.starts_with(level)) {
            text.remove_prefix(level.size());
        }
    }
    out.text = text;
    for (const auto& [word, kind] : speakers) {
        // Of an empty line the blank behind the colon may have been cut off.
        if (text.starts_with(word) || text == word.substr(0, word.size() - 1)) {
            out.kind = kind;
            out.text = text.substr(std::min(word.size(), text.size()));
            return out;
        }
    }
    return out.stamp ? std::optional(out) : std::nullopt;
}

bool begins_with_time(std::string_view text) {
    constexpr std::array<std::string_view, 10> shapes{
        "9999-99-99", "9999/99/99",   "99.99.9999",   "99/99/9999",   "99:99:99",
        "9:99:99",    "aaa 99 99:99", "aaa  9 99:99", "9999999999.9", "99999.999"};
    constexpr std::size_t longest = 16;
    constexpr std::string_view brackets = "[(<";
    if (!text.empty() && brackets.find(text.front()) != std::string_view::npos) {
        text.remove_prefix(1);
    }
    const std::string shape = shape_of(text.substr(0, longest));
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](std::string_view each) { return shape.starts_with(each); });
}

}  // namespace fauxboard::record
