#include "emulator/record/compare_talk.h"

namespace fauxboard::record::detail {

std::optional<std::string> Said::value(std::string_view key) const {
    const protocol::DecodedField* field = decoded.field(key);
    return field != nullptr ? std::optional<std::string>{field->text} : std::nullopt;
}

std::vector<Said> board_talk(const std::vector<RecordedLine>& lines) {
    std::vector<Said> out;
    for (const RecordedLine& line : lines) {
        if (line.from != RecordedLine::From::board) {
            continue;
        }
        Said said;
        said.t = machine::to_seconds(line.t);
        said.line = line.bytes;
        said.decoded = protocol::decode_line(line.bytes, protocol::Direction::to_screen);
        said.code = said.decoded.code_text;
        said.label = said.code;
        // The P of a file list counts its entries; any other says which page of the code it is.
        if (const auto page = said.value("P"); page && said.code != "L7") {
            said.label += " P" + *page;
        }
        out.push_back(std::move(said));
    }
    return out;
}

}  // namespace fauxboard::record::detail
