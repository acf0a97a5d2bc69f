#pragma once

#include <vector>

#include "emulator/fault/fault_control.h"
#include "emulator/fault/faults.h"

namespace fauxboard::testing {

/// Faults without a line: they count, and spoil nothing. Time stands still.
struct LooseFaults final : fault::FaultControl {
    fault::Faults all;
    fault::FaultId add(const fault::FaultSpec& spec) override { return all.add({}, spec); }
    bool change(fault::FaultId id, const fault::FaultSpec& spec) override { return all.change({}, id, spec); }
    bool remove(fault::FaultId id) override { return all.remove({}, id); }
    void clear() override { all.clear({}); }
    std::vector<fault::FaultStatus> list() const override { return all.list({}); }
};

}  // namespace fauxboard::testing
