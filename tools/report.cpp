#include "tools/report.h"

#include <fmt/format.h>
#include <unistd.h>

#include "emulator/host/text_output.h"

namespace fauxboard::tools {
namespace {

void write(int fd, std::string_view text) {
    host::TextOutput(fd, host::TextOutput::WhenFull::wait).write(text);
}

}  // namespace

ExitCode complain(std::string_view command, ExitCode code, std::string_view sentence) {
    write(STDERR_FILENO, fmt::format("fauxboard{}{}: {}\n", command.empty() ? "" : " ", command, sentence));
    return code;
}

void print_error(std::string_view text) {
    write(STDERR_FILENO, text);
}

void print(std::string_view text) {
    write(STDOUT_FILENO, text);
}

}  // namespace fauxboard::tools
