#include "tools/ready_line.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <system_error>

#include "emulator/link/host_error.h"

namespace fauxboard::tools {
namespace {

constexpr std::chrono::milliseconds pause{50};

}  // namespace

void ReadyLine::say(const nlohmann::ordered_json& ready) {
    out_.keep("ready " + ready.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n");
    see_off();
}

void ReadyLine::see_off() {
    if (!out_.flush()) {
        return retry_.after(pause);
    }
    const int error = out_.error();
    if (error != 0 && error != EPIPE && error != EBADF) {
        throw link::HostError(fmt::format("The line \"ready\" cannot be written to stdout ({}).",
                                          std::system_category().message(error)));
    }
}

}  // namespace fauxboard::tools
