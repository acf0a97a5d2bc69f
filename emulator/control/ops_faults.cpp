// Faults of the tested line and of the printer behind it, while it runs: the same verbs for both.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "emulator/behaviour/nearest.h"
#include "emulator/control/hub.h"
#include "emulator/control/op_rows.h"
#include "emulator/fault/printer_fault.h"
#include "emulator/fault/spec.h"

namespace fauxboard::control::rows {
namespace {

using enum ParamType;
using machine::Faults;
using machine::Machine;

fault::FaultControl& faults(const Call& call) {
    fault::FaultControl* all = call.target.faults();
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
    std::vector<std::string_view> names;
    for (const machine::FaultInfo* info : machine::fault_rows()) {
        names.push_back(info->name);
    }
    throw ControlError(
        ErrorCode::unknown_fault,
        fmt::format("There is no fault {}; `fauxboard ctl PATH fault list` lists them.", id.dump()),
        id.is_string() ? behaviour::nearest(id.get_ref<const std::string&>(), names) : std::string_view{});
}

fault::FaultId fault_id(const Call& call) {
    const Json& id = call.at("fault");
    if (!id.is_number_unsigned()) {
        unknown_fault(id);
    }
    return id.get<fault::FaultId>();
}

Json add_to_printer(const Call& call, const fault::FaultSpec& spec) {
    unsigned number = 0;
    const machine::FaultRequest request = fault::to_request(spec);
    call.board.tinker(
        call.now, [&](Machine& p) { number = p.faults.add(call.now, request); },
        fault::world_words(request, call.now));
    if (number == 0) {
        std::string why = call.board.machine().faults.refusal(*request.info);
        why.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(why.front())));
        throw ControlError(ErrorCode::refused, why + ".");
    }
    return fault::printer_fault_id(number);
}

/// By id, or all of one kind by its name. False when there is none.
bool remove_from_printer(const Call& call, const std::string& id) {
    const Faults& faults = call.board.machine().faults;
    const machine::FaultInfo* const info = machine::find_fault(id);
    const auto broken = faults.list();
    const auto hit = std::find_if(broken.begin(), broken.end(), [&](const machine::Fault& each) {
        return info != nullptr ? each.request.info == info : fault::printer_fault_id(each.number) == id;
    });
    if (hit == broken.end()) {
        return false;
    }
    const unsigned number = hit->number;
    bool done = false;
    call.board.tinker(
        call.now,
        [&](Machine& p) { done = info != nullptr ? p.faults.remove(*info) != 0 : p.faults.remove(number); },
        fault::world_words_of_mending(faults, number));
    return done;
}

Answer add(const Call& call) {
    return with_spec(call, [&](const fault::FaultSpec& spec) {
        return fault::is_for_printer(spec) ? Json{{"fault", add_to_printer(call, spec)}}
                                           : Json{{"fault", faults(call).add(spec)}};
    });
}

Answer change(const Call& call) {
    const Json& id = call.at("fault");
    if (id.is_string()) {
        return with_spec(call, [&](const fault::FaultSpec& spec) {
            if (!fault::is_for_printer(spec)) {
                throw ControlError(ErrorCode::bad_arguments,
                                   "A fault of the printer can be changed to another of the printer only.");
            }
            if (!remove_from_printer(call, id.get_ref<const std::string&>())) {
                unknown_fault(id);
            }
            return Json{{"fault", add_to_printer(call, spec)}};
        });
    }
    fault::FaultControl& all = faults(call);
    const fault::FaultId number = fault_id(call);
    if (!with_spec(call, [&](const fault::FaultSpec& spec) { return all.change(number, spec); })) {
        unknown_fault(id);
    }
    return Json{{"fault", number}};
}

Answer remove(const Call& call) {
    const Json& id = call.at("fault");
    const bool done = id.is_string() ? remove_from_printer(call, id.get_ref<const std::string&>())
                                     : faults(call).remove(fault_id(call));
    if (!done) {
        unknown_fault(id);
    }
    return Json::object();
}

Answer clear(const Call& call) {
    call.board.tinker(
        call.now, [](Machine& p) { p.faults.clear(); },
        fault::world_words_of_mending(call.board.machine().faults));
    if (fault::FaultControl* all = call.target.faults()) {
        all->clear();
    }
    return Json::object();
}

Answer list(const Call& call) {
    Json out = Json::array();
    if (fault::FaultControl* all = call.target.faults()) {
        for (const fault::FaultStatus& status : all->list()) {
            out.push_back(fault::status_to_json(status));
        }
    }
    call.board.refresh(call.now);
    for (const machine::Fault& each : call.board.machine().faults.list()) {
        out.push_back(fault::printer_fault_to_json(each));
    }
    return Json{{"faults", std::move(out)}};
}

constexpr Param spec_param{"spec", any, true,
                           "the fault, as text (\"garble:to_screen,every=5\", \"jam:at=60s\") or as an "
                           "object; see faults"};
constexpr Param id_param{"fault", any, true,
                         "its id, from faults.add or faults.list: a number of a line's, a text of the "
                         "printer's (\"p1\")"};
constexpr Param gone_param{"fault", any, true,
                           "its id; or a kind of the printer's by name, which takes all of that kind away"};
constexpr std::array add_params{spec_param};
constexpr std::array change_params{id_param, spec_param};
constexpr std::array remove_params{gone_param};

constexpr std::array faults_table{
    Op{"faults.list", "the faults of line and printer, and what each has done or how it stands", {}, list},
    Op{"faults.add", "makes the tested line misbehave, or breaks the printer; answers with the fault's id",
       add_params, add, true},
    Op{"faults.change", "the fault of that id begins anew as another one; one of the printer's gets a new id",
       change_params, change, true},
    Op{"faults.remove", "takes one away; what it held back goes on, what it broke is mended", remove_params,
       remove, true},
    Op{"faults.clear", "takes all away", {}, clear, true},
};

}  // namespace

std::span<const Op> fault_ops() {
    return faults_table;
}

}  // namespace fauxboard::control::rows
