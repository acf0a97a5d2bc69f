#include "emulator/filament/slicer_comments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/filament/gcode_line.h"

namespace fauxboard::filament {
namespace {

constexpr double most_layers = 1e6;
constexpr double most_seconds = 1e9;
constexpr double most_layer_mm = 100;

bool digit(char c) {
    return c >= '0' && c <= '9';
}

void skip_blanks(std::string_view& text) {
    const std::size_t at = text.find_first_not_of(" \t");
    text.remove_prefix(std::min(at, text.size()));
}

/// The whole number at the start of what is left; nothing when there is none, or a senseless one.
std::optional<int> whole(std::string_view text) {
    skip_blanks(text);
    const bool sign = text.starts_with('-');
    if (text.size() < (sign ? 2U : 1U) || !digit(text[sign ? 1 : 0])) {
        return std::nullopt;
    }
    const double number = take_decimal(text);
    return std::abs(number) > most_layers ? std::nullopt : std::optional(static_cast<int>(number));
}

/// "1d 2h 3m 4s", any of them.
std::optional<double> clock_time(std::string_view text) {
    double seconds = 0;
    bool any = false;
    while (true) {
        skip_blanks(text);
        if (text.empty() || !digit(text[0])) {
            break;
        }
        const double number = take_decimal(text);
        const char unit = text.empty() ? '\0' : text[0];
        const double factor = unit == 'd'   ? 86400
                              : unit == 'h' ? 3600
                              : unit == 'm' ? 60
                              : unit == 's' ? 1
                                            : 0;
        if (factor == 0) {
            return std::nullopt;
        }
        seconds += number * factor;
        any = true;
        text.remove_prefix(1);
    }
    return any && seconds <= most_seconds ? std::optional(seconds) : std::nullopt;
}

struct Word {
    std::string_view start;
    void (*read)(std::string_view rest, SlicerNote& note);
};

void zero_based_layer(std::string_view rest, SlicerNote& note) {
    if (const auto number = whole(rest)) {
        note.layer = *number + 1;
    }
}
void one_based_layer(std::string_view rest, SlicerNote& note) {
    note.layer = whole(rest);
}
void count(std::string_view rest, SlicerNote& note) {
    const auto number = whole(rest);
    note.layers = number && *number > 0 ? number : std::nullopt;
}
/// "1/2": the layer, and how many there are.
void layer_of_layers(std::string_view rest, SlicerNote& note) {
    one_based_layer(rest, note);
    const std::size_t slash = rest.find('/');
    if (slash != std::string_view::npos) {
        count(rest.substr(slash + 1), note);
    }
}
void time_in_seconds(std::string_view rest, SlicerNote& note) {
    skip_blanks(rest);
    if (!rest.empty() && digit(rest[0])) {
        const double seconds = take_decimal(rest);
        note.seconds = seconds <= most_seconds ? std::optional(seconds) : std::nullopt;
    }
}
void layer_height(std::string_view rest, SlicerNote& note) {
    skip_blanks(rest);
    if (!rest.empty() && digit(rest[0])) {
        const double mm = take_decimal(rest);
        note.layer_mm = mm > 0 && mm <= most_layer_mm ? std::optional(mm) : std::nullopt;
    }
}
void time_in_words(std::string_view rest, SlicerNote& note) {
    note.seconds = clock_time(rest);
}
/// "model printing time: 14m 30s; total estimated time: 20m 54s": the second is what it takes.
void model_and_total_time(std::string_view rest, SlicerNote& note) {
    constexpr std::string_view total = "total estimated time:";
    const std::size_t at = rest.find(total);
    note.seconds = clock_time(at == std::string_view::npos ? rest : rest.substr(at + total.size()));
}

constexpr std::array words{
    Word{"LAYER:", zero_based_layer},
    Word{"LAYER_COUNT:", count},
    Word{"TIME:", time_in_seconds},
    Word{"LAYER_CHANGE", [](std::string_view, SlicerNote& note) { note.next_layer = true; }},
    Word{"BEFORE_LAYER_CHANGE", [](std::string_view, SlicerNote& note) { note.before_layer = true; }},
    Word{"BEGIN_LAYER_OBJECT", [](std::string_view, SlicerNote& note) { note.next_layer = true; }},
    Word{"CHANGE_LAYER", [](std::string_view, SlicerNote& note) { note.next_layer = true; }},
    Word{"layer num/total_layer_count:", layer_of_layers},
    Word{"Layer height:", layer_height},
    Word{"layer ", one_based_layer},
    Word{"total layers count =", count},
    Word{"total layer number:", count},
    Word{"estimated printing time (normal mode) =", time_in_words},
    Word{"model printing time:", model_and_total_time},
};

}  // namespace

SlicerNote read_slicer_comment(std::string_view comment) {
    SlicerNote note;
    skip_blanks(comment);
    // Nearly every comment ends here: its first letter is none of theirs.
    if (comment.empty() || std::string_view("LTBCltem").find(comment[0]) == std::string_view::npos) {
        return note;
    }
    for (const Word& word : words) {
        if (comment.starts_with(word.start)) {
            word.read(comment.substr(word.start.size()), note);
            break;
        }
    }
    return note;
}

bool SlicerNotes::take(std::string_view comment) {
    const SlicerNote note = read_slicer_comment(comment);
    if (note.layers) {
        layers_ = *note.layers;
    }
    if (note.seconds) {
        seconds_ = *note.seconds;
    }
    if (note.layer_mm && layer_mm_ == 0) {
        layer_mm_ = *note.layer_mm;
    }
    const int before = layer_;
    if (note.layer) {
        numbered_ = true;
        layer_ = std::max(*note.layer, 0);
    } else if (!numbered_) {
        // PrusaSlicer says LAYER_CHANGE and then, if its user's G-code does, BEFORE_LAYER_CHANGE; its
        // ancestors only the latter.
        const bool first = note.next_layer || (note.before_layer && !just_changed_);
        layer_ += first && layer_ < most_layers ? 1 : 0;
        just_changed_ = note.next_layer || (just_changed_ && !note.before_layer);
    }
    return layer_ != before;
}

void SlicerNotes::take_tail(std::string_view tail) {
    int highest = 0;
    while (!tail.empty()) {
        const std::size_t end = std::min(tail.find('\n'), tail.size());
        const std::string_view line = tail.substr(0, end);
        tail.remove_prefix(std::min(end + 1, tail.size()));
        const std::size_t start = line.find(';');
        if (start == std::string_view::npos) {
            continue;
        }
        const SlicerNote note = read_slicer_comment(line.substr(start + 1));
        highest = std::max(highest, note.layer.value_or(0));
        layers_ = note.layers.value_or(layers_);
        seconds_ = note.seconds.value_or(seconds_);
    }
    if (layers_ == 0) {
        layers_ = highest;
    }
}

}  // namespace fauxboard::filament
