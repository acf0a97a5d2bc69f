#include "emulator/behaviour/junit.h"

#include <fmt/format.h>

namespace fauxboard::behaviour {
namespace {

/// Text for an attribute.
std::string xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
        }
    }
    return out;
}

}  // namespace

std::string junit_text(std::string_view suite, std::span<const JUnitCase> cases) {
    double total = 0;
    std::size_t failed = 0;
    std::size_t skipped = 0;
    for (const JUnitCase& each : cases) {
        total += each.seconds;
        failed += each.failure.empty() ? 0U : 1U;
        skipped += each.skipped ? 1U : 0U;
    }
    std::string out = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{:.3f}\">\n",
        xml(suite), cases.size(), failed, skipped, total);
    for (const JUnitCase& each : cases) {
        out += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">", xml(each.class_name),
                           xml(each.name), each.seconds);
        if (!each.failure.empty()) {
            out += fmt::format("\n    <failure type=\"{}\" message=\"{}\"/>\n  ", xml(each.failure),
                               xml(each.message));
        } else if (each.skipped) {
            out += each.message.empty()
                       ? "\n    <skipped/>\n  "
                       : fmt::format("\n    <skipped message=\"{}\"/>\n  ", xml(each.message));
        }
        out += "</testcase>\n";
    }
    return out + "</testsuite>\n</testsuites>\n";
}

}  // namespace fauxboard::behaviour
