// Card, job, USB side, network and the board itself.

#include <array>
#include <cmath>
#include <vector>

#include "emulator/behaviour/field_rows.h"
#include "emulator/behaviour/field_tables.h"
#include "emulator/machine/card_names.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum FieldType;
using machine::Machine;

constexpr FieldRows<Machine> row;

constexpr std::array table{
    row.shown("card.code", integer, "",
              "SD of L2: 0 card, 1 none, 2 failed; plus 16, 32 for the U-disk where there is a port",
              [](const Machine& p) { return p.disk_code(); }),
    row.shown("card.usable", boolean, "", "the chosen disk is there and works",
              [](const Machine& p) { return p.storage.usable(p.storage.chosen()); }),
    row.shown("card.chosen", integer, "", "disk chosen by M2115: 0 SD card, 1 U-disk",
              [](const Machine& p) { return p.storage.chosen(); }),
    row.shown("card.entries", integer, "", "entries of the folder shown",
              [](const Machine& p) {
                  std::vector<machine::CardEntry> entries;
                  p.storage.listing(entries, p.config().card.max_listed);
                  return entries.size();
              }),
    row.shown("card.news", boolean, "",
              "a card was read in or taken out, and its list not told since (card.told)",
              [](const Machine& p) { return p.card_news(); }),
    row.shown("card.folder", text, "", "folder shown, empty at the root",
              [](const Machine& p) { return std::string_view{p.storage.folder()}; }),
    row.shown(
        "job.status", integer, "",
        "PS of L3: 0 idle, 1 printing, 2 paused, 3 recovery, 4 finished (0 where machine.job.ends_idle)",
        [](const Machine& p) {
            const bool ended = p.job.status() == machine::JobStatus::finished && p.config().ends_idle;
            return ended ? 0 : static_cast<int>(p.job.status());
        }),
    row.shown("job.ending", boolean, "", "the job is at its end, and not closed yet",
              [](const Machine& p) { return p.job.status() == machine::JobStatus::finished; }),
    row.shown("job.volume", integer, "", "VL of L3: disk the job is on, 0 SD card, 1 U-disk",
              [](const Machine& p) { return p.job.volume(); }),
    row.shown("job.path", text, "", "file selected, relative to its disk",
              [](const Machine& p) { return std::string_view{p.job.path()}; }),
    row.shown("job.name", text, "", "last part of job.path",
              [](const Machine& p) {
                  const std::string_view path = p.job.path();
                  return path.substr(path.rfind('/') + 1);
              }),
    row.shown("job.shown_path", text, "",
              "FN of L3: the file that is printed, or was last; it stays when the print is over",
              [](const Machine& p) { return std::string_view{p.job.shown()}; }),
    row.shown("job.called", text, "", "the file selected as the card's list calls it",
              [](const Machine& p) { return std::string_view{p.job.called()}; }),
    row.shown("job.long_name", text, "",
              "the last part of job.path, where the list calls it otherwise; else empty",
              [](const Machine& p) {
                  const std::string_view path = p.job.path();
                  const std::string_view name = path.substr(path.rfind('/') + 1);
                  return machine::same_letters(name, p.job.called()) ? std::string_view{} : name;
              }),
    row.shown("job.selected", boolean, "", "a file is selected",
              [](const Machine& p) { return p.job.selected(); }),
    row.shown("job.pausing", boolean, "", "a pause was asked for and the head is on its way to park",
              [](const Machine& p) { return p.job.pausing(); }),
    row.shown("job.active", boolean, "", "a job prints or is paused",
              [](const Machine& p) { return p.job.active(); }),
    row.shown("job.progress", integer, "%", "PG of L3",
              [](const Machine& p) { return p.job.progress_percent(); }),
    row.shown("job.progress_exact", number, "%", "the same, with its decimals",
              [](const Machine& p) { return p.job.progress(); }),
    row.shown("job.shown_seconds", integer, "s", "job.seconds; of the print before, when there is none",
              [](const Machine& p) {
                  return static_cast<double>(p.job.shown_elapsed(p.now()) / std::chrono::seconds(1));
              }),
    row.shown("job.seconds", integer, "s", "TM of L3: time printed, pauses left out",
              [](const Machine& p) {
                  return static_cast<double>(p.job.elapsed(p.now()) / std::chrono::seconds(1));
              }),
    row.plain("job.layer", integer, "", 0, 1e6, "LA of L3", FAUXBOARD_PLACE(job.layer)),
    row.plain("job.layers", integer, "", 0, 1e6, "LC of L3", FAUXBOARD_PLACE(job.layers)),
    row.shown("job.byte", integer, "bytes", "position in the file, 0 when idle",
              [](const Machine& p) { return p.job.byte(); }),
    row.shown("job.bytes", integer, "bytes", "size of the file, 0 when idle",
              [](const Machine& p) { return p.job.bytes(); }),
    row.shown("job.file_bytes", integer, "bytes", "size of the file selected, whatever the job's state",
              [](const Machine& p) { return p.job.file_bytes(); }),
    row.shown("job.estimate", integer, "s",
              "how long the slicer thinks the print takes, 0 when it did not say",
              [](const Machine& p) { return std::floor(p.job.estimate_s); }),
    row.shown("job.message", text, "", "text of the last M117 in the file",
              [](const Machine& p) { return std::string_view{p.job.message}; }),
    row.shown("job.waits_for_user", boolean, "", "the file has come to an M0, M1 or M600 and waits",
              [](const Machine& p) { return p.job.waits_for_user; }),
    row.plain("wifi.module", boolean, "", 0, 1, "a WiFi module is fitted (WF)", FAUXBOARD_PLACE(wifi.module)),
    row.plain("wifi.enabled", boolean, "", 0, 1, "WiFi is on (WT)", FAUXBOARD_PLACE(wifi.enabled)),
    row.plain("wifi.auto_connect", boolean, "", 0, 1, "connects by itself (CF)",
              FAUXBOARD_PLACE(wifi.auto_connect)),
    row.plain("wifi.access_point", boolean, "", 0, 1, "is being set up as an access point (AP)",
              FAUXBOARD_PLACE(wifi.access_point)),
    row.plain("wifi.server", integer, "", 0, 2, "server: 0 closed, 1 opening, 2 connected (SS)",
              FAUXBOARD_PLACE(wifi.server_state)),
    row.plain("wifi.signal", integer, "", 0, 5, "signal strength (RS)", FAUXBOARD_PLACE(wifi.signal)),
    row.plain("wifi.router", integer, "", 0, 2, "router: 0 closed, 1 opening, 2 gave an address (RE)",
              FAUXBOARD_PLACE(wifi.router_state)),
    row.plain("wifi.router_ip", text, "", 0, 39, "address from the router (RI)",
              FAUXBOARD_PLACE(wifi.router_ip)),
    row.plain("wifi.ssid", text, "", 0, 39, "network name (RA)", FAUXBOARD_PLACE(wifi.ssid)),
    row.plain("wifi.server_ip", text, "", 0, 39, "address of the server (SA)",
              FAUXBOARD_PLACE(wifi.server_ip)),
    row.shown("identity.device_name", text, "", "DN of L9",
              [](const Machine& p) { return std::string_view{p.config().identity.device_name}; }),
    row.shown("identity.model", text, "", "DM of L9",
              [](const Machine& p) { return std::string_view{p.config().identity.model}; }),
    row.shown("identity.serial_number", text, "", "SN of L9",
              [](const Machine& p) { return std::string_view{p.config().identity.serial_number}; }),
    row.shown("identity.firmware", text, "", "FV of L9",
              [](const Machine& p) { return std::string_view{p.config().identity.firmware}; }),
    row.shown("identity.volume", text, "", "PV of L9",
              [](const Machine& p) { return std::string_view{p.config().identity.volume_text}; }),
    row.shown("identity.hardware", text, "", "HV of L9",
              [](const Machine& p) { return std::string_view{p.config().identity.hardware}; }),
    row.shown("board.seconds", number, "s", "time since the board's world began",
              [](const Machine& p) { return machine::to_seconds(p.now()); }),
};

}  // namespace

std::span<const Field> device_fields() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
