#include "tools/spi_port.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <regex>

namespace fauxboard::tools {
namespace {

using dlp::ChipSelect;
using dlp::SimTime;
using dlp::SpiKind;
using dlp::SpiRecord;

/// How long an answer may take, and how long somebody may stop reading.
constexpr std::chrono::milliseconds answer_limit{250};
constexpr std::chrono::milliseconds write_limit{2000};
constexpr std::size_t most_waiting = 1UL << 16;

std::string_view text_of(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_host_port(const std::string& where) {
    static const std::regex form(R"((\[[0-9a-fA-F:.%]+\]|[^/:]*):[0-9]+)");
    return std::regex_match(where, form);
}

bool is_pty(const std::string& where) {
    return where == "pty" || where.starts_with("pty=");
}

std::string link_name(const std::string& where) {
    return where.substr(std::min<std::size_t>(where.size(), 4));
}

}  // namespace

std::string SpiPort::file_of(const std::string& where) {
    return is_pty(where) ? link_name(where) : is_host_port(where) ? std::string() : where;
}

SpiPort::SpiPort(const std::string& where, SimTime start, OnTrouble on_trouble)
    : path_(where), on_trouble_(std::move(on_trouble)) {
    if (is_pty(where)) {
        stream_ = link::make_direct_pty(link_name(where));
    } else if (is_host_port(where)) {
        stream_ = link::make_direct_tcp(where);
    } else if (where.ends_with(".pcapng")) {
        capture_.emplace(where, start, on_trouble_,
                         record::pcapng_user_head("spi", "the wires to the UV panel"), write_limit);
    } else {
        file_.emplace(where, fmt::format("The file {} of the panel's wires", where), write_limit);
    }
    if (stream_) {
        path_ = stream_->path();
    }
}

SpiPort::~SpiPort() {
    on_trouble_ = [](std::string_view) {};
    flush();
}

void SpiPort::finish() {
    flush();
    if (capture_) {
        capture_->finish();
    }
    if (const std::string why = file_ ? file_->finish() : std::string(); !why.empty()) {
        on_trouble_(fmt::format("{} is not whole ({}).", path_, why));
    }
}

nlohmann::ordered_json SpiPort::ready() const {
    return {{"link", stream_ ? stream_->kind() : "file"}, {"path", path_}};
}

std::string SpiPort::network_path() const {
    return stream_ && stream_->kind() == "tcp" ? path_ : std::string();
}

// What the board says.
// -----------------------------------------------------------------------------------------------

void SpiPort::tell(SpiRecord record) {
    record.at = last_ = std::max(last_, record.at);
    if (capture_) {
        capture_->block(record::pcapng_user_packet(capture_->start() + record.at, record.kind != SpiKind::in,
                                                   dlp::spi_bytes(record)));
        return;
    }
    waiting_ += dlp::spi_bytes(record);
    if (waiting_.size() >= most_waiting) {
        flush();
    }
}

void SpiPort::flush() {
    if (file_) {
        if (const std::string why = file_->append(waiting_); !why.empty()) {
            on_trouble_(fmt::format("{} cannot be written to ({}); the records end here.", path_, why));
        }
    } else if (stream_) {
        const bool up = stream_->up();
        if (up && !stream_->write(waiting_, write_limit) && was_up_) {
            on_trouble_(fmt::format("whoever is at {} does not read; records are lost.", path_));
        }
        if (was_up_ && !stream_->up()) {
            pins_.awaited = bytes_.awaited = ids_.awaited = false;
            splitter_ = {};
        }
        was_up_ = stream_->up();
    }
    waiting_.clear();
}

void SpiPort::transfer(SimTime now, ChipSelect chip, std::span<const std::uint8_t> out,
                       std::span<std::uint8_t> in) {
    ++number_;
    tell({SpiKind::out, chip, false, number_, now, std::string(text_of(out))});
    const bool asks_byte = chip == ChipSelect::fpga && in.size() == 3 && out[0] != 0;
    const bool asks_id = chip != ChipSelect::fpga && out[0] == dlp::id_register;
    if ((asks_byte && ask(bytes_, in)) || (asks_id && ask(ids_, in))) {
        return;
    }
    if (std::any_of(in.begin(), in.end(), [](std::uint8_t byte) { return byte != 0; })) {
        tell({SpiKind::in, chip, false, number_, now, std::string(text_of(in))});
    }
}

bool SpiPort::ask(Answers& answers, std::span<std::uint8_t> in) {
    flush();
    hear();
    const bool there = answers.awaited;
    const auto answer = await(answers);
    if (answer && answer->data.size() == in.size()) {
        std::copy(answer->data.begin(), answer->data.end(), in.begin());
        return true;
    }
    if (there && answers.of_controllers) {  // who plays the panel and says nothing has no controllers
        answers.awaited = stream_->up();
        std::fill(in.begin(), in.end(), std::uint8_t{0});
        return true;
    }
    return false;
}

bool SpiPort::pin(SimTime now, bool good) {
    if (pins_.awaited) {
        flush();
        if (const auto answer = await(pins_)) {
            return answer->level;
        }
    }
    if (good != told_pin_) {
        told_pin_ = good;
        tell({SpiKind::pin, ChipSelect::fpga, good, number_, now, {}});
    }
    return good;
}

void SpiPort::reset(SimTime now, bool low) {
    tell({SpiKind::reset, ChipSelect::fpga, !low, number_, now, {}});
    flush();
    hear();
}

// What the other end says.
// -----------------------------------------------------------------------------------------------

void SpiPort::hear(const SpiRecord& record) {
    for (Answers* answers : {&pins_, &bytes_, &ids_}) {
        if (answers->takes(record)) {
            answers->awaited = true;
            // One to an earlier transfer comes too late.
            if (record.number == number_) answer_ = record;
        }
    }
}

/// What has come so far.
void SpiPort::hear() {
    std::array<char, 4096> room{};
    for (std::size_t size = room.size(); stream_ && size == room.size();) {
        size = stream_->read(room, std::chrono::milliseconds{0});
        splitter_.feed({room.data(), size});
        while (const auto record = splitter_.next()) {
            hear(*record);
        }
    }
}

std::optional<SpiRecord> SpiPort::await(Answers& answers) {
    const auto is_it = [&] { return answer_ && answers.takes(*answer_) && answer_->number == number_; };
    const auto until = std::chrono::steady_clock::now() + answer_limit;
    while (answers.awaited && !is_it()) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
        std::array<char, 4096> room{};
        const std::size_t size = left.count() > 0 ? stream_->read(room, left) : 0;
        splitter_.feed({room.data(), size});
        while (const auto record = splitter_.next()) {
            hear(*record);
        }
        if (size == 0 && !is_it()) {
            answers.awaited = false;
            on_trouble_(
                fmt::format("whoever is at {} no longer says {}: {}.", path_, answers.what,
                            answers.of_controllers ? "they are missing" : "that of the made-up FPGA counts"));
        }
    }
    return is_it() ? std::exchange(answer_, std::nullopt) : std::nullopt;
}

}  // namespace fauxboard::tools
