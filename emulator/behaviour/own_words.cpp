#include "emulator/behaviour/own_words.h"

#include <fmt/format.h>

#include "emulator/behaviour/profile.h"
#include "emulator/behaviour/wire_text.h"

namespace fauxboard::behaviour {
namespace {

/// Whether `body` begins with `key`, and a word of it ends there.
bool begins_with(std::string_view body, std::string_view key) {
    return body.starts_with(key) && (body.size() == key.size() || body[key.size()] == ' ');
}

const CodeWords* find(const Profile& profile, std::string_view body) {
    const CodeWords* longest = nullptr;
    std::size_t length = 0;
    for (const auto& [key, words] : profile.words) {
        if (key.size() >= length && begins_with(body, key)) {
            longest = &words;
            length = key.size();
        }
    }
    return longest;
}

}  // namespace

std::string own_words(const Profile& profile, const protocol::DecodedLine& line) {
    if (profile.words.empty()) {
        return {};
    }
    const CodeWords* const words = find(profile, protocol::encode_body(line));
    if (words == nullptr) {
        return {};
    }
    std::string text = words->title;
    bool first = true;
    for (const protocol::DecodedField& field : line.fields) {
        const auto name = words->fields.find(field.key);
        if (name != words->fields.end()) {
            text += fmt::format("{}{} {}", first ? ": " : ", ", name->second, as_ascii(field.text));
            first = false;
        }
    }
    return text;
}

std::string explain(const Profile& profile, const protocol::DecodedLine& line) {
    std::string own = own_words(profile, line);
    return own.empty() ? protocol::explain(line) : own;
}

}  // namespace fauxboard::behaviour
