#pragma once

#include "emulator/fault/spec.h"
#include "emulator/machine/faults.h"

namespace fauxboard::fault {

/// Whether it is for the printer behind the board, and not for a line.
bool is_for_printer(const FaultSpec& spec);

/// What the machine is asked for by a spec that is for the printer.
machine::FaultRequest to_request(const FaultSpec& spec);

/// What was done, as recordings hold it (see behaviour::action_words): the action that asks for the same.
std::string world_words(const machine::FaultRequest& request, machine::SimTime now);
/// The same of mending one of them, by its name, or with 0 all; empty when there is nothing to mend.
std::string world_words_of_mending(const machine::Faults& faults, unsigned number = 0);

/// {"id": "p1", "fault": {"kind": "jam", ...}, "state": "active", "begin": 60.0, "over": false}; "begin" in
/// seconds of virtual time.
Json printer_fault_to_json(const machine::Fault& fault);
/// "p1, jam:lost=50".
std::string printer_fault_words(const machine::Fault& fault);
/// "Printer fault p1, jam:lost=50, is in force."
std::string printer_fault_sentence(const machine::Fault& fault);

/// "p1".
std::string printer_fault_id(unsigned number);

}  // namespace fauxboard::fault
