#pragma once

// Internal to emulator/link and its tests.

#include <libserialport.h>

#include <memory>
#include <string>
#include <vector>

#include "emulator/link/link.h"
#include "emulator/link/ports.h"

namespace fauxboard::link {

/// Every function of libserialport that this folder calls. Nothing else calls the library, so that a test can
/// put its own functions here and make each of them fail.
struct SerialApi {
    decltype(&sp_list_ports) list_ports = sp_list_ports;
    decltype(&sp_free_port_list) free_port_list = sp_free_port_list;
    decltype(&sp_get_port_by_name) get_port_by_name = sp_get_port_by_name;
    decltype(&sp_free_port) free_port = sp_free_port;
    decltype(&sp_get_port_name) get_port_name = sp_get_port_name;
    decltype(&sp_get_port_description) get_port_description = sp_get_port_description;
    decltype(&sp_get_port_transport) get_port_transport = sp_get_port_transport;
    decltype(&sp_get_port_usb_vid_pid) get_port_usb_vid_pid = sp_get_port_usb_vid_pid;
    decltype(&sp_get_port_usb_manufacturer) get_port_usb_manufacturer = sp_get_port_usb_manufacturer;
    decltype(&sp_get_port_usb_product) get_port_usb_product = sp_get_port_usb_product;
    decltype(&sp_get_port_usb_serial) get_port_usb_serial = sp_get_port_usb_serial;
    decltype(&sp_open) open = sp_open;
    decltype(&sp_close) close = sp_close;
    decltype(&sp_set_baudrate) set_baudrate = sp_set_baudrate;
    decltype(&sp_set_bits) set_bits = sp_set_bits;
    decltype(&sp_set_parity) set_parity = sp_set_parity;
    decltype(&sp_set_stopbits) set_stopbits = sp_set_stopbits;
    decltype(&sp_set_flowcontrol) set_flowcontrol = sp_set_flowcontrol;
    decltype(&sp_get_port_handle) get_port_handle = sp_get_port_handle;
    decltype(&sp_flush) flush = sp_flush;
    decltype(&sp_nonblocking_read) nonblocking_read = sp_nonblocking_read;
    decltype(&sp_nonblocking_write) nonblocking_write = sp_nonblocking_write;
    decltype(&sp_last_error_code) last_error_code = sp_last_error_code;
};

/// As make_port_link() for a port that is not a pseudo-terminal.
std::unique_ptr<Link> make_serial_link(EventLoop& loop, std::string device, unsigned baud,
                                       const SerialApi& api = {});

/// Every port that `api` lists. Throws LinkError.
std::vector<PortInfo> list_ports(const SerialApi& api);

/// As pick_auto_port(), out of `ports`.
std::string pick_auto_port(const std::vector<PortInfo>& ports);

/// What a system error number of opening or setting up `device` means to a person, as a sentence.
std::string explain_port_error(const std::string& device, const std::string& attempt, int error);

}  // namespace fauxboard::link
