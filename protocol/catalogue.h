#pragma once

// Every code of the line and its fields, declared once: for decoding, explaining, checking and the printed
// reference.
//
// Sources of the tables (replies*.cpp, requests*.cpp): the Smartto touch-screen protocol document (Z), the
// notes on the A30T touch screen (T), a recorded line of an A30T (C), the A30 screen's own firmware (F).
// Where they differ the recording wins, then the firmware, then T over Z.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace fauxboard::protocol {

enum class Direction : std::uint8_t { to_screen, to_board };

enum class FieldKind : std::uint8_t {
    integer,
    number,  ///< with decimals
    text,    ///< up to the next key of the same code, the closing mark, or the end of the line
    flag,    ///< 0 or 1
    word     ///< the key alone says it ("M20 LCD", "G28 X"); a number behind it says nothing more
};

/// How explain() puts a field into words.
enum class FieldForm : std::uint8_t {
    plain,      ///< "feedrate 100 mm/s"
    bracketed,  ///< in brackets behind the field before it: "bed 22.0 °C (target 0.0, off)"
    mixing      ///< a packed mixing ratio, one byte of percent per extruder: "mixing ratio E0 40 % E1 60 %"
};

/// One value of an enumeration, in words that stand for themselves: {1, "motors on"}.
struct ValueName {
    std::int32_t value;
    std::string_view words;
};

/// FieldInfo::when of a field that is always valid.
inline constexpr std::int32_t always = -1;

struct FieldInfo {
    std::string_view key;                 ///< "X", "T0:", "FN:"; empty: the value stands there without a key
    std::string_view name;                ///< "extruder 0 temperature"
    FieldKind kind = FieldKind::integer;  ///< what the value is
    std::string_view unit;                ///< "mm", "°C" (UTF-8), empty without one
    std::string_view meaning;             ///< what name, unit and values do not say
    std::span<const ValueName> values{};  ///< the enumeration, empty without one
    std::int8_t decimals = -1;   ///< digits behind the point on the wire; -1 where no source fixes them
    std::int32_t when = always;  ///< valid only when the code's first field has this value
    char closing = '\0';         ///< the mark that ends the value (L9's ';'), 0: none
    FieldForm form = FieldForm::plain;
};

struct CodeInfo {
    char letter;            ///< 'G', 'M', 'T', 'L'; 0 for a line that starts with words
    std::uint16_t number;   ///< 0 for words
    std::string_view word;  ///< how the line starts where there is no code: "SD printing byte"; else empty
    Direction direction;
    std::string_view title;             ///< "temperatures"
    std::string_view meaning;           ///< one sentence
    std::span<const FieldInfo> fields;  ///< in wire order
    std::string_view answer;            ///< what the other side answers: "L2" for M105; empty: nothing
};

/// All codes, sorted by direction, letter, number and word.
std::span<const CodeInfo> catalogue();

/// The code, or nullptr. `number` of any size.
const CodeInfo* find_code(Direction direction, char letter, unsigned number);

/// The entry whose words `body` starts with (the longest, if several), or nullptr. Words that end in a letter
/// must be followed by something else: "log A30 LCD OK" is "log", "logger" is not.
const CodeInfo* find_words(Direction direction, std::string_view body);

/// "L3", "M2107", or the words of an entry without code.
std::string code_text(const CodeInfo& code);

/// The words for a value of an enumeration; empty when it has none.
std::string_view words_of(const FieldInfo& field, std::int64_t value);

/// "0 = idle, 1 = printing, ..." for the reference; empty for a field without enumeration.
std::string value_list(const FieldInfo& field);

}  // namespace fauxboard::protocol
