// `fauxboard decode` of what `run --spi` wrote: every packet and command on the wires to a UV panel.

#include "tools/decode_spi.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "emulator/dlp/spi_frames.h"
#include "tools/batch.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using dlp::SpiKind;
using dlp::SpiRecord;
using dlp::SpiWords;

std::string_view chip_of(const SpiRecord& record) {
    constexpr std::array<std::string_view, 3> names{"fpga", "left", "right"};
    return names[static_cast<std::size_t>(record.chip)];
}

std::string_view from_of(const SpiRecord& record) {
    return record.kind == SpiKind::out || record.kind == SpiKind::reset ? "board" : "panel";
}

std::string text_line(const SpiRecord& record, const SpiWords& words) {
    return fmt::format("{} {:12.6f}  {:<5}  {:<5}  {:<9}  {}\n", words.wrong ? '!' : ' ',
                       machine::to_seconds(record.at), from_of(record), chip_of(record), words.what,
                       words.words);
}

std::string json_line(const SpiRecord& record, const SpiWords& words) {
    std::string bytes;
    for (const char byte : record.data) {
        bytes += fmt::format("{:02x}", static_cast<unsigned char>(byte));
    }
    nlohmann::ordered_json line{{"t", machine::to_seconds(record.at)},
                                {"from", from_of(record)},
                                {"chip", chip_of(record)},
                                {"number", record.number},
                                {"what", words.what},
                                {"words", words.words},
                                {"wrong", words.wrong}};
    if (!bytes.empty()) line["bytes"] = bytes;
    return line.dump() + "\n";
}

}  // namespace

bool is_spi(std::istream& in) {
    return in.peek() == dlp::spi_mark;
}

ExitCode decode_spi(std::istream& in, const std::string& name, bool json) {
    dlp::SpiSplitter splitter;
    Batch batch;
    std::size_t records = 0;
    std::array<char, 1UL << 16> room{};
    while (in) {
        // What is there is told before more is waited for.
        in.read(room.data(),
                std::max<std::streamsize>(1, std::min<std::streamsize>(in.rdbuf()->in_avail(), room.size())));
        splitter.feed({room.data(), static_cast<std::size_t>(in.gcount())});
        while (const auto record = splitter.next()) {
            const SpiWords words = dlp::words_of(*record);
            ++records;
            if (!batch.add(json ? json_line(*record, words) : text_line(*record, words),
                           in.rdbuf()->in_avail() <= 0)) {
                return ExitCode::ok;
            }
        }
    }
    batch.flush();
    if (splitter.skipped() + splitter.waiting() != 0) {
        return complain("decode", records == 0 ? ExitCode::bad_input : ExitCode::failed,
                        fmt::format("{}: {} bytes are no records, or half of one.", name,
                                    splitter.skipped() + splitter.waiting()));
    }
    return ExitCode::ok;
}

}  // namespace fauxboard::tools
