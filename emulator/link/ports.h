#pragma once

#include <string>
#include <vector>

namespace fauxboard::link {

/// A serial port of this computer. Texts are empty where the system knows nothing.
struct PortInfo {
    std::string name;         ///< "/dev/ttyUSB0"
    std::string description;  ///< "USB Serial - CH340"
    std::string transport;    ///< "usb", "native", "bluetooth"
    int usb_vid = -1;         ///< -1: not a USB device
    int usb_pid = -1;
    std::string manufacturer;
    std::string product;
    std::string serial;
    bool accessible = false;  ///< this user may read and write it
};

/// Every port that the system lists. Throws LinkError when it cannot be asked.
std::vector<PortInfo> list_ports();

/// The name of the only USB serial adapter. Throws LinkError, with what there is and what to do, when there
/// is none or more than one.
std::string pick_auto_port();

}  // namespace fauxboard::link
