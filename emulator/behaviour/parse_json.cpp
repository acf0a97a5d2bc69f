#include "emulator/behaviour/parse_json.h"

namespace fauxboard::behaviour {
namespace {

/// Counts brackets outside of texts: right up to the first byte that is no JSON, and the parser stops there.
bool too_deep(std::string_view text) {
    std::size_t levels = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_text) {
            i += c == '\\' ? 1 : 0;
            in_text = c != '"';
        } else if (c == '"') {
            in_text = true;
        } else if ((c == '[' || c == '{') && ++levels > most_levels) {
            return true;
        } else if ((c == ']' || c == '}') && levels-- == 0) {
            return false;
        }
    }
    return false;
}

}  // namespace

Json parse_json(std::string_view text) {
    return too_deep(text) ? Json(Json::value_t::discarded) : Json::parse(text, nullptr, false);
}

}  // namespace fauxboard::behaviour
