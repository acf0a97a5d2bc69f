#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fauxboard::behaviour {

/// One test case of a report that CI systems read.
struct JUnitCase {
    std::string class_name;
    std::string name;
    double seconds = 0;
    std::string failure;  ///< kind of failure, "" when it passed
    std::string message;  ///< of the failure, or why it was skipped
    bool skipped = false;
};

/// JUnit's XML with one suite. Control characters become blanks.
std::string junit_text(std::string_view suite, std::span<const JUnitCase> cases);

}  // namespace fauxboard::behaviour
