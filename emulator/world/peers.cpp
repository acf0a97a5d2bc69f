#include "emulator/world/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "emulator/world/world.h"
#include "protocol/chitu_chunk.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

using board::Channel;
using fault::Dice;

/// Numbers below those bounds in a text.
template <class... Bounds>
std::string in_parts(std::string_view format, Dice& dice, Bounds... bounds) {
    return std::apply([format](auto... drawn) { return fmt::format(fmt::runtime(format), drawn...); },
                      draw(dice, bounds...));
}

std::string number(Dice& dice) {
    switch (dice.below(6)) {
        case 0:
            return std::to_string(dice.below(4));
        case 1:
            return std::to_string(dice.below(300));
        case 2:
            return in_parts("-{}.{}", dice, 50, 100);
        case 3:
            return in_parts("{}.{:03}", dice, 300, 1000);
        case 4:
            return std::to_string(dice.next());
        default:
            return "";
    }
}

std::string with_parameters(const std::string& code, Dice& dice) {
    std::string out = code;
    for (std::uint64_t i = dice.below(4); i > 0; --i) {
        out += ' ';
        out += one_of(std::string_view("SPXYZEFRTABCDHIJKQUVW"), dice);
        out += number(dice);
    }
    return out;
}

std::string garbage(Dice& dice) {
    std::string out;
    for (std::uint64_t i = dice.below(dice.below(20) == 0 ? 5000 : 40); i > 0; --i) {
        out += static_cast<char>(dice.below(3) == 0 ? dice.below(256) : 0x20 + dice.below(95));
    }
    return out;
}

/// A code of a list with parameters, or with the name of a file, or none at all.
std::string request(const std::vector<std::string>& codes, Dice& dice) {
    if (codes.empty() || dice.below(20) == 0) {
        return garbage(dice);
    }
    const std::string& code = one_of(codes, dice);
    static constexpr std::array<std::string_view, 5> names{"part.gco", "long.gco", "empty.gco", "none.gco",
                                                           "../part.gco"};
    return dice.below(5) == 0 ? fmt::format("{} {}", code, one_of(names, dice)) : with_parameters(code, dice);
}

}  // namespace

void screen_asks(World& w, Dice& dice) {
    const std::string body = request(w.cast().requests, dice);
    const bool framed = w.cast().profile->line.framing == behaviour::Framing::frames;
    w.say(Channel::main, framed ? protocol::frame(body) : body + "\r\n");
}

void screen_stammers(World& w, Dice& dice) {
    std::string text = garbage(dice);
    if (dice.below(2) == 0) {
        text += '\n';
    }
    w.say(Channel::main, text);
}

void screen_is_touched(World& w, Dice& dice) {
    w.touch(dice);
}

void screen_floods(World& w, Dice& dice) {
    std::string all;
    for (std::uint64_t i = dice.below(200); i > 0; --i) {
        all += protocol::frame("M105");
    }
    w.say(Channel::main, all);
}

void host_commands(World& w, Dice& dice) {
    w.command(request(w.cast().commands, dice));
}

/// More than any queue holds, by a host that does not wait.
void host_floods(World& w, Dice& dice) {
    w.command("G4 S3");
    for (std::uint64_t i = dice.below(5000); i > 0; --i) {
        w.command("M105");
    }
}

void host_stammers(World& w, Dice& dice) {
    static constexpr std::array<std::string_view, 8> odd{
        "N3 M105*1\n", "N5 M105\n", "M105*7\n", "\n", "M\n", "N\n", "*\n", "N-1 M110*0\n"};
    w.say(Channel::host, dice.below(2) == 0 ? std::string(one_of(odd, dice)) : garbage(dice) + "\n");
}

void host_prints(World& w, Dice& dice) {
    for (std::uint64_t i = dice.below(30); i > 0; --i) {
        const auto [x, y, e, f] = draw(dice, 100, 100, 10, 6000);
        w.command(fmt::format("G1 X{} Y{} E{} F{}", x, y, e, 600 + f));
        w.pass(std::chrono::milliseconds(dice.below(50)));
    }
}

void host_uploads(World& w, Dice& dice) {
    if (w.owed() > 0) {
        return;  // a good host waits
    }
    // One that will not come back has a name of its own: what others say then goes into that file.
    const bool given_up = dice.below(8) == 0;
    const std::string name = given_up ? "left.gco" : fmt::format("up{}.gco", dice.below(3));
    const std::uint64_t lines = dice.below(60);
    std::string content;
    std::vector<std::string> said;
    for (std::uint64_t i = 0; i < lines; ++i) {
        said.push_back(in_parts("G1 X{} Y{}", dice, 100, 100));
        content += said.back() + "\r\n";
    }
    if (!given_up) {
        w.will_be(name, content);
    }
    w.command("M28 " + name);
    for (const std::string& line : said) {
        w.command(line);
        w.let_most_be_acknowledged();  // what is logged is carried out as well
    }
    if (!given_up) {
        w.command("M29");
    }
}

void network_asks(World& w, Dice& dice) {
    static constexpr std::array<std::string_view, 6> ends{"", "\n", "\r\n", "\0", "\r", "  "};
    const std::uint64_t peer = 1 + dice.below(3);
    if (dice.below(4) == 0) {
        w.datagram(peer, garbage(dice));
        return;
    }
    const std::string asked = request(w.cast().requests, dice);
    w.datagram(peer, asked + std::string(one_of(ends, dice)));
}

/// Others that know M28 take a file as a host writes it, a line at a time.
bool takes_files(const World& w) {
    const auto knows = [&requests = w.cast().requests](std::string_view code) {
        return std::find(requests.begin(), requests.end(), code) != requests.end();
    };
    return w.cast().probes[static_cast<std::size_t>(Channel::network)] && knows("M28") && knows("M3000");
}

bool taken(const std::string& answer) {
    return answer.find("ok") != std::string::npos && answer.find("Error") == std::string::npos;
}

std::string_view write_piece(std::array<char, protocol::max_chunk_bytes>& room, std::size_t from,
                             std::string_view piece) {
    return {room.data(), protocol::write_chunk(room, static_cast<std::uint32_t>(from), piece)};
}

/// A file in pieces, as the boards' network module takes them. Some come twice or too early; who was told to
/// say a piece again does so, and who was refused gives up.
void network_uploads(World& w, Dice& dice) {
    if (!takes_files(w)) {
        return;
    }
    const std::string name = fmt::format("net{}.gco", dice.below(3));
    const std::uint64_t peer = 1 + dice.below(3);
    std::string content;
    for (std::uint64_t i = dice.below(2000); i > 0; --i) {
        content += fmt::format("G1 X{}", dice.below(1000));
    }
    const std::size_t most = 1 + dice.below(protocol::max_chunk_payload);
    const std::uint64_t given_up_at = dice.below(6) == 0 ? dice.below(content.size() + 1) : content.size();
    w.will_be(name, content);
    bool goes_on = taken(w.told(peer, "M28 " + name));
    std::array<char, protocol::max_chunk_bytes> room;
    int odd = 0;
    for (std::size_t at = 0; goes_on && at < given_up_at;) {
        const std::uint64_t course = ++odd < 100 ? dice.below(8) : 7;
        const std::size_t from = course == 0 ? at - std::min(at, most) : course == 1 ? at + 1 : at;
        const std::string_view piece = std::string_view(content).substr(std::min(from, content.size()), most);
        const std::string answer = w.told(peer, write_piece(room, from, piece.empty() ? "x" : piece));
        if (const auto again = protocol::resend_offset(answer)) {
            goes_on = *again <= content.size();
            at = *again;
        } else {
            goes_on = taken(answer);
            at = from + piece.size();
        }
        w.pass(std::chrono::milliseconds(dice.below(50)));
    }
    if (goes_on && given_up_at == content.size() && taken(w.told(peer, "M29"))) {
        w.is_saved(name, content);
    }
}

std::string upload_of_a_newcomer(World& w) {
    constexpr std::uint64_t newcomer = 98;
    const std::string name = "newcomer.gco";
    const std::string content = "G1 X1\nG1 X2\n";
    if (!takes_files(w)) {
        return {};
    }
    w.will_be(name, content);
    std::array<char, protocol::max_chunk_bytes> room;
    for (const std::string& bytes :
         {"M28 " + name, std::string(write_piece(room, 0, content)), std::string("M29")}) {
        if (const std::string answer = w.told(newcomer, bytes); !taken(answer)) {
            return fmt::format("an upload was answered by \"{}\"", answer.substr(0, answer.find('\n')));
        }
    }
    w.is_saved(name, content);
    return {};
}

}  // namespace fauxboard::world
