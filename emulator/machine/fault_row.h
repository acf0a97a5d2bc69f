#pragma once

#include <type_traits>

#include "emulator/machine/faults.h"

// How a kind writes its rows of faults: their functions see the machine as what it is.
namespace fauxboard::machine {

template <class M, class F>
constexpr auto fault_action() -> void (*)(Machine&, const FaultValues&) {
    if constexpr (std::is_null_pointer_v<F>) {
        return nullptr;
    } else {
        return [](Machine& machine, const FaultValues& values) { F{}(static_cast<M&>(machine), values); };
    }
}

template <class M, class F>
constexpr auto fault_question() -> bool (*)(const Machine&, const FaultValues&) {
    if constexpr (std::is_null_pointer_v<F>) {
        return nullptr;
    } else {
        return [](const Machine& machine, const FaultValues& values) {
            return F{}(static_cast<const M&>(machine), values);
        };
    }
}

/// See FaultInfo. M is the kind's machine: no other one is ever given a fault of the kind.
template <class M, class Begin, class End, class Gone>
constexpr FaultInfo fault_row(std::string_view name, std::string_view help, std::span<const EventId> events,
                              std::string_view back, std::span<const FaultParameter> parameters,
                              SimTime length, Begin, End, Gone) {
    return {name,
            help,
            events,
            back,
            parameters,
            length,
            fault_action<M, Begin>(),
            fault_action<M, End>(),
            fault_question<M, Gone>()};
}

}  // namespace fauxboard::machine
