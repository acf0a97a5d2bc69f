#include "emulator/panel/gate.h"

#include <arpa/inet.h>
#include <sys/random.h>

#include <array>
#include <charconv>
#include <stdexcept>

namespace fauxboard::panel {
namespace {

/// Takes as long for a wrong token as for the right one.
bool same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) {
        return false;
    }
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference |= static_cast<unsigned>(a[i] ^ b[i]) & 0xFFU;
    }
    return difference == 0;
}

bool is_address(std::string_view host) {
    std::array<unsigned char, sizeof(in6_addr)> room{};
    if (host.starts_with('[') && host.ends_with(']')) {
        return inet_pton(AF_INET6, std::string(host.substr(1, host.size() - 2)).c_str(), room.data()) == 1;
    }
    return inet_pton(AF_INET, std::string(host).c_str(), room.data()) == 1;
}

char small(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_name(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (small(a[i]) != small(b[i])) {
            return false;
        }
    }
    return true;
}

}  // namespace

// An address is no name, so nobody else can have pointed it here; "localhost" is ours by its nature.
bool Gate::is_ours(std::string_view host) const {
    const std::size_t colon = host.rfind(':');
    const bool has_port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
    const std::string_view name = has_port ? host.substr(0, colon) : host;
    const std::optional<std::uint64_t> port =
        has_port ? parse_number(host.substr(colon + 1)) : std::optional<std::uint64_t>{80};
    if (port != port_ || name.size() > 255 || name.find('\0') != std::string_view::npos) {
        return false;
    }
    return is_address(name) || same_name(name, "localhost") || (!name_.empty() && same_name(name, name_));
}

Refusal Gate::judge(const Head& head) const {
    if (!head.host || !is_ours(*head.host)) {
        return Refusal::host;
    }
    constexpr std::string_view scheme = "http://";
    if (head.origin &&
        (!head.origin->starts_with(scheme) || !same_name(head.origin->substr(scheme.size()), *head.host))) {
        return Refusal::origin;
    }
    if (head.fetch_site && *head.fetch_site != "same-origin" && *head.fetch_site != "none") {
        return Refusal::origin;
    }
    const std::string_view path = head.path;
    if (path.size() < token_.size() + 2 || path.front() != '/' || path[token_.size() + 1] != '/' ||
        !same(path.substr(1, token_.size()), token_)) {
        return Refusal::token;
    }
    return head.method == "GET" || head.method == "POST" ? Refusal::none : Refusal::method;
}

bool is_token(std::string_view text) {
    constexpr std::string_view allowed = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_";
    return text.size() >= shortest_token && text.size() <= longest_token &&
           text.find_first_not_of(allowed) == std::string_view::npos;
}

std::string make_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw std::runtime_error("The system has no random numbers for the panel's address.");
    }
    std::string token;
    constexpr std::string_view digits = "0123456789abcdef";
    for (const unsigned char byte : bytes) {
        token += digits[byte >> 4U];
        token += digits[byte & 15U];
    }
    return token;
}

std::optional<std::uint64_t> parse_number(std::string_view text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional{number} : std::nullopt;
}

std::optional<Route> parse_route(std::string_view rest) {
    Route route;
    while (!rest.empty()) {
        if (rest.front() != '/') {
            return std::nullopt;
        }
        rest.remove_prefix(1);
        const std::string_view part = rest.substr(0, rest.find('/'));
        if (part.empty() && rest.empty() && route.count == 0) {
            return route;  // "/"
        }
        if (part.empty() || route.count == Route::most) {
            return std::nullopt;
        }
        route.parts[route.count++] = part;
        rest.remove_prefix(part.size());
    }
    return route;
}

}  // namespace fauxboard::panel
