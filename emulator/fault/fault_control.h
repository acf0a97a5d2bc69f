#pragma once

#include <vector>

#include "emulator/fault/faults.h"

namespace fauxboard::fault {

/// A line whose faults can be changed while it is in use.
class FaultControl {
  public:
    virtual ~FaultControl() = default;
    /// Throws FaultSpecError when there is no room for more.
    virtual FaultId add(const FaultSpec& spec) = 0;
    /// The fault begins anew under its id. False when there is none of that id. Throws as add().
    virtual bool change(FaultId id, const FaultSpec& spec) = 0;
    /// False when there is none of that id.
    virtual bool remove(FaultId id) = 0;
    virtual void clear() = 0;
    /// By id.
    virtual std::vector<FaultStatus> list() const = 0;
};

}  // namespace fauxboard::fault
