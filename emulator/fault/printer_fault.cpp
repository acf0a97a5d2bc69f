// Faults of the printer, told in the same words as those of a line.

#include "emulator/fault/printer_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "emulator/fault/kind.h"

namespace fauxboard::fault {
namespace {

using machine::FaultInfo;
using machine::FaultParameter;
using machine::FaultUnit;

AttributeType type_of(FaultUnit unit) {
    switch (unit) {
        case FaultUnit::choice:
            return AttributeType::choice;
        case FaultUnit::number:
        case FaultUnit::percent:
            return AttributeType::number;
        case FaultUnit::celsius:
            break;
    }
    return AttributeType::temperature;
}

/// The machine's rows as this room has them.
struct Rows {
    std::vector<std::array<Attribute, machine::FaultValues{}.size()>> attributes;
    std::vector<Kind> kinds;
    std::vector<const Kind*> pointers;

    Rows() : attributes(machine::fault_rows().size()), kinds(attributes.size()) {
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const FaultInfo& info = *machine::fault_rows()[i];
            for (std::size_t k = 0; k < info.parameters.size(); ++k) {
                const FaultParameter& p = info.parameters[k];
                attributes[i][k] = {p.name, type_of(p.unit), p.fallback, p.min, p.max, p.help, p.choices};
            }
            kinds[i].name = info.name;
            kinds[i].help = info.help;
            kinds[i].attributes = {attributes[i].data(), info.parameters.size()};
            kinds[i].printer = &info;
            pointers.push_back(&kinds[i]);
        }
    }
    Rows(const Rows&) = delete;
    Rows& operator=(const Rows&) = delete;
};
static_assert(machine::FaultValues{}.size() == 2 && Values::most >= 2, "all values have their place");

FaultSpec to_spec(const machine::FaultRequest& request) {
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

std::string world_words(const machine::FaultRequest& request, machine::SimTime now) {
    nlohmann::ordered_json args{{"fault", request.info->name}};
    const auto& parameters = request.info->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        if (parameters[i].unit == FaultUnit::choice) {
            args["part"] = parameters[i].choices[static_cast<std::size_t>(request.values[i])];
        } else {
            args["value"] = request.values[i];
        }
    }
    const machine::SimTime begin = std::max(request.begin.value_or(now), now);
    const auto length = request.end ? std::optional(*request.end - begin) : request.length;
    if (length) {
        args["for_s"] = machine::to_seconds(*length);
    }
    if (begin > now) {
        args["after_s"] = machine::to_seconds(begin - now);
    }
    return nlohmann::ordered_json{{"fault.set", args}}.dump();
}

std::string world_words_of_mending(const machine::Faults& faults, unsigned number) {
    const auto list = faults.list();
    const auto hit = std::find_if(list.begin(), list.end(), [&](const machine::Fault& each) {
        return number == 0 || each.number == number;
    });
    if (hit == list.end()) {
        return {};
    }
    return number == 0 ? "fault.clear"
                       : nlohmann::ordered_json{{"fault.clear", {{"fault", hit->request.info->name}}}}.dump();
}

bool is_for_printer(const FaultSpec& spec) {
    return spec.kind->printer != nullptr;
}

machine::FaultRequest to_request(const FaultSpec& spec) {
    machine::FaultRequest request;
    request.info = spec.kind->printer;
    for (std::size_t i = 0; i < request.values.size(); ++i) {
        request.values[i] = spec.values.number(i);
    }
    request.begin = spec.trigger.at ? spec.trigger.at : spec.trigger.from;
    request.end = spec.trigger.until;
    request.length = spec.trigger.length;
    return request;
}

Json printer_fault_to_json(const machine::Fault& fault) {
    return {{"id", printer_fault_id(fault.number)},
            {"fault", fault_to_json(to_spec(fault.request))},
            {"state", machine::state_name(fault.state)},
            {"begin", machine::to_seconds(fault.begin)},
            {"over", fault.state == machine::FaultState::over}};
}

std::string printer_fault_words(const machine::Fault& fault) {
    return printer_fault_id(fault.number) + ", " + fault_to_text(to_spec(fault.request));
}

std::string printer_fault_sentence(const machine::Fault& fault) {
    const std::string_view state = fault.state == machine::FaultState::waiting  ? "has not begun"
                                   : fault.state == machine::FaultState::active ? "is in force"
                                                                                : "is over";
    return fmt::format("Printer fault {}, {}.", printer_fault_words(fault), state);
}

std::string printer_fault_id(unsigned number) {
    return fmt::format("p{}", number);
}

}  // namespace fauxboard::fault
