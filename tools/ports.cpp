// `fauxboard ports`: the serial ports of this computer.

#include "emulator/link/ports.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"
#include "emulator/link/link.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using link::PortInfo;

std::string usb_id(const PortInfo& port) {
    return port.usb_vid < 0 ? "-" : fmt::format("{:04x}:{:04x}", port.usb_vid, port.usb_pid);
}

std::string table(const std::vector<PortInfo>& ports) {
    if (ports.empty()) {
        return "This computer has no serial port. A USB-TTL adapter would show up here.\n";
    }
    std::string text = fmt::format("{:<20}  {:<9}  {:<4}  {}\n", "DEVICE", "USB", "OPEN", "DESCRIPTION");
    bool closed = false;
    for (const PortInfo& port : ports) {
        // The texts come from a device's own memory: no escape sequences for the terminal.
        text += fmt::format("{:<20}  {:<9}  {:<4}  {}\n", behaviour::as_ascii(port.name), usb_id(port),
                            port.accessible ? "yes" : "no", behaviour::as_ascii(port.description));
        closed = closed || !port.accessible;
    }
    if (closed) {
        text +=
            "\"no\": this user may not open it; mostly: sudo usermod -aG dialout $USER, and log in again.\n";
    }
    return text;
}

std::string json(const std::vector<PortInfo>& ports) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const PortInfo& port : ports) {
        nlohmann::ordered_json entry{{"device", port.name},
                                     {"transport", port.transport},
                                     {"description", port.description},
                                     {"manufacturer", port.manufacturer},
                                     {"product", port.product},
                                     {"serial", port.serial},
                                     {"accessible", port.accessible}};
        if (port.usb_vid >= 0) {
            entry["usb"] = usb_id(port);
        }
        list.push_back(std::move(entry));
    }
    return list.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

ExitCode ports(bool as_json) {
    try {
        const std::vector<PortInfo> list = link::list_ports();
        print(as_json ? json(list) : table(list));
        return ExitCode::ok;
    } catch (const link::LinkError& error) {
        return complain("ports", ExitCode::no_port, error.what());
    }
}

}  // namespace

void add_ports(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("ports", "List the serial ports of this computer");
    const auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "As a JSON array");
    command->callback([as_json, &exit] { exit = ports(*as_json); });
}

}  // namespace fauxboard::tools
