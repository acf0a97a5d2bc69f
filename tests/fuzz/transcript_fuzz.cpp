// Recordings of every form: read, merged, judged, put into words.

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/record/transcript_words.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using record::JudgedLine;
using record::TranscriptEntry;

bool harmless(std::string_view text) {
    return std::none_of(text.begin(), text.end(),
                        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
}

bool one_line(std::string_view text) {
    return !text.empty() && text.back() == '\n' && harmless(text.substr(0, text.size() - 1));
}

/// A timed line as JSON is a recording's line again.
void check_again(const JudgedLine& line, const std::string& json) {
    std::istringstream in(json);
    const auto again = record::TranscriptReader(in, "again").next();
    require(again.has_value(), "the JSON of a line is no line");
    require(again->form == TranscriptEntry::Form::json, "the JSON of a timed line is no recording");
    require(again->bytes == line.entry.bytes, "bytes changed on the way through JSON");
    require(again->from == line.entry.from, "the speaker changed on the way through JSON");
}

std::size_t check_all(std::vector<record::TranscriptReader> readers) {
    static const std::vector<record::LineJudge> judges = record::line_judges();
    record::Transcripts transcripts(std::move(readers));
    std::size_t count = 0;
    while (auto entry = transcripts.next()) {
        ++count;
        const JudgedLine line = record::judge(std::move(*entry), judges);
        const bool bad = line.entry.form == TranscriptEntry::Form::bad;
        require(bad != line.entry.problem.empty(), "a bad line without a sentence, or a good one with");
        require(line.decoded || bad || line.entry.note ||
                    line.entry.from == record::RecordedLine::From::world ||
                    line.entry.from == record::RecordedLine::From::usb || !line.piece.empty(),
                "a line was not taken apart");
        require(one_line(record::text_line(line)), "words that are no line of text");
        const std::string json = record::json_line(line);
        require(one_line(json), "JSON that is no line of text");
        const bool blank = line.entry.bytes.find_first_not_of(" \t") == std::string::npos;
        if (!bad && line.entry.t && *line.entry.t >= machine::SimTime{0} && !blank) {
            check_again(line, json);
        }
    }
    return count;
}

/// Whether some of it may be a host program's own log: what a line is then hangs on those before it.
bool may_be_host_log(std::string_view bytes) {
    constexpr std::array<std::string_view, 4> words{"SENT:", "RECV:", "Send:", "Recv:"};
    return std::any_of(words.begin(), words.end(),
                       [bytes](std::string_view word) { return bytes.find(word) != std::string_view::npos; });
}

std::size_t count_of(const std::vector<std::string>& texts) {
    std::vector<std::istringstream> streams;
    streams.reserve(texts.size());
    std::vector<record::TranscriptReader> readers;
    readers.reserve(texts.size());
    for (const std::string& text : texts) {
        readers.emplace_back(streams.emplace_back(text), "input");
    }
    return check_all(std::move(readers));
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard::fuzz;
    constexpr std::size_t enough = 4096;
    const std::string bytes(data, data + std::min(size, enough));
    const std::size_t whole = count_of({bytes});
    // Two files: the same lines, whatever their order.
    const std::size_t middle = bytes.find('\n', bytes.size() / 2);
    if (middle != std::string::npos && !may_be_host_log(bytes)) {
        const std::string first = bytes.substr(0, middle + 1);
        const std::string second = bytes.substr(middle + 1);
        require(count_of({first, second}) >= whole, "lines got lost between two files");
    }
    return 0;
}
