#include "emulator/record/pcapng.h"

#include <fmt/format.h>

#include <utility>

namespace fauxboard::record {
namespace {

using machine::SimTime;
using protocol::Direction;

constexpr std::uint32_t section_block = 0x0A0D0D0A;
constexpr std::uint32_t interface_block = 1;
constexpr std::uint32_t packet_block = 6;
constexpr std::uint16_t option_application = 4;   // section
constexpr std::uint16_t option_name = 2;          // interface
constexpr std::uint16_t option_description = 3;   // interface
constexpr std::uint16_t option_resolution = 9;    // interface
constexpr std::uint16_t option_packet_flags = 2;  // packet
constexpr std::uint32_t inbound = 1;
constexpr std::uint32_t outbound = 2;

void little16(std::string& out, std::uint32_t value) {
    out += static_cast<char>(value & 0xFF);
    out += static_cast<char>((value >> 8) & 0xFF);
}

void little32(std::string& out, std::uint32_t value) {
    little16(out, value);
    little16(out, value >> 16);
}

void big32(std::string& out, std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) {
        out += static_cast<char>((value >> shift) & 0xFF);
    }
}

/// To the next multiple of four bytes.
void pad(std::string& out) {
    out.append((4 - out.size() % 4) % 4, '\0');
}

void option(std::string& out, std::uint16_t code, std::string_view value) {
    little16(out, code);
    little16(out, static_cast<std::uint32_t>(value.size()));
    out += value;
    pad(out);
}

void end_of_options(std::string& out) {
    little32(out, 0);
}

std::string block(std::uint32_t type, std::string_view body) {
    const auto length = static_cast<std::uint32_t>(body.size() + 12);
    std::string out;
    out.reserve(length);
    little32(out, type);
    little32(out, length);
    out += body;
    little32(out, length);
    return out;
}

std::string section() {
    std::string body;
    little32(body, 0x1A2B3C4D);  // tells the byte order
    little16(body, 1);
    little16(body, 0);
    body.append(8, '\xFF');  // length of the section: not said
    option(body, option_application, "fauxboard tap");
    end_of_options(body);
    return block(section_block, body);
}

std::string interface_of(std::string_view name, std::string_view description,
                         std::uint16_t link_type = pcapng_link_type) {
    std::string body;
    little16(body, link_type);
    little16(body, 0);
    little32(body, 0);  // no limit of a packet's length
    option(body, option_name, name);
    option(body, option_description, description);
    option(body, option_resolution, "\x06");  // times in microseconds
    end_of_options(body);
    return block(interface_block, body);
}

std::string packet_of(SimTime since_epoch, std::uint32_t interface, bool out, std::string_view data) {
    const auto us = static_cast<std::uint64_t>(since_epoch.count());
    const auto length = static_cast<std::uint32_t>(data.size());
    std::string body;
    little32(body, interface);
    little32(body, static_cast<std::uint32_t>(us >> 32));
    little32(body, static_cast<std::uint32_t>(us & 0xFFFFFFFF));
    little32(body, length);  // captured
    little32(body, length);  // on the wire
    body += data;
    pad(body);
    std::string flags;
    little32(flags, out ? outbound : inbound);
    option(body, option_packet_flags, flags);
    end_of_options(body);
    return block(packet_block, body);
}

}  // namespace

std::string pcapng_head() {
    return section() + interface_of("board", "what the board says") +
           interface_of("other end", "what a touch screen or a host says to the board");
}

std::string pcapng_packet(SimTime since_epoch, Direction direction, std::string_view bytes) {
    const auto us = static_cast<std::uint64_t>(since_epoch.count());
    const bool from_board = direction == Direction::to_screen;
    std::string data;
    data.reserve(bytes.size() + pcapng_event_bytes);
    big32(data, static_cast<std::uint32_t>(us / 1'000'000));
    big32(data, static_cast<std::uint32_t>(us % 1'000'000));
    data += from_board ? '\x01' : '\x02';
    data.append(3, '\0');
    data += bytes;
    return packet_of(since_epoch, from_board ? 0 : 1, from_board, data);
}

std::string pcapng_user_head(std::string_view interface, std::string_view description) {
    return section() + interface_of(interface, description, pcapng_user_type);
}

std::string pcapng_user_packet(SimTime since_epoch, bool out, std::string_view bytes) {
    return packet_of(since_epoch, 0, out, bytes);
}

PcapngWriter::PcapngWriter(std::string file, SimTime start, OnTrouble on_trouble, std::string_view head,
                           std::chrono::milliseconds patience)
    : file_(std::move(file)),
      start_(start),
      on_trouble_(std::move(on_trouble)),
      out_(file_, fmt::format("The capture {}", file_), patience) {
    write(head);
}

void PcapngWriter::packet(SimTime now, Direction direction, std::string_view bytes) {
    block(pcapng_packet(start_ + now, direction, bytes));
}

void PcapngWriter::block(std::string_view packet) {
    if (!out_.over() && write(packet)) {
        ++packets_;
    }
}

bool PcapngWriter::write(std::string_view block) {
    const std::string why = out_.append(block);
    if (!why.empty() && on_trouble_) {
        on_trouble_(fmt::format("the capture {} ends here, after {} packets: {}", file_, packets_, why));
    }
    return why.empty();
}

void PcapngWriter::finish() {
    const std::string why = out_.finish();
    if (!why.empty() && on_trouble_) {
        on_trouble_(fmt::format("the capture {} is not whole: {}", file_, why));
    }
}

}  // namespace fauxboard::record
