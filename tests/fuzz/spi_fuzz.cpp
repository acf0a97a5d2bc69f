// Arbitrary bytes as records on the wires to a UV panel: what a board says there, or somebody answers.
//
// The input is the stream as it stands. Read as answers, the pins and bytes in it are what the board is told.

#include <string>
#include <string_view>
#include <vector>

#include "emulator/dlp/spi_frames.h"
#include "emulator/dlp/uv_panel.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using dlp::SpiRecord;

std::vector<SpiRecord> records_of(std::string_view stream, std::size_t piece) {
    dlp::SpiSplitter splitter;
    std::vector<SpiRecord> out;
    std::size_t whole = 0;
    const std::size_t all = stream.size();
    for (; !stream.empty(); stream.remove_prefix(std::min(piece, stream.size()))) {
        splitter.feed(stream.substr(0, piece));
        while (auto record = splitter.next()) {
            whole += dlp::spi_head_bytes + record->data.size();
            require(record->data.size() <= dlp::spi_most_data, "a record longer than any");
            out.push_back(std::move(*record));
        }
        require(splitter.waiting() < dlp::spi_head_bytes + dlp::spi_most_data, "half a record that grows");
    }
    require(whole + splitter.skipped() + splitter.waiting() == all, "bytes that are nowhere");
    return out;
}

/// Answers as the records say, one after the other, and then as the FPGA does.
class Answering final : public dlp::SpiTap {
  public:
    explicit Answering(const std::vector<SpiRecord>& records) : records_(records) {}
    void transfer(dlp::SimTime, dlp::ChipSelect, std::span<const std::uint8_t>,
                  std::span<std::uint8_t> in) override {
        ++transfers;
        if (const SpiRecord* record = next(); record != nullptr && record->data.size() >= in.size()) {
            std::copy_n(record->data.begin(), in.size(), in.begin());
        }
    }
    bool pin(dlp::SimTime, bool good) override {
        const SpiRecord* record = next();
        return record == nullptr ? good : record->level;
    }
    void reset(dlp::SimTime, bool) override {}
    std::size_t transfers = 0;

  private:
    const SpiRecord* next() { return at_ < records_.size() ? &records_[at_++] : nullptr; }
    const std::vector<SpiRecord>& records_;
    std::size_t at_ = 0;
};

void answer_a_board(const std::vector<SpiRecord>& records) {
    constexpr unsigned lines = 16;
    Answering wires(records);
    dlp::UvPanel panel(1, 2);
    panel.tap = &wires;
    panel.set_up(true, dlp::ms(0));
    panel.begin_picture(0);
    for (unsigned line = 0; line < lines; ++line) {
        dlp::Packet packet{};
        packet[2] = 0xFF;
        panel.send_line(packet, line, dlp::ms(1));
    }
    const unsigned bad = panel.end_picture(dlp::ms(1));
    panel.command(0, true, true, dlp::ms(2));
    require(bad <= lines && panel.counters().failed_lines == bad, "more lines given up than there are");
    require(panel.counters().resends <= 5 * lines, "a line sent more than six times");
    require(wires.transfers <= 4 * 10 + 14 + 6 * lines, "the board never ends");
    require(panel.fpga().lit_pixels(0) == 8 * lines, "a line that came is not kept");
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard::fuzz;
    const std::string input(data, data + std::min<std::size_t>(size, 1U << 16));
    const auto records = records_of(input, 4096);
    const auto again = records_of(input, 7);
    require(records.size() == again.size(), "in pieces the records are others");
    for (std::size_t i = 0; i < records.size(); ++i) {
        const std::string bytes = fauxboard::dlp::spi_bytes(records[i]);
        require(bytes == fauxboard::dlp::spi_bytes(again[i]), "in pieces a record is another one");
        require(input.find(bytes) != std::string::npos, "a record that does not come back as it was");
        const auto words = fauxboard::dlp::words_of(records[i]);
        require(!words.what.empty() && !words.words.empty() && words.words.size() < 200,
                "a record without words");
    }
    answer_a_board(records);
    return 0;
}
