// Faults of the tested line, while it runs.

#include <fmt/format.h>

#include <array>

#include "emulator/control/hub.h"
#include "emulator/control/op_rows.h"
#include "emulator/fault/spec.h"

namespace fauxboard::control::rows {
namespace {

using enum ParamType;

FaultControl& faults(const Call& call) {
    FaultControl* all = call.target.faults();
    if (all == nullptr) {
        throw ControlError(ErrorCode::not_here, "The line of this run takes no faults.");
    }
    return *all;
}

/// Carries out what takes a spec; its mistakes become errors of the channel.
template <class F>
auto with_spec(const Call& call, F&& use) {
    try {
        return use(fault::fault_from_json(call.at("spec")));
    } catch (const fault::FaultSpecError& error) {
        throw ControlError(ErrorCode::bad_arguments, error.what());
    }
}

[[noreturn]] void unknown_fault(const Json& id) {
    throw ControlError(
        ErrorCode::unknown_fault,
        fmt::format("There is no fault {}; {{\"op\": \"faults.list\"}} lists them.", id.dump()));
}

fault::FaultId fault_id(const Call& call) {
    const Json& id = call.at("fault");
    if (!id.is_number_unsigned()) {
        unknown_fault(id);
    }
    return id.get<fault::FaultId>();
}

Answer add(const Call& call) {
    FaultControl& all = faults(call);
    return with_spec(call, [&](const fault::FaultSpec& spec) { return Json{{"fault", all.add(spec)}}; });
}

Answer change(const Call& call) {
    FaultControl& all = faults(call);
    const fault::FaultId id = fault_id(call);
    if (!with_spec(call, [&](const fault::FaultSpec& spec) { return all.change(id, spec); })) {
        unknown_fault(id);
    }
    return Json{{"fault", id}};
}

Answer remove(const Call& call) {
    FaultControl& all = faults(call);
    const fault::FaultId id = fault_id(call);
    if (!all.remove(id)) {
        unknown_fault(id);
    }
    return Json::object();
}

Answer clear(const Call& call) {
    faults(call).clear();
    return Json::object();
}

Answer list(const Call& call) {
    Json out = Json::array();
    for (const fault::FaultStatus& status : faults(call).list()) {
        out.push_back(fault::status_to_json(status));
    }
    return Json{{"faults", std::move(out)}};
}

constexpr Param spec_param{"spec", any, true,
                           "the fault, as text (\"garble:to_screen,every=5\") or as an object; see faults"};
constexpr Param id_param{"fault", number, true, "its id, from faults.add or faults.list"};
constexpr std::array add_params{spec_param};
constexpr std::array change_params{id_param, spec_param};
constexpr std::array remove_params{id_param};

constexpr std::array table{
    Op{"faults.list", "the faults in force, and what each has done so far", {}, list},
    Op{"faults.add", "makes the tested line misbehave; answers with the fault's id", add_params, add},
    Op{"faults.change", "the fault of that id begins anew as another one", change_params, change},
    Op{"faults.remove", "takes one away; what it held back goes on", remove_params, remove},
    Op{"faults.clear", "takes all away", {}, clear},
};

}  // namespace

std::span<const Op> fault_ops() {
    return table;
}

}  // namespace fauxboard::control::rows
