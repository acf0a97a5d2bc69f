#include "tests/fuzz/support.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>

#include "protocol/framing.h"

namespace fauxboard::fuzz {
namespace {

std::optional<behaviour::SourceText> read_shipped(std::string_view name) {
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    });
    if (!plain || name.empty() || name.size() > 64) {
        return std::nullopt;
    }
    const std::string file = std::string(FAUXBOARD_SOURCE_DIR "/profiles/").append(name).append(".json");
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::nullopt;
    }
    return behaviour::SourceText{
        file, std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>())};
}

/// A real A30T sends these two without a checksum.
bool unfinished(std::string_view line) {
    return line.starts_with("N-0 L14 Pausing") || line.starts_with("N-0 L14 file select succeed!:");
}

/// A real A30 ends these with LF alone.
bool ends_with_lf(std::string_view line) {
    return line.starts_with("echo:SD ") || line.starts_with("M2107 ") || line.starts_with("M2108 ");
}

}  // namespace

void fail(std::string_view rule) {
    std::fprintf(stderr, "\nbroken rule: %.*s\n", static_cast<int>(rule.size()), rule.data());
    std::abort();
}

behaviour::SourceFinder shipped_finder() {
    static std::map<std::string, std::optional<behaviour::SourceText>, std::less<>> known;
    return [](std::string_view name, std::string_view) {
        auto hit = known.find(name);
        if (hit == known.end()) {
            if (known.size() > 256) {
                known.clear();
            }
            hit = known.emplace(name, read_shipped(name)).first;
        }
        return hit->second;
    };
}

std::shared_ptr<const behaviour::Profile> shipped_profile(std::string_view name) {
    static std::map<std::string, std::shared_ptr<const behaviour::Profile>, std::less<>> loaded;
    auto hit = loaded.find(name);
    if (hit == loaded.end()) {
        const auto source = shipped_finder()(name, {});
        require(source.has_value(), "a shipped profile is missing");
        hit = loaded.emplace(name, behaviour::load_profile(*source, shipped_finder())).first;
    }
    return hit->second;
}

void check_output(std::string_view output, bool checksums) {
    while (!output.empty()) {
        const std::size_t end = output.find('\n');
        require(end != std::string_view::npos, "output ends in the middle of a line");
        std::string_view line = output.substr(0, end);
        output.remove_prefix(end + 1);
        if (!line.empty() && line.back() == '\r') {
            line.remove_suffix(1);
        } else {
            require(!checksums || ends_with_lf(line), "a line ends without CR");
        }
        require(!line.empty() || !checksums, "an empty line was sent");
        require(line.size() <= protocol::max_line_bytes + 16, "a line is longer than a line may be");
        require(std::all_of(line.begin(), line.end(),
                            [](char c) { return static_cast<unsigned char>(c) >= 0x20 || c == '\t'; }),
                "a control byte inside a line");
        if (checksums && line.starts_with("N-0 ") && !unfinished(line)) {
            require(protocol::unframe(line, protocol::ChecksumPolicy::required).fault ==
                        protocol::FrameFault::none,
                    "a frame with a wrong checksum was sent");
        }
    }
}

}  // namespace fauxboard::fuzz
