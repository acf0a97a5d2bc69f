// Which rows of the reference somebody asked for: whole parts, one field or a group, one action, code, ...

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "tools/describe_reference.h"

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const Json& row) {
    return row.begin().value().get<std::string>();
}

/// "heaters.nozzle" asks for heaters.nozzle.target as well; "L24" for every form of it.
bool asked(const Json& row, std::string_view word) {
    const std::string name = name_of(row);
    return name == word || (name.size() > word.size() && name.starts_with(word) &&
                            std::string_view(". ").find(name[word.size()]) != std::string_view::npos);
}

Json rows_of(const Json& rows, std::string_view word) {
    Json out = Json::array();
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(out),
                 [&](const Json& row) { return asked(row, word); });
    return out;
}

/// The rows of one part that the word asks for; nothing when there are none.
Json part_of(const std::string& part, const Json& rows, std::string_view word) {
    if (rows.is_array()) {
        Json found = rows_of(rows, word);
        return found.empty() ? Json() : found;
    }
    if (part != "faults") {
        return {};  // chapters that are told as a whole
    }
    Json out = rows;
    out["kinds"] = rows_of(rows["kinds"], word);
    out["printer"]["kinds"] = rows_of(rows["printer"]["kinds"], word);
    return out["kinds"].empty() && out["printer"]["kinds"].empty() ? Json() : out;
}

void add_names(const Json& rows, std::vector<std::string>& names) {
    for (const Json& row : rows) {
        names.push_back(name_of(row));
        const std::string name = names.back();
        for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
            names.push_back(name.substr(0, dot));
        }
    }
}

std::string nearest_word(const Json& whole, std::string_view word) {
    std::vector<std::string> names(reference_parts.begin(), reference_parts.end());
    for (const auto& [part, rows] : whole.items()) {
        if (rows.is_array()) {
            add_names(rows, names);
        }
    }
    add_names(whole["faults"]["kinds"], names);
    add_names(whole["faults"]["printer"]["kinds"], names);
    std::vector<std::string_view> views(names.begin(), names.end());
    return std::string(behaviour::nearest(word, views));
}

/// What a profile calls its own codes and lines, as rows of the part "codes".
void add_own_codes(const behaviour::Profile& profile, Json& codes) {
    for (const auto& [code, words] : profile.words) {
        const bool command = code.starts_with('M') || code.starts_with('G');
        Json fields = Json::array();
        for (const auto& [key, name] : words.fields) {
            fields.push_back({{"key", key}, {"name", name}, {"kind", "text"}});
        }
        codes.push_back({{"code", code},
                         {"direction", command ? "to_board" : "to_screen"},
                         {"title", words.title},
                         {"meaning", fmt::format("In the words of {}.", profile.name)},
                         {"fields", std::move(fields)}});
    }
}

}  // namespace

Choice choose_reference(const std::vector<std::string>& words, const behaviour::Profile* profile) {
    Choice out;
    Json whole = reference_json(reference_parts);
    if (profile != nullptr) {
        add_own_codes(*profile, whole["codes"]);
    }
    if (words.empty()) {
        out.reference = whole;
        return out;
    }
    out.reference = Json::object();
    std::vector<std::string> known;
    for (const auto& [part, rows] : whole.items()) {
        Json chosen;
        for (const std::string& word : words) {
            if (word == part) {
                chosen = rows;
                known.push_back(word);
                break;
            }
            const Json found = part_of(part, rows, word);
            if (!found.is_null()) {
                known.push_back(word);
                if (chosen.is_array()) {
                    chosen.insert(chosen.end(), found.begin(), found.end());
                } else {
                    chosen = found;
                }
            }
        }
        if (!chosen.is_null()) {
            out.reference[part] = std::move(chosen);
        }
    }
    for (const std::string& word : words) {
        if (std::find(known.begin(), known.end(), word) == known.end()) {
            const std::string near = nearest_word(whole, word);
            out.wrong = fmt::format("there is no part, field, action, event, code or fault \"{}\"{}", word,
                                    near.empty() ? "" : "; did you mean \"" + near + "\"?");
            break;
        }
    }
    return out;
}

}  // namespace fauxboard::tools
