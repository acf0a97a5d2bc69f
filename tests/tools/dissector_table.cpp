#include "tests/tools/dissector_table.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "protocol/catalogue.h"

namespace fauxboard::test {
namespace {

using protocol::CodeInfo;
using protocol::Direction;
using protocol::FieldForm;
using protocol::FieldInfo;
using protocol::FieldKind;

std::string lua_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out + '"';
}

std::string_view kind_name(FieldKind kind) {
    switch (kind) {
        case FieldKind::integer:
            return "integer";
        case FieldKind::number:
            return "number";
        case FieldKind::text:
            return "text";
        case FieldKind::flag:
            return "flag";
        case FieldKind::word:
            break;
    }
    return "word";
}

void add_field(std::string& out, const FieldInfo& field) {
    const auto to = std::back_inserter(out);
    fmt::format_to(to, "            {{ key = {}, name = {}, kind = \"{}\"", lua_text(field.key),
                   lua_text(field.name), kind_name(field.kind));
    if (!field.unit.empty()) {
        fmt::format_to(to, ", unit = {}", lua_text(field.unit));
    }
    if (field.when != protocol::always) {
        fmt::format_to(to, ", when = {}", field.when);
    }
    if (field.closing != '\0') {
        fmt::format_to(to, ", closing = {}", lua_text(std::string_view(&field.closing, 1)));
    }
    if (field.form == FieldForm::mixing) {
        out += ", form = \"mixing\"";
    }
    if (!field.values.empty()) {
        out += ", values = {";
        std::string_view comma = " ";
        for (const protocol::ValueName& value : field.values) {
            fmt::format_to(to, "{}[{}] = {}", comma, value.value, lua_text(value.words));
            comma = ", ";
        }
        out += " }";
    }
    if (!field.meaning.empty()) {
        fmt::format_to(to, ", meaning = {}", lua_text(field.meaning));
    }
    out += " },\n";
}

void add_code(std::string& out, const CodeInfo& code) {
    const auto to = std::back_inserter(out);
    fmt::format_to(to, "        {{ code = {}{}, title = {}, meaning = {}",
                   lua_text(protocol::code_text(code)), code.letter == 0 ? ", words = true" : "",
                   lua_text(code.title), lua_text(code.meaning));
    if (!code.answer.empty()) {
        fmt::format_to(to, ", answer = {}", lua_text(code.answer));
    }
    if (code.fields.empty()) {
        out += ", fields = {} },\n";
        return;
    }
    out += ", fields = {\n";
    for (const FieldInfo& field : code.fields) {
        add_field(out, field);
    }
    out += "        } },\n";
}

}  // namespace

std::string dissector_table() {
    std::string out = "local codes = {\n";
    for (const Direction direction : {Direction::to_screen, Direction::to_board}) {
        out += direction == Direction::to_screen ? "    board = {\n" : "    screen = {\n";
        for (const CodeInfo& code : protocol::catalogue()) {
            if (code.direction == direction) {
                add_code(out, code);
            }
        }
        out += "    },\n";
    }
    return out + "}\n";
}

}  // namespace fauxboard::test
