#include "emulator/behaviour/frame_template.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>

#include "emulator/behaviour/number_text.h"
#include "protocol/framing.h"

namespace fauxboard::behaviour {
namespace {

/// See put_literal(): literals are copied by so many bytes, of which those that belong to it count.
constexpr std::size_t copied_at_once = 16;

/// Copies a text, making control characters visible instead of active.
Written copy_text(std::string_view text, std::span<char> out, bool lower, bool upper) {
    Written written{std::min(text.size(), out.size()), 0};
    for (std::size_t i = 0; i < written.size; ++i) {
        char c = text[i];
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t') {
            c = '?';
        } else if (lower && c >= 'A' && c <= 'Z') {
            c = static_cast<char>(c - 'A' + 'a');
        } else if (upper && c >= 'a' && c <= 'z') {
            c = static_cast<char>(c - 'a' + 'A');
        }
        out[i] = c;
        written.sum ^= static_cast<unsigned char>(c);
    }
    return written;
}

/// Without its decimals, as a cast to int does it; -0.5 becomes 0, not -0. Bounds as write_fixed() has them.
double cut_off(double value) {
    return static_cast<double>(static_cast<long long>(std::clamp(value, -1e15, 1e15)));
}

/// ".49s" is 49, as printf has it: of a text so many bytes at most.
std::optional<std::size_t> text_limit(std::string_view format) {
    constexpr std::size_t most = 512;
    if (format.size() < 3 || format.front() != '.' || format.back() != 's') {
        return std::nullopt;
    }
    std::size_t limit = 0;
    for (const char c : format.substr(1, format.size() - 2)) {
        if (c < '0' || c > '9' || limit > most) {
            return std::nullopt;
        }
        limit = limit * 10 + static_cast<std::size_t>(c - '0');
    }
    return limit <= most ? std::optional(limit) : std::nullopt;
}

/// Eight digits, in capitals.
std::string hex_text(double value) {
    std::array<char, 16> text;
    std::snprintf(text.data(), text.size(), "%08X",
                  static_cast<unsigned>(std::clamp(value, 0.0, 4294967295.0)));
    return text.data();
}

/// Seconds as "1d 2h 3m 4s", leading units of zero left out.
std::string time_text(double seconds) {
    const auto whole = static_cast<long long>(std::clamp(seconds, 0.0, 1e12));
    std::string out;
    for (const auto& [unit, size, turn] :
         {std::tuple{"d", 86400LL, 1'000'000'000LL}, std::tuple{"h", 3600LL, 24LL},
          std::tuple{"m", 60LL, 60LL}, std::tuple{"s", 1LL, 60LL}}) {
        const long long count = whole / size % turn;
        if (count != 0 || !out.empty() || size == 1) {
            out += (out.empty() ? "" : " ") + std::to_string(count) + unit;
        }
    }
    return out;
}

bool needs_format(const Operand& operand) {
    return operand.kind == Operand::Kind::variable || operand.kind == Operand::Kind::parameter ||
           (operand.kind == Operand::Kind::field && operand.field->type == FieldType::number);
}

}  // namespace

FrameTemplate::FrameTemplate(std::string_view source, const Names& names) {
    std::size_t at = 0;
    while (at < source.size()) {
        const std::size_t brace = source.find_first_of("{}", at);
        add_literal(source.substr(at, brace - at));
        if (brace == std::string_view::npos) {
            break;
        }
        if (brace + 1 < source.size() && source[brace + 1] == source[brace]) {
            add_literal(source.substr(brace, 1));
            at = brace + 2;
            continue;
        }
        const std::size_t close = source.find('}', brace);
        if (source[brace] == '}' || close == std::string_view::npos) {
            throw ExpressionError("a brace without its partner in \"" + std::string(source) +
                                      "\"; write {{ or }} for a brace itself",
                                  {});
        }
        add_value(source.substr(brace + 1, close - brace - 1), names);
        at = close + 1;
    }
    literals_.append(copied_at_once, ' ');
}

void FrameTemplate::add_literal(std::string_view text) {
    if (text.empty()) {
        return;
    }
    // A NUL ends no line, and boards do send them.
    const bool control = std::any_of(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\0'; });
    if (control) {
        throw ExpressionError("a control character in a frame; line ends are added by the framing", {});
    }
    if (!parts_.empty() && parts_.back().style == Style::literal) {
        parts_.back().size += text.size();
    } else {
        Part part;
        part.from = literals_.size();
        part.size = text.size();
        parts_.push_back(std::move(part));
    }
    parts_.back().sum ^= protocol::xor_checksum(text);
    literals_ += text;
}

void FrameTemplate::add_value(std::string_view inside, const Names& names) {
    Part part;
    std::string_view reference = inside;
    std::string_view format;
    const std::size_t colon = inside.rfind(':');
    if (colon != std::string_view::npos && colon + 1 != inside.size()) {
        reference = inside.substr(0, colon);
        format = inside.substr(colon + 1);
    }
    part.operand = parse_reference(reference, names);
    const bool signed_one = format.starts_with('+');
    format.remove_prefix(signed_one ? 1 : 0);
    if (const auto most = text_limit(format); most && !signed_one) {
        part.style = Style::text;
        part.most = *most;
    } else if (format.size() == 3 && format[0] == '.' && format[2] == 'f' && format[1] >= '0' &&
               format[1] <= '6') {
        part.style = signed_one ? Style::signed_fixed : Style::fixed;
        part.decimals = format[1] - '0';
    } else if (format == "x" || format == "time") {
        part.style = format == "x" ? Style::hex : Style::time;
    } else if (format == "d") {
        part.style = Style::whole;
    } else if (format == "s" || format == "lower" || format == "upper") {
        part.style = format == "s" ? Style::text : format == "lower" ? Style::lower : Style::upper;
    } else if (format.empty()) {
        if (needs_format(part.operand)) {
            throw ExpressionError("{" + std::string(inside) + "} is a number and needs a format, such as {" +
                                      std::string(inside) + ":.2f}",
                                  {});
        }
        part.style = part.operand.is_text() ? Style::text : Style::whole;
    } else {
        throw ExpressionError("unknown format \"" + std::string(format) + "\" in {" + std::string(inside) +
                                  "}; expected .0f to .6f (+ before it for a sign), d, x, time, s, .1s to "
                                  ".512s, lower or upper",
                              {});
    }
    const bool text_style =
        part.style == Style::text || part.style == Style::lower || part.style == Style::upper;
    if (text_style != part.operand.is_text()) {
        throw ExpressionError("{" + std::string(inside) + "} is " + (text_style ? "a number" : "a text") +
                                  " and cannot be written with the format \"" + std::string(format) + "\"",
                              {});
    }
    parts_.push_back(std::move(part));
}

Written FrameTemplate::render(const Scope& scope, std::span<char> out, bool& cut) const {
    Written line;
    for (const Part& part : parts_) {
        const std::span<char> room = out.subspan(line.size);
        if (part.style == Style::literal) {
            line += put_literal(part, room, cut);
            continue;
        }
        const Value value = part.operand.evaluate(scope);
        if (value.none()) {
            continue;
        }
        if (value.is_text()) {
            const std::string_view shown = value.text.substr(0, part.most);
            const Written text =
                copy_text(shown, room, part.style == Style::lower, part.style == Style::upper);
            cut = cut || text.size < shown.size();
            line += text;
            continue;
        }
        const Written text = write_number(part, value.number, room);
        cut = cut || text.size == 0;
        line += text;
    }
    return line;
}

Written FrameTemplate::write_number(const Part& part, double value, std::span<char> room) {
    switch (part.style) {
        case Style::fixed:
            return write_fixed(room, value, part.decimals);
        case Style::whole:
            return write_fixed(room, cut_off(value), 0);
        case Style::signed_fixed: {
            const bool plus = !std::signbit(value) && !room.empty();
            if (plus) {
                room[0] = '+';
            }
            Written text = write_fixed(room.subspan(plus ? 1 : 0), value, part.decimals);
            text += plus ? Written{1, '+'} : Written{};
            return text;
        }
        default:
            break;
    }
    return copy_text(part.style == Style::hex ? hex_text(value) : time_text(value), room, false, false);
}

Written FrameTemplate::put_literal(const Part& part, std::span<char> room, bool& cut) const {
    const char* const text = literals_.data() + part.from;
    if (part.size <= copied_at_once && room.size() >= copied_at_once) {
        // Most are short, and a copy of fixed size is two instructions: literals_ is longer by as much.
        std::memcpy(room.data(), text, copied_at_once);
        return {part.size, part.sum};
    }
    if (part.size <= room.size()) {
        std::memcpy(room.data(), text, part.size);
        return {part.size, part.sum};
    }
    cut = true;
    std::memcpy(room.data(), text, room.size());
    return {room.size(), protocol::xor_checksum({text, room.size()})};
}

}  // namespace fauxboard::behaviour
