#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::testing {

/// Names that ask for what is outside of a card's folder, or that a careless program stumbles over. `outside`
/// is the absolute path of a file outside; the folder is expected to hold what trap_card() makes. What a
/// line cannot carry (line ends, NUL) is among them: it is put on the line as it is.
inline std::vector<std::string> hostile_names(const std::string& outside) {
    using namespace std::string_literals;
    const std::string base = outside.substr(outside.rfind('/') + 1);
    std::vector<std::string> names{
        // Upwards.
        "..", "../", "../" + base, "../../" + base, "/../" + base, "./../" + base, "sub/../../" + base,
        "sub/./../../" + base, "sub//..//../" + base, "...", "..../" + base, ".. /" + base, "..\t/" + base,
        // From the root of the computer.
        outside, "/" + outside, "//" + outside, "/etc/passwd", "/proc/self/environ", "~/" + base,
        "file://" + outside,
        // Drives, as the screens name the disks.
        "SD1:/../" + base, "SD1:../" + base, "SD1:" + outside, "SD:/..", "UDISK:/../" + base,
        "SD1:/SD1:/../" + base, "C:\\" + base, "C:/../" + base, ":", ":/../" + base, "Main/..",
        "Main/../" + base,
        // Spelled otherwise.
        "..\\" + base, "sub\\..\\..\\" + base, "%2e%2e/" + base, "..%2f" + base, "%2e%2e%2f" + base,
        "..%5c" + base, "%00", base + "%00.gco", "..;/" + base, "$HOME/" + base, "`id`", "$(id)", "*", "../*",
        // Links, devices, pipes.
        "link", "link/", "folder_link/" + base, "folder_link", "hard", "loop", "loop/x", "pipe", "/dev/zero",
        "/dev/tty", "/dev/fd/0", "dangling", "link.temp", "sub/link", "sub",
        // Bytes.
        "a\0../"s + base, "../"s + base + "\0.gco"s, "\0"s, "\xff\xfe", "..\xc0\xaf" + base,
        "\xc0\xae\xc0\xae/" + base, "\xe2\x80\xae" + base, "\x1b[2J", "\x7f", "name\rM28 ../" + base,
        "name*12", "", " ", ".", "./", "/", "//", "sub/",
        // Lengths.
        std::string(255, 'a'), std::string(256, 'b'), std::string(480, 'c'), std::string(600, 'd'),
        std::string(100, '/') + ".." + base};
    std::string deep;
    std::string up;
    for (int i = 0; i < 120; ++i) {
        deep += "a/";
        up += "../";
    }
    names.push_back(deep + base);
    names.push_back(up + base);
    names.push_back("sub/" + up + outside.substr(1));
    return names;
}

}  // namespace fauxboard::testing
