#pragma once

#include "emulator/machine/events.h"
#include "emulator/machine/job.h"
#include "emulator/machine/sim_time.h"
#include "emulator/machine/storage.h"
#include "emulator/machine/transfer.h"

// What this room's parts work with of the shared room.
namespace fauxboard::resin {

using machine::EventId;
using machine::EventQueue;
using machine::from_seconds;
using machine::Job;
using machine::JobStatus;
using machine::never;
using machine::SimTime;
using machine::Storage;
using machine::to_seconds;
using machine::Transfer;
using machine::Volume;

}  // namespace fauxboard::resin
