#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::e2e {

inline std::size_t count_of(std::string_view text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

/// Why a text is no well-formed XML of elements, attributes and character references; "" when it is.
inline std::string xml_trouble(std::string_view text) {
    const auto bad_text = [](std::string_view part) {
        for (std::size_t at = part.find('&'); at != std::string_view::npos; at = part.find('&', at + 1)) {
            bool known = false;
            for (const std::string_view name : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
                known = known || part.substr(at).starts_with(name);
            if (!known) return true;
        }
        return part.find('<') != std::string_view::npos;
    };
    if (!text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n")) return "no declaration";
    text.remove_prefix(text.find('\n') + 1);
    std::vector<std::string> open;
    std::size_t roots = 0;
    while (!text.empty()) {
        const std::size_t start = text.find('<');
        if (bad_text(text.substr(0, start))) return "bad text";
        if (start == std::string_view::npos) break;
        std::size_t end = start + 1;  // of the tag: the first > outside of quotes
        for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end)
            if (text[end] == '"') quoted = !quoted;
        if (end == text.size()) return "a tag without end";
        const std::string_view tag = text.substr(start + 1, end - start - 1);
        text.remove_prefix(end + 1);
        if (bad_text(tag)) return "bad tag " + std::string(tag);
        const std::string name(tag.substr(0, tag.find(' ')));
        if (tag.starts_with('/')) {
            if (open.empty() || '/' + open.back() != name) return "unexpected " + name;
            open.pop_back();
        } else if (!tag.ends_with('/')) {
            if (open.empty()) ++roots;
            open.push_back(name);
        }
    }
    return !open.empty() ? "no end of " + open.back() : roots == 1 ? "" : "not one root";
}

}  // namespace fauxboard::e2e
