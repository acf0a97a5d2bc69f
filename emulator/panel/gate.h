#pragma once

// Who may come in: decided from the head of a request alone. No sockets.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fauxboard::panel {

/// What of a request decides. Views of what the client sent, any bytes.
struct Head {
    std::string_view method;
    std::string_view path;  ///< from the first slash, without the query
    std::optional<std::string_view> host;
    std::optional<std::string_view> origin;
    std::optional<std::string_view> fetch_site;  ///< Sec-Fetch-Site
};

enum class Refusal : std::uint8_t {
    none,
    host,    ///< a name that leads here is not ours: another site's, which has pointed it at this address
    origin,  ///< a page of another site asks
    token,   ///< whoever asks does not know the address
    method,
};

/// The door of one panel. Other sites that a browser shows can send requests to this address, too; what they
/// cannot do is to know the token, to leave the Origin out, or to put our Host in.
class Gate {
  public:
    /// `name`: the host of `--web` as it was written, which is let in like an address; empty for none.
    /// `token`: what the path begins with.
    Gate(std::string token, std::string name, std::uint16_t port)
        : token_(std::move(token)), name_(std::move(name)), port_(port) {}

    Refusal judge(const Head& head) const;
    /// What of the path is behind the token, from its slash on: "/", "/live/3". Only of a path that judge()
    /// lets in.
    std::string_view rest(std::string_view path) const { return path.substr(1 + token_.size()); }
    const std::string& token() const { return token_; }

  private:
    bool is_ours(std::string_view host) const;

    std::string token_;
    std::string name_;
    std::uint16_t port_;
};

inline constexpr std::size_t shortest_token = 12;
inline constexpr std::size_t longest_token = 64;
/// Letters, digits, - and _, not too few and not too many.
bool is_token(std::string_view text);

/// 128 bits of chance as hexadecimal digits. Throws std::runtime_error when the system has none.
std::string make_token();

/// A whole number without sign, spaces or leading plus; nothing for anything else.
std::optional<std::uint64_t> parse_number(std::string_view text);

/// The parts of "/live/3/7": "live", "3", "7". Empty parts and more than `most` parts make it nothing.
struct Route {
    static constexpr std::size_t most = 3;
    std::string_view parts[most]{};
    std::size_t count = 0;
};
std::optional<Route> parse_route(std::string_view rest);

}  // namespace fauxboard::panel
