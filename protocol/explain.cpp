#include <cmath>

#include "protocol/annotate.h"
#include "protocol/decode.h"
#include "protocol/scan.h"

namespace fauxboard::protocol {

namespace {

void add_byte(std::string& out, char byte) {
    static constexpr std::string_view digits = "0123456789abcdef";
    if (byte >= ' ' && byte <= '~') {
        out += byte;
        return;
    }
    const auto value = static_cast<unsigned char>(byte);
    out += "\\x";
    out += digits[value / 16];
    out += digits[value % 16];
}

std::string printable(std::string_view bytes) {
    std::string out;
    for (const char byte : bytes) {
        add_byte(out, byte);
    }
    return out;
}

/// "E0 40 % E1 60 %"; nothing when the parts do not add up to 100, and so the number is no packed ratio.
std::string mixing_words(double number) {
    if (number < 0 || number > 0xFFFFFF) return {};
    const auto packed = static_cast<unsigned>(number);
    std::string words;
    unsigned sum = 0;
    for (unsigned extruder = 0; extruder < 3; ++extruder) {
        const unsigned percent = (packed >> (8 * extruder)) & 0xFF;
        sum += percent;
        if (percent == 0) continue;
        if (!words.empty()) words += ' ';
        words += 'E' + std::to_string(extruder) + ' ' + std::to_string(percent) + " %";
    }
    return sum == 100 ? words : std::string{};
}

std::string with_unit(std::string value, const FieldInfo& info) {
    if (!info.unit.empty()) {
        value += ' ';
        value += info.unit;
    }
    return value;
}

/// `alone`: the field is all the code has, and so the title says what it is.
std::string text_words(const FieldInfo& info, const std::string& text, bool alone) {
    const std::string name(info.name);
    const std::size_t start = scan::blanks_at(text, 0);
    if (alone) return '"' + printable(std::string_view(text).substr(start)) + '"';
    if (start == text.size()) return "no " + name;
    if (text.find_first_not_of('\xFF') == std::string::npos) {
        return name + " blank (" + std::to_string(text.size()) + " x 0xff)";
    }
    return name + " \"" + printable(std::string_view(text).substr(start)) + '"';
}

std::string number_words(const FieldInfo& info, const DecodedField& field) {
    const std::string name(info.name);
    if (!field.number) return field.text.empty() ? name : name + " \"" + printable(field.text) + '"';
    const double number = *field.number;
    if (number == std::floor(number)) {
        if (const auto words = words_of(info, static_cast<std::int64_t>(number)); !words.empty()) {
            // A bare "on" needs its subject, but in a bracket or after the field that selects it.
            const bool subject =
                (words == "on" || words == "off") && info.form == FieldForm::plain && info.when == always;
            return (subject ? name + ' ' : std::string{}) + std::string(words);
        }
    }
    if (info.form == FieldForm::mixing) {
        if (const std::string words = mixing_words(number); !words.empty()) return name + ' ' + words;
    }
    return with_unit((name.empty() ? name : name + ' ') + field.text, info);
}

std::string field_words(const DecodedField& field, bool alone) {
    if (field.info == nullptr) return "unknown \"" + printable(field.key + field.text) + '"';
    const FieldInfo& info = *field.info;
    if (info.kind == FieldKind::text) return text_words(info, field.text, alone);
    if (info.kind == FieldKind::word) return std::string(info.name);
    return number_words(info, field);
}

std::string all_fields(const DecodedLine& line) {
    std::string words;
    bool bracket = false;
    for (const DecodedField& field : line.fields) {
        const bool inner = field.info != nullptr && field.info->form == FieldForm::bracketed;
        if (bracket && !inner) words += ')';
        if (inner && !bracket) {
            words += " (";
        } else if (!words.empty()) {
            words += ", ";
        }
        bracket = inner;
        words += field_words(field, line.code->fields.size() == 1 && field.key.empty());
    }
    return bracket ? words + ')' : words;
}

std::string frame_notes(const DecodedLine& line) {
    std::string notes;
    if (line.prefixes.size() > 1) notes += " [" + std::to_string(line.prefixes.size()) + " prefixes]";
    if (line.style == FrameStyle::star_only) notes += " [star without checksum]";
    if (line.style == FrameStyle::unfinished) notes += " [prefix without checksum]";
    if (!line.checksum_ok()) {
        notes += " [checksum " + std::to_string(line.checksum_given) + " is wrong, " +
                 std::to_string(line.checksum_expected) + " is right]";
    }
    return notes;
}

}  // namespace

std::string explain(const DecodedLine& line) {
    if (line.code == nullptr) {
        const std::string body = printable(encode_body(line));
        return (body.empty() ? "empty" : "unknown \"" + body + '"') + frame_notes(line);
    }
    const std::string fields = all_fields(line);
    std::string words(line.code->title);
    if (!fields.empty()) words += ": " + fields;
    return words + frame_notes(line);
}

}  // namespace fauxboard::protocol
