#include "protocol/catalogue.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "protocol/scan.h"
#include "protocol/tables.h"

namespace fauxboard::protocol {

namespace {

auto order(const CodeInfo& code) {
    return std::tuple(code.direction, code.letter, code.number, code.word);
}

std::vector<CodeInfo> collect() {
    std::vector<CodeInfo> all;
    for (const auto part : {tables::status_replies(), tables::special_replies(), tables::bare_replies(),
                            tables::machine_requests(), tables::job_requests(), tables::smartto_requests(),
                            tables::chitu_requests(), tables::chitu_replies(), tables::marlin_requests(),
                            tables::marlin_replies()}) {
        all.insert(all.end(), part.begin(), part.end());
    }
    std::sort(all.begin(), all.end(),
              [](const CodeInfo& a, const CodeInfo& b) { return order(a) < order(b); });
    return all;
}

bool begins_with_words(std::string_view body, std::string_view words) {
    if (!body.starts_with(words)) return false;
    return !scan::is_letter(words.back()) || body.size() == words.size() ||
           !scan::is_letter(body[words.size()]);
}

}  // namespace

std::span<const CodeInfo> catalogue() {
    static const std::vector<CodeInfo> all = collect();
    return all;
}

const CodeInfo* find_code(Direction direction, char letter, unsigned number) {
    if (letter == 0 || number > 65535) return nullptr;
    const auto all = catalogue();
    const auto wanted = std::tuple(direction, letter, number);
    const auto key = [](const CodeInfo& code) {
        return std::tuple(code.direction, code.letter, unsigned{code.number});
    };
    const auto at =
        std::lower_bound(all.begin(), all.end(), wanted,
                         [&](const CodeInfo& code, const auto& value) { return key(code) < value; });
    return at != all.end() && key(*at) == wanted ? &*at : nullptr;
}

const CodeInfo* find_words(Direction direction, std::string_view body) {
    const CodeInfo* best = nullptr;
    for (const CodeInfo& code : catalogue()) {
        if (code.direction != direction || code.word.empty() || !begins_with_words(body, code.word)) continue;
        if (best == nullptr || code.word.size() > best->word.size()) best = &code;
    }
    return best;
}

std::string code_text(const CodeInfo& code) {
    return code.letter == 0 ? std::string(code.word) : code.letter + std::to_string(code.number);
}

std::string_view words_of(const FieldInfo& field, std::int64_t value) {
    for (const ValueName& name : field.values) {
        if (name.value == value) return name.words;
    }
    return {};
}

std::string value_list(const FieldInfo& field) {
    std::string list;
    for (const ValueName& name : field.values) {
        if (!list.empty()) list += ", ";
        list += std::to_string(name.value);
        list += " = ";
        list += name.words;
    }
    return list;
}

}  // namespace fauxboard::protocol
