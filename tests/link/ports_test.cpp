#include "emulator/link/ports.h"

#include <doctest/doctest.h>

#include "emulator/link/serial_api.h"
#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;

namespace {

PortInfo port(const std::string& name, const std::string& transport, const std::string& description = "") {
    PortInfo info;
    info.name = name;
    info.transport = transport;
    info.description = description;
    return info;
}

}  // namespace

TEST_CASE("ports: listing what this computer has works") {
    for (const PortInfo& info : list_ports()) {
        CHECK_FALSE(info.name.empty());
        CHECK((info.transport == "usb" || info.transport == "native" || info.transport == "bluetooth"));
    }
}

TEST_CASE("ports: a list that cannot be had is a sentence") {
    SerialApi api;
    api.list_ports = [](sp_port***) { return SP_ERR_MEM; };
    CHECK(contains(link_error([&] { list_ports(api); }), "cannot be listed"));
}

TEST_CASE("ports: what the library knows of a port is passed on, what it does not know is empty") {
    SerialApi api;
    api.list_ports = [](sp_port*** list) {
        static sp_port* ports[2];
        ports[0] = reinterpret_cast<sp_port*>(ports);
        *list = ports;
        return SP_OK;
    };
    api.free_port_list = [](sp_port**) {};
    static char name[] = "/dev/ttyUSB7";
    api.get_port_name = [](const sp_port*) -> char* { return name; };
    api.get_port_description = [](const sp_port*) -> char* { return nullptr; };
    api.get_port_transport = [](const sp_port*) { return SP_TRANSPORT_USB; };
    api.get_port_usb_vid_pid = [](const sp_port*, int* vid, int* pid) {
        *vid = 0x1a86;
        *pid = 0x7523;
        return SP_OK;
    };
    api.get_port_usb_manufacturer = api.get_port_description;
    api.get_port_usb_product = api.get_port_description;
    api.get_port_usb_serial = api.get_port_description;
    SUBCASE("known") {
        const auto ports = list_ports(api);
        REQUIRE(ports.size() == 1);
        CHECK(ports[0].name == "/dev/ttyUSB7");
        CHECK(ports[0].description.empty());
        CHECK(ports[0].usb_vid == 0x1a86);
        CHECK(ports[0].usb_pid == 0x7523);
        CHECK_FALSE(ports[0].accessible);
    }
    SUBCASE("no ids") {
        api.get_port_usb_vid_pid = [](const sp_port*, int* vid, int*) {
            *vid = 5;
            return SP_ERR_SUPP;
        };
        CHECK(list_ports(api).at(0).usb_vid == -1);
    }
}

TEST_CASE("ports: auto takes the only USB adapter there is") {
    CHECK(pick_auto_port({port("/dev/ttyS0", "native"), port("/dev/ttyUSB0", "usb")}) == "/dev/ttyUSB0");
}

TEST_CASE("ports: auto without an adapter says what there is") {
    const std::string none = link_error([] { pick_auto_port(std::vector<PortInfo>{}); });
    CHECK(none ==
          "No USB serial adapter is plugged in; there is no serial port at all. Plug one in, or name the "
          "port to use.");
    const std::string native = link_error([] { pick_auto_port({port("/dev/ttyS0", "native")}); });
    CHECK(contains(native, "there is only /dev/ttyS0"));
}

TEST_CASE("ports: auto with two adapters names both") {
    const std::string error = link_error([] {
        pick_auto_port({port("/dev/ttyUSB0", "usb", "CH340"), port("/dev/ttyACM0", "usb")});
    });
    CHECK(error ==
          "There are 2 USB serial adapters: /dev/ttyUSB0 (CH340), /dev/ttyACM0. Name the one to use.");
}
