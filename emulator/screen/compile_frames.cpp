// The values a screen knows, and how its frames are read into them.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Json;
using behaviour::ObjectReader;

namespace {

constexpr int max_read_depth = 8;
constexpr std::array<std::string_view, 3> kind_names{"number", "text", "list"};
constexpr std::array<std::string_view, 4> source_names{"own", "line_bytes", "longest_word", "page"};
constexpr std::array<std::string_view, 10> as_names{
    "u8", "u16", "i32", "real", "text", "mark", "list_start", "list_entry", "list_end", "list_append"};
constexpr std::array<std::string_view, 2> bounds_names{"kept", "read"};
constexpr std::array<std::string_view, 2> from_names{"last", "start"};
constexpr std::array<std::string_view, 4> bad_names{"drop_rest", "crash", "zero", "cut"};

template <class Enum>
void pick(ObjectReader& reader, std::string_view key, std::span<const std::string_view> names, Enum& out) {
    auto index = static_cast<std::size_t>(out);
    reader.choice(key, names, index);
    out = static_cast<Enum>(index);
}

bool value_name(std::string_view name) {
    return !name.empty() && name.size() <= 60 && name.front() >= 'a' && name.front() <= 'z' &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
           });
}

}  // namespace

void Compiler::value_names(ObjectReader& reader, ValueInfo& info) {
    const Json* names = reader.get("names");
    if (names == nullptr) {
        return;
    }
    ObjectReader words(*names, reader.pointer("names"), findings);
    if (!names->is_object()) {
        return;
    }
    for (const auto& [key, word] : names->items()) {
        std::int64_t number = 0;
        const auto read = std::from_chars(key.data(), key.data() + key.size(), number);
        if (read.ec != std::errc{} || read.ptr != key.data() + key.size() || !word.is_string()) {
            findings.add(words.pointer(key), "expected a whole number as key and its word as value");
        } else {
            info.names[number] = word.get<std::string>();
        }
    }
}

ValueInfo Compiler::value_info(const std::string& name, const Json& node, const std::string& pointer) {
    ValueInfo info;
    info.name = name;
    ObjectReader reader(node, pointer, findings);
    pick(reader, "kind", kind_names, info.kind);
    std::string field;
    if (reader.text("field", field); reader.has("field")) {
        info.field = behaviour::find_field(field);
        if (info.field == nullptr) {
            findings.add(reader.pointer("field"), fmt::format("there is no field \"{}\"", field),
                         std::string(behaviour::nearest_field(field)));
        } else if (!profile.display) {
            findings.add(reader.pointer("field"),
                         "a screen that hangs on a line sees no field of the machine");
        } else if (info.field->type == behaviour::FieldType::text) {
            info.kind = ValueKind::text;
        }
    }
    pick(reader, "is", source_names, info.is);
    if (const bool text = info.kind == ValueKind::text;
        info.is != ValueSource::own &&
        (info.kind == ValueKind::list || text != (info.is == ValueSource::page))) {
        findings.add(reader.pointer("is"), "a page is a text, a size of the line a number");
    }
    reader.text("unit", info.unit);
    reader.text("help", info.help);
    if (info.kind == ValueKind::number) {
        reader.number("start", info.start, -1e9, 1e9);
        value_names(reader, info);
    } else if (info.kind == ValueKind::text) {
        reader.wire_text("start", info.start_text);
    } else {
        unsigned most = 64;
        reader.unsigned_integer("most", most, 1, 1024);
        info.most = most;
        unsigned shows = most;
        reader.unsigned_integer("shows_most", shows, 1, most);
        info.shows_most = shows;
        reader.boolean("at_end", info.at_end);
    }
    reader.finish();
    return info;
}

void Compiler::values(const Json& node) {
    ObjectReader reader(node, "/values", findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, info] : node.items()) {
        if (!value_name(name) || name == "row" || name == "row.text" || name == "input") {
            findings.add(
                reader.pointer(name),
                fmt::format("\"{}\" is no name for a value; expected small letters, digits, _ and dots, and "
                            "none of row, row.text, input",
                            name));
            continue;
        }
        profile.values.add(value_info(name, info, reader.pointer(name)));
    }
}

void Compiler::read_bounds(ObjectReader& reader, Read& out) {
    for (auto* bound : {&out.min, &out.max}) {
        const std::string_view key = bound == &out.min ? "min" : "max";
        if (reader.has(key)) {
            double number = 0;
            reader.number(key, number, -1e9, 1e9);
            *bound = number;
        }
    }
    if (out.min && out.max && *out.min > *out.max) {
        findings.add(reader.pointer("min"),
                     fmt::format("min {} is above max {}: nothing is within", *out.min, *out.max));
    }
    pick(reader, "bounds_of", bounds_names, out.bounds_first);
    pick(reader, "outside", bad_names, out.outside);
    reader.wire_text("until", out.until, 32);
    unsigned number = 0;
    reader.unsigned_integer("less", number, 0, 8);
    out.less = number;
    number = 0;
    reader.unsigned_integer("min_bytes", number, 1, 1024);
    out.min_bytes = number;
    number = 0;
    reader.unsigned_integer("max_bytes", number, 1, 1024);
    out.max_bytes = number;
    pick(reader, "too_long", bad_names, out.too_long);
    pick(reader, "no_end", bad_names, out.no_end);
}

void Compiler::check_read(const Read& out, const std::string& pointer, bool& wants_into) {
    const ValueKind wanted = out.as == Read::As::text         ? ValueKind::text
                             : out.as >= Read::As::list_start ? ValueKind::list
                                                              : ValueKind::number;
    wants_into = wanted == ValueKind::list;
    if (out.into && profile.values.at(*out.into).kind != wanted) {
        findings.add(pointer + "/into",
                     fmt::format("\"{}\" is a {}; expected a {}", profile.values.at(*out.into).name,
                                 kind_names[static_cast<std::size_t>(profile.values.at(*out.into).kind)],
                                 kind_names[static_cast<std::size_t>(wanted)]));
        // The reader would write past what the value holds.
        wants_into = true;
    }
}

Read Compiler::read(const Json& node, const std::string& pointer, int depth) {
    Read out;
    ObjectReader reader(node, pointer, findings);
    reader.wire_text("key", out.key, 32);
    pick(reader, "from", from_names, out.from);
    if (reader.has("column")) {
        unsigned column = 0;
        reader.unsigned_integer("column", column, 0, 200);
        out.column = column;
        out.from = Read::From::column;
    }
    pick(reader, "as", as_names, out.as);
    std::string into;
    reader.text("into", into);
    if (!into.empty()) {
        out.into = value(into, reader.pointer("into"));
    }
    read_bounds(reader, out);
    reader.text("why", out.why);
    reader.text("bug", out.bug);
    out.then = reads(reader, "then", depth + 1);
    reader.finish();
    bool wants_into = false;
    check_read(out, pointer, wants_into);
    if (wants_into && !out.into) {
        findings.add(pointer, "a list entry must say \"into\" which list it goes");
    }
    return out;
}

std::vector<Read> Compiler::reads(ObjectReader& reader, std::string_view key, int depth) {
    std::vector<Read> out;
    const Json* node = reader.get(key);
    if (node == nullptr) {
        return out;
    }
    if (!node->is_array() || depth > max_read_depth) {
        findings.add(reader.pointer(key), node->is_array()
                                              ? "nested deeper than 8"
                                              : behaviour::found(*node) + "; expected an array of keys");
        return out;
    }
    for_each_item(*node, reader.pointer(key), [&](const Json& item, const std::string& pointer) {
        out.push_back(read(item, pointer, depth));
    });
    return out;
}

/// "verdict": a word of verdict_words(), and "why".
void Compiler::case_verdict(ObjectReader& reader, FrameCase& out) {
    std::vector<std::string_view> words;
    for (std::size_t i = 0; i < verdict_count; ++i) {
        words.push_back(verdict_words(static_cast<Verdict>(i)));
    }
    pick(reader, "verdict", words, out.verdict);
    reader.text("why", out.why);
    if ((out.verdict == Verdict::ok) != out.why.empty()) {
        findings.add(reader.pointer("why"), "a verdict and why it is so stand together");
    }
}

FrameCase Compiler::frame_case(ObjectReader& reader) {
    FrameCase out;
    out.has = texts(reader, "has");
    out.lacks = texts(reader, "lacks");
    out.when = conditions(reader, "when", {});
    reader.text("ignored", out.ignored);
    case_verdict(reader, out);
    out.read = reads(reader, "read", 0);
    out.assume = assigns(reader, "assume", {});
    reader.boolean("acknowledges", out.acknowledges);
    out.answers = texts(reader, "answers");
    reader.boolean("forgets", out.forgets);
    out.opens = targets(reader, "opens", {});
    out.answer = sends(reader, "answer", {});
    reader.boolean("restarts", out.restarts);
    return out;
}

FrameRule Compiler::frame(const std::string& name, const Json& node, const std::string& pointer) {
    FrameRule rule;
    rule.name = name;
    ObjectReader reader(node, pointer, findings);
    reader.text("title", rule.title);
    reader.boolean("anywhere", rule.anywhere);
    reader.boolean("goes_on", rule.goes_on);
    if (const Json* cases = reader.get("cases")) {
        for_each_item(*cases, reader.pointer("cases"), [&](const Json& item, const std::string& where) {
            ObjectReader one(item, where, findings);
            rule.cases.push_back(frame_case(one));
            one.finish();
        });
        if (reader.has("read")) {
            findings.add(pointer, "expected either \"cases\" or \"read\"");
        }
    } else {
        rule.cases.push_back(frame_case(reader));
    }
    reader.finish();
    return rule;
}

void Compiler::frames(const Json& node) {
    ObjectReader reader(node, "/frames", findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, rule] : node.items()) {
        if (name.empty()) {
            findings.add(reader.pointer(name), "expected a code such as L3, or the words a line starts with");
            continue;
        }
        unsigned code = 0;
        const char* end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + 1, end, code);
        if (name[0] == 'L' && read.ec == std::errc{} && read.ptr == end) {
            if (code > 255) {
                findings.add(reader.pointer(name), fmt::format("found L{}; expected L0 to L255", code));
            }
            profile.codes[code & 0xFFU] = frame(name, rule, reader.pointer(name));
        } else {
            profile.words.push_back(
                frame(behaviour::to_wire(name).value_or(name), rule, reader.pointer(name)));
        }
    }
}

}  // namespace fauxboard::screen
