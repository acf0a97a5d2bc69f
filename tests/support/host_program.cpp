#include "tests/support/host_program.h"

#include "protocol/framing.h"

namespace fauxboard::testing {
namespace {

constexpr double patience_s = 10;  ///< silence after which the line is sent again; the board says busy before
constexpr int most_silences = 6;

}  // namespace

std::uint64_t HostProgram::next_random() {
    random_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = random_;
    z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ z >> 27U) * 0x94D049BB133111EBULL;
    return z ^ z >> 31U;
}

bool HostProgram::roll(int per_mille) {
    return static_cast<int>(next_random() % 1000) < per_mille;
}

void HostProgram::send(std::size_t number) {
    std::string line = "N" + std::to_string(number) + " " + lines_[number];
    line += "*" + std::to_string(protocol::xor_checksum(line));
    if (number != 0 && roll(noise_.lost_per_mille)) {
        ++lost_;
        return;
    }
    if (number != 0 && roll(noise_.damaged_per_mille)) {
        ++damaged_;
        char& byte = line[next_random() % line.size()];
        do {
            byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << next_random() % 8));
        } while (byte == '\n' || byte == '\r');
    }
    driver_.host(line);
}

void HostProgram::look(const std::string& reply) {
    if (reply.starts_with("Resend: ")) {
        wanted_ = static_cast<std::size_t>(std::stoul(reply.substr(8)));
        ++resends_;
    } else if (reply.starts_with("ok")) {
        ok_ = true;
    }
}

bool HostProgram::print(std::string_view gcode, double limit_s,
                        const std::function<void(const std::string& command)>& acknowledged) {
    lines_ = {"M110 N0"};
    while (!gcode.empty()) {
        const std::size_t end = std::min(gcode.find('\n'), gcode.size());
        std::string_view line = gcode.substr(0, std::min(end, gcode.find(';')));
        line = line.substr(0, line.find_last_not_of(" \r") + 1);
        if (!line.empty()) {
            lines_.emplace_back(line);
        }
        gcode.remove_prefix(std::min(end + 1, gcode.size()));
    }
    std::size_t seen = driver_.replies().size();
    const double end = driver_.now() + limit_s;
    int silences = 0;
    at_ = 0;
    send(at_);
    while (at_ < lines_.size() && driver_.now() < end) {
        const bool spoke =
            seen < driver_.replies().size() || driver_.run_until_reply(driver_.now() + patience_s);
        if (!spoke) {
            if (++silences == most_silences) {
                return false;
            }
            send(at_);
            continue;
        }
        silences = 0;
        look(driver_.replies()[seen++].line);
        if (!ok_) {
            continue;
        }
        ok_ = false;
        if (wanted_ != 0) {
            at_ = wanted_;
            wanted_ = 0;
        } else {
            // An ok for a line that damage made another command is no acknowledgement; the board will ask.
            if (driver_.number("host.last_line") == static_cast<double>(at_)) {
                acknowledged(lines_[at_]);
            }
            ++at_;
        }
        if (at_ < lines_.size()) {
            send(at_);
        }
    }
    return at_ == lines_.size();
}

}  // namespace fauxboard::testing
