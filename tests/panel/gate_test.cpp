#include "emulator/panel/gate.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

namespace fauxboard::panel {
namespace {

const std::string token = "0123456789abcdef0123456789abcdef";

Gate gate(std::string name = {}) {
    return Gate(token, std::move(name), 4321);
}

Head head(std::string_view path) {
    return {"GET", path, "127.0.0.1:4321", std::nullopt, std::nullopt};
}

TEST_CASE("whoever has the whole address comes in") {
    const std::string page = "/" + token + "/";
    CHECK(gate().judge(head(page)) == Refusal::none);
    CHECK(gate().rest(page) == "/");
    CHECK(gate().rest(page + "live/3") == "/live/3");
    Head post = head(page);
    post.method = "POST";
    post.origin = "http://127.0.0.1:4321";
    post.fetch_site = "same-origin";
    CHECK(gate().judge(post) == Refusal::none);
}

TEST_CASE("a path without the token, with half of it or with more is refused") {
    for (const std::string& path :
         {std::string("/"), std::string(), "/" + token, token + "/", "/" + token.substr(1) + "/",
          "/" + token + "x/", "//" + token + "/", "/" + std::string(32, 'f') + "/", "/../" + token + "/",
          "/" + token.substr(0, 31) + "/"}) {
        CAPTURE(path);
        CHECK(gate().judge(head(path)) == Refusal::token);
    }
}

TEST_CASE("Host: addresses and localhost with our port, and the name that was asked for; no other name") {
    const std::string page = "/" + token + "/";
    const auto with = [&](std::string_view host, std::string name = {}) {
        Head asked = head(page);
        asked.host = host;
        return gate(std::move(name)).judge(asked);
    };
    for (const char* host :
         {"127.0.0.1:4321", "localhost:4321", "LocalHost:4321", "[::1]:4321", "192.168.1.7:4321"}) {
        CAPTURE(host);
        CHECK(with(host) == Refusal::none);
    }
    for (const char* host :
         {"evil.example:4321", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:", "127.0.0.1:43210",
          "127.0.0.1.evil.example:4321", "localhost", "localhost.evil.example:4321", "", ":4321",
          "127.1:4321", "0x7f000001:4321", "127.0.0.1:+4321", "[::1:4321", "::1:4321", "127.0.0.1:4321 ",
          "127.0.0.1:99999999999999999999999"}) {
        CAPTURE(host);
        CHECK(with(host) == Refusal::host);
    }
    CHECK(with("printer.lan:4321") == Refusal::host);
    CHECK(with("printer.lan:4321", "printer.lan") == Refusal::none);
    Head none = head(page);
    none.host.reset();
    CHECK(gate().judge(none) == Refusal::host);
}

TEST_CASE("a page of another site is refused by its Origin, or by what the browser says of it") {
    const std::string page = "/" + token + "/live/0/1";
    for (const char* origin :
         {"http://evil.example", "null", "https://127.0.0.1:4321", "http://127.0.0.1:4322",
          "http://127.0.0.1:4321.evil.example", "", "http://127.0.0.1"}) {
        CAPTURE(origin);
        Head asked = head(page);
        asked.origin = origin;
        CHECK(gate().judge(asked) == Refusal::origin);
    }
    for (const char* site : {"cross-site", "same-site", "", "none, same-origin"}) {
        CAPTURE(site);
        Head asked = head(page);
        asked.fetch_site = site;
        CHECK(gate().judge(asked) == Refusal::origin);
    }
}

TEST_CASE("methods other than GET and POST are refused") {
    const std::string page = "/" + token + "/";
    for (const char* method : {"PUT", "DELETE", "OPTIONS", "get", ""}) {
        Head asked = head(page);
        asked.method = method;
        CHECK(gate().judge(asked) == Refusal::method);
    }
}

TEST_CASE("tokens are made of chance, and one of the user's has bounds") {
    std::set<std::string> seen;
    for (int i = 0; i < 100; ++i) {
        const std::string made = make_token();
        CHECK(is_token(made));
        CHECK(seen.insert(made).second);
    }
    CHECK(is_token("my-desk_screen"));
    CHECK_FALSE(is_token("short"));
    CHECK_FALSE(is_token(std::string(65, 'a')));
    CHECK_FALSE(is_token("with/a/slash/in/it"));
    CHECK_FALSE(is_token(std::string("nul\0nul\0nul\0nul", 15)));
}

TEST_CASE("routes: up to three parts, none of them empty") {
    CHECK(parse_route("/")->count == 0);
    const auto live = parse_route("/live/3/7");
    REQUIRE(live);
    CHECK(live->count == 3);
    CHECK(live->parts[2] == "7");
    for (const char* bad : {"//", "/live/", "/live//3", "/a/b/c/d", "live"}) {
        CAPTURE(bad);
        CHECK_FALSE(parse_route(bad));
    }
    CHECK(parse_number("18446744073709551615") == 18446744073709551615U);
    for (const char* bad : {"", "-1", "+1", " 1", "1 ", "18446744073709551616", "1e3", "0x1"}) {
        CAPTURE(bad);
        CHECK_FALSE(parse_number(bad));
    }
}

}  // namespace
}  // namespace fauxboard::panel
