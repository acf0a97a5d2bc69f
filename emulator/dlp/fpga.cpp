#include "emulator/dlp/fpga.h"

#include <md5.h>

#include <algorithm>

#include "emulator/dlp/crc16.h"

namespace fauxboard::dlp {
namespace {

constexpr std::uint8_t read_mark = 0x80;
constexpr std::size_t command_bytes = 3;
constexpr PanelLine dark_line{};

std::string digest_of(std::span<const std::uint8_t> bank) {
    MD5_CTX context;
    MD5Init(&context);
    Packet packet{};
    for (unsigned n = 0; n < panel_lines; ++n) {
        if (!bank.empty()) {
            const auto line = bank.subspan(n * line_bytes, line_bytes);
            std::copy(line.begin(), line.end(), packet.begin() + 2);
        }
        seal(packet, 0, n);
        MD5Update(&context, packet.data(), packet.size());
    }
    std::array<char, MD5_DIGEST_STRING_LENGTH> text{};
    return MD5End(&context, text.data());
}

}  // namespace

double Fpga::random() {
    // xorshift64*; the upper bits are the good ones.
    random_ ^= random_ >> 12;
    random_ ^= random_ << 25;
    random_ ^= random_ >> 27;
    return static_cast<double>(random_ * 0x2545'F491'4F6C'DD1DULL >> 11) / 9007199254740992.0;
}

bool Fpga::damaged(unsigned line) {
    return trouble.bad_line == line || (trouble.bad_share > 0 && random() < trouble.bad_share);
}

void Fpga::packet(std::span<const std::uint8_t, packet_bytes> packet) {
    ++counters_.packets;
    const unsigned bank = bank_of(packet[0]);
    const unsigned line = (packet[0] & 0x0FU) << 8 | packet[1];
    const unsigned sent = packet[packet_bytes - 2] * 256U + packet[packet_bytes - 1];
    pin_ = crc16(packet.first<packet_bytes - 2>()) == sent && line < panel_lines && !damaged(line);
    if (!pin_) {
        ++counters_.crc_errors;
        return;
    }
    if (white()) {
        return;
    }
    auto& stored = banks_[bank];
    if (stored.empty()) {
        stored.resize(bank_bytes);
    }
    std::copy_n(packet.begin() + 2, line_bytes, stored.begin() + line * line_bytes);
    digests_[bank] = {};
}

void Fpga::transfer(std::span<const std::uint8_t> out, std::span<std::uint8_t> in) {
    std::fill(in.begin(), in.end(), std::uint8_t{0});
    if (out.size() == packet_bytes && (out[0] & (read_mark | 0x40)) == 0x40) {
        packet(out.first<packet_bytes>());
    } else if (out.size() == command_bytes && out[0] == read_mark) {
        const auto answer = static_cast<std::uint8_t>(command_ | version_);
        in[2] = trouble.wrong_read_back ? static_cast<std::uint8_t>(answer ^ 0xF0) : answer;
    } else if (out.size() == command_bytes && out[0] == 0) {
        ++counters_.commands;
        command_ = out[2] & 0xF0;
    } else {
        ++counters_.strange;
    }
}

void Fpga::reset() {
    const bool unclean = (command_ & (scan_bit | read_bit)) != 0;
    dead_ = unclean && trouble.unclean_reset.value_or(random() < trouble.unclean_share);
    command_ = 0;
    pin_ = true;
}

std::span<const std::uint8_t> Fpga::line(unsigned bank, unsigned line) const {
    return banks_[bank].empty() ? std::span<const std::uint8_t>(dark_line)
                                : std::span(banks_[bank]).subspan(line * line_bytes, line_bytes);
}

std::uint32_t Fpga::lit_pixels(unsigned bank) const {
    auto& known = digests_[bank].lit;
    if (!known) {
        known = count_lit(banks_[bank]);
    }
    return *known;
}

const std::string& Fpga::md5(unsigned bank) const {
    std::string& known = digests_[bank].md5;
    if (known.empty()) {
        known = digest_of(banks_[bank]);
    }
    return known;
}

std::uint64_t Fpga::sum(unsigned bank) const {
    std::uint64_t sum = 0;
    for (unsigned n = 0; n < panel_lines; ++n) {
        sum = add_line(sum, line(bank, n));
    }
    return sum;
}

}  // namespace fauxboard::dlp
