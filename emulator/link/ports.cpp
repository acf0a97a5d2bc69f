#include "emulator/link/ports.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "emulator/link/serial_api.h"

namespace fauxboard::link {

namespace {

std::string text(const char* string) {
    return string == nullptr ? std::string() : std::string(string);
}

std::string transport_name(sp_transport transport) {
    switch (transport) {
        case SP_TRANSPORT_USB:
            return "usb";
        case SP_TRANSPORT_BLUETOOTH:
            return "bluetooth";
        case SP_TRANSPORT_NATIVE:
            break;
    }
    return "native";
}

PortInfo describe_port(const SerialApi& api, const sp_port* port) {
    PortInfo info;
    info.name = text(api.get_port_name(port));
    info.description = text(api.get_port_description(port));
    info.transport = transport_name(api.get_port_transport(port));
    if (api.get_port_usb_vid_pid(port, &info.usb_vid, &info.usb_pid) != SP_OK)
        info.usb_vid = info.usb_pid = -1;
    info.manufacturer = text(api.get_port_usb_manufacturer(port));
    info.product = text(api.get_port_usb_product(port));
    info.serial = text(api.get_port_usb_serial(port));
    info.accessible = ::access(info.name.c_str(), R_OK | W_OK) == 0;
    return info;
}

std::string names_of(const std::vector<PortInfo>& ports) {
    std::string names;
    for (const PortInfo& port : ports) {
        if (!names.empty()) names += ", ";
        names += port.description.empty() ? port.name : fmt::format("{} ({})", port.name, port.description);
    }
    return names;
}

// The ports there are, as a sentence; for messages about a port that is not there, so it must not fail
// itself.
std::string what_there_is() {
    try {
        const std::vector<PortInfo> ports = list_ports();
        return ports.empty() ? "This computer has no serial port."
                             : fmt::format("There is {}.", names_of(ports));
    } catch (const LinkError&) {
        return {};
    }
}

}  // namespace

std::vector<PortInfo> list_ports(const SerialApi& api) {
    sp_port** list = nullptr;
    if (api.list_ports(&list) != SP_OK || list == nullptr) {
        throw LinkError("The system's serial ports cannot be listed; name the port instead.");
    }
    const std::unique_ptr<sp_port*, decltype(api.free_port_list)> owner(list, api.free_port_list);
    std::vector<PortInfo> ports;
    for (sp_port** port = list; *port != nullptr; ++port)
        ports.push_back(describe_port(api, *port));
    return ports;
}

std::vector<PortInfo> list_ports() {
    return list_ports(SerialApi{});
}

std::string pick_auto_port(const std::vector<PortInfo>& ports) {
    std::vector<PortInfo> adapters;
    for (const PortInfo& port : ports) {
        if (port.transport == "usb") adapters.push_back(port);
    }
    if (adapters.size() == 1) return adapters.front().name;
    if (!adapters.empty()) {
        throw LinkError(fmt::format("There are {} USB serial adapters: {}. Name the one to use.",
                                    adapters.size(), names_of(adapters)));
    }
    throw LinkError(fmt::format(
        "No USB serial adapter is plugged in; {}. Plug one in, or name the port to use.",
        ports.empty() ? "there is no serial port at all" : fmt::format("there is only {}", names_of(ports))));
}

std::string pick_auto_port() {
    return pick_auto_port(list_ports());
}

std::string explain_port_error(const std::string& device, const std::string& attempt, int error) {
    switch (error) {
        case ENOENT:
            return fmt::format("There is no serial port {}. {}", device, what_there_is());
        case EACCES:
        case EPERM:
            return fmt::format(
                "{} may not be opened by this user (permission denied). Add yourself to the group that owns "
                "it "
                "(mostly: sudo usermod -aG dialout $USER, then log in again), or give it away by a udev "
                "rule.",
                device);
        case EBUSY:
            return fmt::format("{} is in use by another program. End that program, or name another port.",
                               device);
        default:
            break;
    }
    return fmt::format("{} cannot {}: {}.", device, attempt, std::system_category().message(error));
}

}  // namespace fauxboard::link
