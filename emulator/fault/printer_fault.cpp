// Faults of the printer, told in the same words as those of a line.

#include "emulator/fault/printer_fault.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "emulator/fault/kind.h"

namespace fauxboard::fault {
namespace {

using machine::BreakdownInfo;
using machine::BreakdownParameter;
using machine::BreakdownUnit;

AttributeType type_of(BreakdownUnit unit) {
    switch (unit) {
        case BreakdownUnit::choice:
            return AttributeType::choice;
        case BreakdownUnit::percent:
            return AttributeType::number;
        case BreakdownUnit::celsius:
            break;
    }
    return AttributeType::temperature;
}

/// The machine's rows as this room has them.
struct Rows {
    static constexpr std::size_t count = machine::breakdown_count;
    std::array<std::array<Attribute, 2>, count> attributes{};
    std::array<Kind, count> kinds{};
    std::array<const Kind*, count> pointers{};

    Rows() {
        for (std::size_t i = 0; i < count; ++i) {
            const BreakdownInfo& info = machine::breakdowns()[i];
            for (std::size_t k = 0; k < info.parameters.size(); ++k) {
                const BreakdownParameter& p = info.parameters[k];
                attributes[i][k] = {p.name, type_of(p.unit), p.fallback, p.min, p.max, p.help, p.choices};
            }
            kinds[i].name = info.name;
            kinds[i].help = info.help;
            kinds[i].attributes = {attributes[i].data(), info.parameters.size()};
            kinds[i].printer = &info;
            pointers[i] = &kinds[i];
        }
    }
    Rows(const Rows&) = delete;
    Rows& operator=(const Rows&) = delete;
};
static_assert(machine::BreakdownValues{}.size() == 2 && Values::most >= 2, "all values have their place");

FaultSpec to_spec(const machine::BreakdownRequest& request) {
    FaultSpec spec;
    spec.kind = find_kind(request.info->name);
    for (std::size_t i = 0; i < request.values.size(); ++i) {
        spec.values.set(i, request.values[i]);
    }
    spec.trigger.at = request.begin;
    spec.trigger.until = request.end;
    spec.trigger.length = request.length;
    return spec;
}

}  // namespace

std::span<const Kind* const> printer_kinds() {
    static const Rows rows;
    return rows.pointers;
}

bool is_for_printer(const FaultSpec& spec) {
    return spec.kind->printer != nullptr;
}

machine::BreakdownRequest to_request(const FaultSpec& spec) {
    machine::BreakdownRequest request;
    request.info = spec.kind->printer;
    for (std::size_t i = 0; i < request.values.size(); ++i) {
        request.values[i] = spec.values.number(i);
    }
    request.begin = spec.trigger.at ? spec.trigger.at : spec.trigger.from;
    request.end = spec.trigger.until;
    request.length = spec.trigger.length;
    return request;
}

Json breakdown_to_json(const machine::Breakdown& breakdown) {
    return {{"id", printer_fault_id(breakdown.number)},
            {"fault", fault_to_json(to_spec(breakdown.request))},
            {"state", machine::state_name(breakdown.state)},
            {"begin", machine::to_seconds(breakdown.begin)},
            {"over", breakdown.state == machine::BreakdownState::over}};
}

std::string breakdown_sentence(const machine::Breakdown& breakdown) {
    const std::string_view state = breakdown.state == machine::BreakdownState::waiting  ? "has not begun"
                                   : breakdown.state == machine::BreakdownState::active ? "is in force"
                                                                                        : "is over";
    return fmt::format("Printer fault {}, {}, {}.", printer_fault_id(breakdown.number),
                       fault_to_text(to_spec(breakdown.request)), state);
}

std::string printer_fault_id(unsigned number) {
    return fmt::format("p{}", number);
}

unsigned printer_fault_number(std::string_view id) {
    unsigned number = 0;
    if (!id.starts_with('p')) {
        return 0;
    }
    const char* const end = id.data() + id.size();
    const auto result = std::from_chars(id.data() + 1, end, number);
    return result.ec == std::errc{} && result.ptr == end ? number : 0;
}

}  // namespace fauxboard::fault
