#include "emulator/script/placeholders.h"

#include <algorithm>

namespace fauxboard::script {
namespace {

constexpr std::size_t longest_name = 64;

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Takes a text apart: on_text(piece), on_escape() for "$${", on_name(name) with "" for what is no name.
template <class Text, class Escape, class Name>
void scan(std::string_view text, Text&& on_text, Escape&& on_escape, Name&& on_name) {
    while (!text.empty()) {
        const std::size_t at = text.find("${");
        if (at == std::string_view::npos) {
            on_text(text);
            return;
        }
        if (at != 0 && text[at - 1] == '$') {
            on_text(text.substr(0, at - 1));
            on_escape();
            text.remove_prefix(at + 2);
            continue;
        }
        on_text(text.substr(0, at));
        const std::size_t end = text.find('}', at);
        const std::string_view name =
            end == std::string_view::npos ? std::string_view{} : text.substr(at + 2, end - at - 2);
        const bool good = is_name(name);
        on_name(good ? name : std::string_view{}, text.substr(at, good ? end + 1 - at : 2));
        text.remove_prefix(good ? end + 1 : at + 2);
    }
}

Json filled_text(const std::string& text, const Lookup& lookup, Escapes escapes) {
    if (text.size() > 3 && text.starts_with("${") && text.back() == '}' &&
        is_name(std::string_view(text).substr(2, text.size() - 3))) {
        return lookup(std::string_view(text).substr(2, text.size() - 3)).value_or(Json(text));
    }
    std::string out;
    scan(
        text, [&](std::string_view piece) { out += piece; },
        [&] { out += escapes == Escapes::keep ? "$${" : "${"; },
        [&](std::string_view name, std::string_view written) {
            const auto value = name.empty() ? std::nullopt : lookup(name);
            out += !value               ? std::string(written)
                   : value->is_string() ? value->get<std::string>()
                                        : value->dump();
        });
    return out;
}

}  // namespace

std::string below(const std::string& pointer, std::string_view key) {
    std::string out = pointer + "/";
    for (const char c : key) {
        out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return out;
}

bool is_name(std::string_view text) {
    return !text.empty() && text.size() <= longest_name && is_letter(text.front()) &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

Json filled(const Json& value, const Lookup& lookup, Escapes escapes, bool steps) {
    if (value.is_string()) {
        return filled_text(value.get_ref<const std::string&>(), lookup, escapes);
    }
    if (!value.is_structured()) {
        return value;
    }
    Json out = value;
    for (auto it = out.begin(); it != out.end(); ++it) {
        if (steps || !value.is_object() || it.key() != "steps") {
            *it = filled(*it, lookup, escapes, steps);
        }
    }
    return out;
}

std::vector<Mention> mentions(const Json& value, const std::string& pointer, bool steps) {
    std::vector<Mention> out;
    if (value.is_string()) {
        scan(
            value.get_ref<const std::string&>(), [](std::string_view) {}, [] {},
            [&](std::string_view name, std::string_view) {
                out.push_back({std::string(name), pointer});
            });
        return out;
    }
    if (!value.is_structured()) {
        return out;
    }
    std::size_t index = 0;
    for (auto it = value.begin(); it != value.end(); ++it, ++index) {
        const std::string key = value.is_object() ? it.key() : std::to_string(index);
        if (steps || !value.is_object() || key != "steps") {
            const std::vector<Mention> more = mentions(*it, below(pointer, key), steps);
            out.insert(out.end(), more.begin(), more.end());
        }
    }
    return out;
}

}  // namespace fauxboard::script
