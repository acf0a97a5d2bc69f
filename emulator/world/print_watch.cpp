#include "emulator/world/print_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "emulator/world/invariants.h"

namespace fauxboard::world {
namespace {

constexpr std::array<std::string_view, 2> begins{"job.started", "print.started"};
constexpr std::array<std::string_view, 2> layers{"job.layer_done", "print.exposed"};
constexpr std::array<std::string_view, 2> ends{"job.finished", "print.finished"};

}  // namespace

void PrintWatch::see(machine::EventId event, const machine::Machine& machine) {
    const auto is_one_of = [event](const auto& names) {
        return std::find(names.begin(), names.end(), event->name) != names.end();
    };
    if (is_one_of(begins)) {
        begun_ = true;
        layers_ = 0;
    } else if (is_one_of(layers)) {
        ++layers_;
    } else if (is_one_of(ends)) {
        ended_ = Tally{number_of(machine, "job.moves").value_or(0), layers_};
    }
}

std::vector<std::string> words_to_print(const std::string& file) {
    return {fmt::format(R"({{"resin.print": {{"name": "{}"}}}})", file),
            fmt::format(R"({{"print.start": {{"path": "{}"}}}})", file),
            fmt::format(R"({{"job.select": {{"name": "{}"}}}})", file), "job.start"};
}

}  // namespace fauxboard::world
