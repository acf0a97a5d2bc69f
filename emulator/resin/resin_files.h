#pragma once

#include <string>

namespace fauxboard::resin {

class Printer;

/// The backup file of M8512: every setting as the request that sets it, with a word on each. Printed as a
/// file, it would put the settings back. Source: the backup of an Elegoo
/// Mars Pro, V4.3.3_LCDC.
std::string backup_text(const Printer& printer);

/// The diagnostics file of M8093: words of status, and some of the settings. As above.
std::string diagnostics_text(const Printer& printer);

}  // namespace fauxboard::resin
