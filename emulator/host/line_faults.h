#pragma once

#include <vector>

#include "emulator/fault/fault_control.h"

namespace fauxboard::host {

/// The faults of all lines of one board under one numbering: each goes to the line that it names.
class LineFaults final : public fault::FaultControl {
  public:
    /// Both outlive this; `usb` may be null: this board has no USB side. Without a main line that leads
    /// anywhere (`has_main` false) a fault that names no line is for the USB side.
    LineFaults(fault::FaultControl& main, fault::FaultControl* usb, bool has_main = true)
        : main_(main), usb_(usb), has_main_(has_main) {}

    /// Throws FaultSpecError, also when the board lacks that line.
    fault::FaultId add(const fault::FaultSpec& asked) override;
    /// Also to another line.
    bool change(fault::FaultId id, const fault::FaultSpec& asked) override;
    bool remove(fault::FaultId id) override;
    void clear() override;
    std::vector<fault::FaultStatus> list() const override;
    /// The id here of a fault that has another one on its own line.
    fault::FaultId known_as(const fault::FaultControl& line, fault::FaultId id_there) const;

  private:
    struct Entry {
        fault::FaultId id;
        fault::FaultControl* line;
        fault::FaultId id_there;
    };
    fault::FaultSpec placed(fault::FaultSpec spec) const;
    fault::FaultControl& line_of(const fault::FaultSpec& spec);
    std::vector<Entry>::iterator find(fault::FaultId id);

    fault::FaultControl& main_;
    fault::FaultControl* usb_;
    bool has_main_;
    std::vector<Entry> entries_;  ///< by id
    fault::FaultId last_id_ = 0;
};

}  // namespace fauxboard::host
