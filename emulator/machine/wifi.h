#pragma once

#include <string>

namespace fauxboard::machine {

/// The board's network (wifi.*) as it shows it. Plain state: something sets it, something shows it.
struct Wifi {
    bool module = false;
    bool enabled = false, auto_connect = false, access_point = false;
    int server_state = 0, signal = 0, router_state = 0;
    std::string router_ip, ssid, server_ip;
};

}  // namespace fauxboard::machine
