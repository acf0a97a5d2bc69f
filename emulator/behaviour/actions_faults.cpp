// Breaking the machine on purpose, and mending it.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "emulator/behaviour/action_rows.h"
#include "emulator/behaviour/action_tables.h"
#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum ArgType;
using machine::FaultInfo;
using machine::FaultParameter;
using machine::FaultUnit;

const FaultInfo* find(ActionContext& c, std::string_view name) {
    const FaultInfo* info = machine::find_fault(name);
    if (info == nullptr) {
        std::vector<std::string_view> names;
        for (const FaultInfo* each : machine::fault_rows()) {
            names.push_back(each->name);
        }
        const std::string_view near = nearest(name, names);
        refuse(c, "unknown fault of the printer \"" + std::string(name.substr(0, 60)) + '"' +
                      (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
    }
    return info;
}

/// The parameter that takes words, or the one that takes a number, into the request. False, and said why,
/// when there is none or the value is none of it.
bool take_part(ActionContext& c, machine::FaultRequest& request, const Value& v, bool words) {
    if (v.none()) {
        return true;
    }
    const auto& parameters = request.info->parameters;
    const auto hit = std::find_if(parameters.begin(), parameters.end(), [&](const FaultParameter& p) {
        return (p.unit == FaultUnit::choice) == words;
    });
    if (hit == parameters.end()) {
        refuse(c, "the fault " + std::string(request.info->name) + " has no " + (words ? "part" : "value") +
                      " to choose");
        return false;
    }
    double value = v.number;
    bool good = !words && v.is_number() && v.number >= hit->min && v.number <= hit->max;
    for (std::size_t i = 0; words && i < hit->choices.size(); ++i) {
        if (v.text == hit->choices[i]) {
            value = static_cast<double>(i);
            good = true;
        }
    }
    if (!good) {
        refuse(c, std::string(hit->name) + " of the fault " + std::string(request.info->name) +
                      " is out of bounds: " + std::string(hit->help));
        return false;
    }
    request.values[static_cast<std::size_t>(hit - parameters.begin())] = value;
    return true;
}

void fault_set(ActionContext& c, Args a) {
    const FaultInfo* info = find(c, a[0].text);
    if (info == nullptr) {
        return;
    }
    machine::FaultRequest request = machine::default_request(*info);
    if (!take_part(c, request, a[1], true) || !take_part(c, request, a[2], false)) {
        return;
    }
    if (a[3].is_number()) {
        request.length = machine::from_seconds(std::clamp(a[3].number, 1e-6, 1e9));
    }
    if (a[4].is_number()) {
        request.begin = c.machine.now() + machine::from_seconds(std::clamp(a[4].number, 0.0, 1e9));
    }
    if (c.machine.faults.add(c.machine.now(), request) == 0) {
        refuse(c, c.machine.faults.refusal(*info));
    }
}

void fault_clear(ActionContext& c, Args a) {
    if (a[0].none()) {
        c.machine.faults.clear();
    } else if (const FaultInfo* info = find(c, a[0].text)) {
        c.machine.faults.remove(*info);
    }
}

std::optional<std::vector<std::string_view>> fault_names(const machine::MachineConfig&) {
    std::vector<std::string_view> names;
    for (const FaultInfo* each : machine::fault_rows()) {
        names.push_back(each->name);
    }
    return names;
}
constexpr KnownNames known_faults{"fault of the printer", fault_names};

constexpr std::array set_args{
    ArgInfo{"fault", text, true, "its name, of `describe faults`", {}, &known_faults},
    ArgInfo{"part", text, false, "which heater, axis or disk; the first if left out"},
    ArgInfo{"value", number, false, "its number: percent, or C"},
    ArgInfo{"for_s", number, false, "ends after so many seconds; else when it is cleared"},
    ArgInfo{"after_s", number, false, "begins after so many seconds; else at once"}};
constexpr std::array clear_args{
    ArgInfo{"fault", text, false, "its name; all if left out", {}, &known_faults}};

constexpr std::array table{
    ActionInfo{"fault.set", "", "breaks the printer: one of the printer's faults begins", set_args,
               fault_set},
    ActionInfo{"fault.clear", "", "mends it: the faults of that name end", clear_args, fault_clear},
};

}  // namespace

std::span<const ActionInfo> fault_actions() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
