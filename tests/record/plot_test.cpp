#include "emulator/record/plot.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace fauxboard::record {
namespace {

std::vector<RecordedLine> heating(int lines, double per_line) {
    std::vector<RecordedLine> out;
    for (int i = 0; i < lines; ++i) {
        std::ostringstream line;
        line << "L2 B:22.0 /0.0 /0 T0:" << 22 + per_line * i << " /200.0 /1";
        out.push_back({std::chrono::seconds(i), RecordedLine::From::board, line.str(), 0});
    }
    return out;
}

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

TEST_CASE("curves of two recordings lie over each other, the first one pale") {
    const auto recorded = heating(20, 2);
    const auto ours = heating(20, 3);
    const std::string svg = plot_svg({{"recorded", recorded}, {"replayed", ours}}, false);
    CHECK(svg.starts_with("<?xml"));
    CHECK(svg.ends_with("</svg>\n"));
    CHECK(svg.find("°C") != std::string::npos);
    CHECK(svg.find("recorded") != std::string::npos);
    CHECK(count(svg, "class=\"wide\" stroke=\"#c8102e\"") == 1);
    CHECK(count(svg, "class=\"thin\" stroke=\"#c8102e\" d=\"M6") == 1);
}

TEST_CASE("what never changes, and what was said twice, is no curve") {
    const auto flat = heating(20, 0);
    CHECK(plot_svg({{"one", flat}}, false).find("Nothing in this recording") != std::string::npos);
    CHECK(plot_svg({{"one", {}}}, false).find("Nothing in this recording") != std::string::npos);
    const auto two = heating(2, 5);
    CHECK(plot_svg({{"one", two}}, false).find("Nothing in this recording") != std::string::npos);
}

TEST_CASE("a long recording comes out with a bounded number of points") {
    const auto longer = heating(50'000, 0.003);
    const std::string svg = plot_svg({{"one", longer}}, false);
    CHECK(svg.size() < 100'000);
}

TEST_CASE("a name is text") {
    const auto recorded = heating(20, 2);
    const std::string svg = plot_svg({{"<script>", recorded}, {"\"&\x01", recorded}}, false);
    CHECK(svg.find("<script>") == std::string::npos);
    CHECK(svg.find('\x01') == std::string::npos);
}

}  // namespace
}  // namespace fauxboard::record
