#pragma once

// Private to this folder: the parts of the catalogue and the short forms its rows are written in.

#include <span>

#include "protocol/catalogue.h"

namespace fauxboard::protocol::tables {

std::span<const CodeInfo> status_replies();    // L1..L9
std::span<const CodeInfo> special_replies();   // L10..L24
std::span<const CodeInfo> bare_replies();      // the lines the board sends without L
std::span<const CodeInfo> machine_requests();  // G codes, T codes, the usual M codes
std::span<const CodeInfo> job_requests();      // card, print job, settings; common M codes
std::span<const CodeInfo> chitu_requests();    // of resin boards
std::span<const CodeInfo> chitu_replies();
std::span<const CodeInfo> marlin_requests();  // of boards that speak as hosts do
std::span<const CodeInfo> marlin_replies();
std::span<const CodeInfo> smartto_requests();  // M2011..M2140, the screen's L codes, its words

using Values = std::span<const ValueName>;

constexpr FieldInfo number(std::string_view key, std::string_view name, std::string_view unit = {},
                           std::int8_t decimals = -1, std::string_view meaning = {}) {
    return {key, name, FieldKind::number, unit, meaning, {}, decimals, always, '\0', FieldForm::plain};
}
constexpr FieldInfo integer(std::string_view key, std::string_view name, std::string_view unit = {},
                            std::string_view meaning = {}) {
    return {key, name, FieldKind::integer, unit, meaning, {}, 0, always, '\0', FieldForm::plain};
}
constexpr FieldInfo choice(std::string_view key, std::string_view name, Values values,
                           std::string_view meaning = {}) {
    return {key, name, FieldKind::integer, {}, meaning, values, 0, always, '\0', FieldForm::plain};
}
constexpr FieldInfo flag(std::string_view key, std::string_view name, Values values) {
    return {key, name, FieldKind::flag, {}, {}, values, 0, always, '\0', FieldForm::plain};
}
constexpr FieldInfo text(std::string_view key, std::string_view name, std::string_view meaning = {},
                         char closing = '\0') {
    return {key, name, FieldKind::text, {}, meaning, {}, -1, always, closing, FieldForm::plain};
}
constexpr FieldInfo word(std::string_view key, std::string_view name) {
    return {key, name, FieldKind::word, {}, {}, {}, -1, always, '\0', FieldForm::plain};
}
constexpr FieldInfo mixing(std::string_view key, std::string_view name) {
    return {key,
            name,
            FieldKind::integer,
            {},
            "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2",
            {},
            0,
            always,
            '\0',
            FieldForm::mixing};
}
constexpr FieldInfo bracketed(FieldInfo field) {
    field.form = FieldForm::bracketed;
    return field;
}
/// The field is valid only when the code's first field is `selector`.
constexpr FieldInfo when(std::int32_t selector, FieldInfo field) {
    field.when = selector;
    return field;
}

constexpr CodeInfo reply(std::uint16_t number, std::string_view title, std::string_view meaning,
                         std::span<const FieldInfo> fields, std::string_view answer = {}) {
    return {'L', number, {}, Direction::to_screen, title, meaning, fields, answer};
}
constexpr CodeInfo request(char letter, std::uint16_t number, std::string_view title,
                           std::string_view meaning, std::span<const FieldInfo> fields,
                           std::string_view answer = {}) {
    return {letter, number, {}, Direction::to_board, title, meaning, fields, answer};
}

inline constexpr ValueName off_on[] = {{0, "off"}, {1, "on"}};
inline constexpr ValueName z_steps[] = {{0, "10 mm"}, {1, "1 mm"}, {2, "0.1 mm"}, {3, "0.05 mm"}};

}  // namespace fauxboard::protocol::tables
