#include "emulator/script/pattern.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include "emulator/behaviour/wire_text.h"

namespace fauxboard::script {
namespace {

constexpr std::int64_t most_memory = 1 << 20;

re2::RE2::Options options() {
    re2::RE2::Options out;
    out.set_encoding(re2::RE2::Options::EncodingLatin1);
    out.set_log_errors(false);
    out.set_max_mem(most_memory);
    return out;
}

}  // namespace

Pattern::Pattern(const std::string& utf8) {
    if (utf8.empty()) {
        throw PatternError("an empty pattern is found in every line");
    }
    if (utf8.size() > most_bytes) {
        throw PatternError(
            fmt::format("a pattern of {} bytes; expected at most {}", utf8.size(), most_bytes));
    }
    const auto bytes = behaviour::to_wire(utf8);
    if (!bytes) {
        throw PatternError("the line carries bytes: a pattern holds characters up to U+00FF only");
    }
    regex_ = std::make_unique<re2::RE2>(*bytes, options());
    if (!regex_->ok()) {
        throw PatternError("the regular expression is wrong: " + behaviour::from_wire(regex_->error()));
    }
}

Pattern::~Pattern() = default;

bool Pattern::search(std::string_view line, Captures& captures) const {
    const auto groups = static_cast<std::size_t>(regex_->NumberOfCapturingGroups()) + 1;
    std::vector<re2::StringPiece> found(groups);
    const re2::StringPiece text(line.data(), line.size());
    if (!regex_->Match(text, 0, line.size(), re2::RE2::UNANCHORED, found.data(), static_cast<int>(groups))) {
        return false;
    }
    for (const auto& [name, index] : regex_->NamedCapturingGroups()) {
        const re2::StringPiece& piece = found[static_cast<std::size_t>(index)];
        captures[name] = behaviour::from_wire({piece.data(), piece.size()});
    }
    return true;
}

std::size_t Pattern::size() const {
    return static_cast<std::size_t>(regex_->ProgramSize());
}

std::vector<std::string> Pattern::names() const {
    std::vector<std::string> out;
    for (const auto& [name, index] : regex_->NamedCapturingGroups()) {
        out.push_back(name);
    }
    return out;
}

}  // namespace fauxboard::script
