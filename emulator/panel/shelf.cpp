#include "emulator/panel/shelf.h"

#include <fmt/format.h>

#include "emulator/link/link.h"

namespace fauxboard::panel {
namespace {

using control::Json;

constexpr std::size_t most_values = 4;

/// "heaters.nozzle.true" is the nozzle, "position.z" z.
std::string_view short_name(std::string_view path) {
    path.remove_prefix(path.find('.') + 1);
    return path.substr(0, path.find('.'));
}

}  // namespace

void ShelfCard::choose(const board::Board& board) {
    chosen_ = true;
    for (control::Place& place : host::curve_places(board)) {
        if (place.field->unit == "%") {
            progress_ = std::move(place);
        } else if (curves_.size() < most_values &&
                   place.field->set == nullptr) {  // what is, not what is asked for
            curves_.push_back(std::move(place));
        }
    }
}

Json ShelfCard::changes(const host::LiveTarget& target) {
    const board::Board& board = target.board();
    if (!chosen_) {
        choose(board);
    }
    std::string words;
    for (const control::Place& place : curves_) {
        const Json value = control::value_of(board, place);
        if (value.is_number()) {
            words += fmt::format("{}{} {:.0f}{}", words.empty() ? "" : " · ", short_name(place.name),
                                 value.get<double>(),
                                 place.field->unit == "C" ? " °C" : " " + std::string(place.field->unit));
        }
    }
    Json now{{"link", link::state_name(target.link_state())},
             {"faults", target.faults_in_force()},
             {"words", words}};
    if (progress_) {
        now["progress"] = control::value_of(board, *progress_);
    }
    Json changed = Json::object();
    for (const auto& [key, value] : now.items()) {
        if (!last_ || (*last_)[key] != value) {
            changed[key] = value;
        }
    }
    if (!changed.empty()) {
        changed["t"] = machine::to_seconds(target.now());
    }
    last_ = std::move(now);
    return changed;
}

}  // namespace fauxboard::panel
