#include "emulator/host/talk_keeper.h"

#include <algorithm>

#include "emulator/behaviour/wire_text.h"
#include "protocol/annotate.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

using control::Json;

/// What tells one kind of line from another: its first word, behind a line number.
std::string_view kind_of(std::string_view line) {
    if (line.size() > 2 && line.front() == 'N' && line.find(' ') != std::string_view::npos) {
        line.remove_prefix(line.find(' ') + 1);
    }
    const std::string_view word = line.substr(0, line.find_first_of(" *:"));
    return word.substr(0, 24);
}

bool is_own(std::string_view from) {
    return from == "board" || from == "usb" || from == "module";
}

}  // namespace

void TalkKeeper::add(SimTime now, std::string_view from, std::string_view line, std::string_view refused) {
    if (lines_.size() < most_lines) {
        lines_.emplace_back();
        next_ = lines_.size() - 1;
    }
    Line& slot = lines_[next_];
    next_ = (next_ + 1) % most_lines;
    slot.at = now;
    slot.from = from;
    slot.refused = refused;
    slot.text.assign(line.substr(0, most_bytes));
}

void TalkKeeper::add_said(SimTime now, std::string_view line) {
    add(now, board::own_end(board::Channel::main), line);
    const std::string_view name = kind_of(line);
    auto kind =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& each) { return each.name == name; });
    if (kind == kinds_.end()) {
        if (kinds_.size() < most_kinds) {
            kind = kinds_.emplace(kinds_.end());
        } else {
            kind = std::min_element(kinds_.begin(), kinds_.end(),
                                    [](const Kind& a, const Kind& b) { return a.number < b.number; });
        }
        kind->name.assign(name);
    }
    kind->text.assign(line.substr(0, most_bytes));
    kind->number = ++said_;
}

Json TalkKeeper::to_json() const {
    Json out = Json::array();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Line& line = lines_[lines_.size() < most_lines ? i : (next_ + i) % most_lines];
        const auto direction =
            is_own(line.from) ? protocol::Direction::to_screen : protocol::Direction::to_board;
        const std::string shown = protocol::mask_secrets(line.text);
        Json one{{"t", machine::to_seconds(line.at)},
                 {"from", line.from},
                 {"line", behaviour::from_wire(shown)},
                 {"words", protocol::explain(protocol::decode_line(shown, direction))}};
        if (!line.refused.empty()) {
            one["refused"] = line.refused;
        }
        out.push_back(std::move(one));
    }
    return out;
}

std::vector<std::string> TalkKeeper::last_said() const {
    std::vector<const Kind*> order;
    for (const Kind& kind : kinds_) {
        order.push_back(&kind);
    }
    std::sort(order.begin(), order.end(), [](const Kind* a, const Kind* b) { return a->number < b->number; });
    std::vector<std::string> out;
    for (const Kind* kind : order) {
        out.push_back(kind->text);
    }
    return out;
}

}  // namespace fauxboard::host
