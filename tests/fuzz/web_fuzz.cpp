// The head of a request to the panel, a line for each: method, path, Host, Origin, Sec-Fetch-Site; "-" is a
// header that is not there, and TOKEN the secret.

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/panel/gate.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using panel::Refusal;

const std::string token = "0123456789abcdef0123456789abcdef";

std::string next_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (const std::size_t at = line.find("TOKEN"); at != std::string::npos) {
        line.replace(at, 5, token);
    }
    return line;
}

std::optional<std::string_view> header(const std::string& line) {
    return line == "-" ? std::nullopt : std::optional<std::string_view>(line);
}

void check_route(std::string_view rest) {
    const auto route = panel::parse_route(rest);
    if (!route) {
        return;
    }
    std::string again;
    for (std::size_t i = 0; i < route->count; ++i) {
        require(!route->parts[i].empty() && route->parts[i].find('/') == std::string_view::npos,
                "a part of a route is empty, or two");
        again.append("/").append(route->parts[i]);
        if (const auto number = panel::parse_number(route->parts[i])) {
            require(route->parts[i].find_first_not_of("0123456789") == std::string_view::npos,
                    "a number is made of something else than digits");
        }
    }
    require(again == rest || (route->count == 0 && (rest == "/" || rest.empty())),
            "a route is not what was asked for");
}

void check(std::string_view input) {
    const std::string method = next_line(input);
    const std::string path = next_line(input);
    const std::string host = next_line(input);
    const std::string origin = next_line(input);
    const std::string site = next_line(input);
    const panel::Head head{method, path, header(host), header(origin), header(site)};
    const panel::Gate gate(token, "printer.lan", 4321);
    check_route(path);
    if (gate.judge(head) != Refusal::none) {
        return;
    }
    require(method == "GET" || method == "POST", "an unknown method comes in");
    require(path.starts_with("/" + token + "/"), "somebody without the secret comes in");
    const std::string_view port = std::string_view(host).substr(host.rfind(':') + 1);
    require(port.substr(std::min(port.find_first_not_of('0'), port.size())) == "4321",
            "somebody who asks another port comes in");
    require(origin == "-" || origin.size() == host.size() + 7, "a page of another site comes in");
    require(site == "-" || site == "none" || site == "same-origin",
            "what the browser calls foreign comes in");
    check_route(gate.rest(path));
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fauxboard::fuzz::check({reinterpret_cast<const char*>(data), size});
    return 0;
}
