#include "emulator/screen/judgement.h"

#include <array>

#include "emulator/screen/values.h"

namespace fauxboard::screen {

std::string_view verdict_words(Verdict verdict) {
    static constexpr std::array<std::string_view, verdict_count> words{
        "ok",       "ignored",   "part missed", "cut",    "rest dropped", "misread",
        "restarts", "timed out", "runs ahead",  "stalls", "jams",         "would crash"};
    return words[static_cast<std::size_t>(verdict)];
}

std::string Judgement::sentence() const {
    constexpr std::size_t shown = 100;
    std::string out = printable(std::string_view(line).substr(0, shown));
    out += line.size() > shown ? "...: " : ": ";
    out += verdict_words(verdict);
    return why.empty() ? out : out + ": " + why;
}

}  // namespace fauxboard::screen
