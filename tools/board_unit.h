#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emulator/board/board.h"
#include "emulator/control/display.h"
#include "emulator/host/clock.h"
#include "emulator/host/control_server.h"
#include "emulator/host/eeprom_cells_file.h"
#include "emulator/host/eeprom_file.h"
#include "emulator/host/fault_watch.h"
#include "emulator/host/faulty_link.h"
#include "emulator/host/folder_card.h"
#include "emulator/host/job_place_file.h"
#include "emulator/host/line_faults.h"
#include "emulator/host/live_board.h"
#include "emulator/host/live_target.h"
#include "emulator/host/network_line.h"
#include "emulator/host/screen_plug.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/udp_socket.h"
#include "emulator/machine/memory_volume.h"
#include "emulator/script/scenario.h"
#include "emulator/touch/touch_screen.h"
#include "tools/panel_folder.h"
#include "tools/run_options.h"
#include "tools/spi_port.h"

namespace fauxboard::tools {

/// One board with its lines, disks, clock and control channel: what a run has once, and a fleet many times.
/// Use: set_up(), perhaps open_target(), open(), start(); close() at the end.
class BoardUnit {
  public:
    /// All outlive this; `scenario` may be null. `observers` are told what passes; those that are to see it
    /// from the beginning are among them by then.
    BoardUnit(link::EventLoop& loop, const RunOptions& options,
              std::shared_ptr<const behaviour::Profile> profile, const script::Scenario* scenario,
              host::Observers& observers);
    BoardUnit(const BoardUnit&) = delete;
    BoardUnit& operator=(const BoardUnit&) = delete;

    /// Makes the board, its disks and its line. Throws HostError, LinkError, FaultSpecError.
    void set_up();
    /// Lets clients reach in: by the control channel, if the options name one, and whoever asks for target().
    /// `quit` ends the run.
    void open_target(std::function<void()> quit);
    /// Opens what leads out of the process. Throws LinkError.
    void open();
    /// {"profile", "link", "path", ...} as `ready` tells them.
    nlohmann::ordered_json ready() const;
    /// `on_end` is called once, after `duration` of virtual time.
    void start(machine::SimTime duration, std::function<void()> on_end);
    void reload(std::shared_ptr<const behaviour::Profile> profile);
    void close();
    /// Counters and faults, a sentence each; line ends included.
    std::string summary() const;

    void say(board::Level level, std::string_view text);
    const std::shared_ptr<const behaviour::Profile>& profile() const { return profile_; }
    board::Board& board() { return *board_; }
    host::LiveBoard& live() { return *live_; }
    host::FaultyLink& link() { return *link_; }
    /// Of both lines.
    host::LineFaults& faults() { return *faults_; }
    host::Clock& clock() { return *clock_; }
    host::ScreenPlug* plug() { return plug_ ? &*plug_ : nullptr; }
    /// What shows the board to a person; null when nothing does.
    control::Display* display() { return display_.get(); }
    /// Null before open_target().
    host::LiveTarget* target() { return target_ ? &*target_ : nullptr; }
    /// Who binds beyond this computer may not know that anybody can then drive the board. `web`: the address
    /// of the page that shows it; empty for none.
    void warn_of_network(const std::string& web);
    /// " on ..., its USB port on ...", for people.
    std::string where() const;

  private:
    /// Of its lines, those that are sockets: where they listen.
    std::vector<std::string> network_paths() const;
    void set_up_disks(machine::Services& services);
    void set_up_memory(machine::Services& services);
    void set_up_panel();
    void add_faults();
    void tell_of_faults();
    std::string line_summary() const;
    bool is_for_a_screen() const;
    link::Link& make_wire();
    /// A board that can do without its screen has no line for one when only its USB side was asked for.
    bool has_main_line() const {
        return !profile_->line.none &&
               (options_.line_given || !options_.host.wanted() || !profile_->line.optional);
    }
    std::unique_ptr<link::Link> make_link();
    std::unique_ptr<link::Link> make_host_link();

    link::EventLoop& loop_;
    const RunOptions& options_;
    std::shared_ptr<const behaviour::Profile> profile_;
    const script::Scenario* scenario_;
    host::Observers& observers_;
    std::optional<host::FolderCard> card_;
    std::optional<host::FolderCard> udisk_;
    std::optional<machine::MemoryVolume> scenario_card_;
    std::optional<host::EepromFile> eeprom_;
    std::optional<host::EepromCellsFile> eeprom_cells_;
    std::optional<host::JobPlaceFile> job_place_;
    std::optional<PanelFolder> panel_folder_;
    std::optional<SpiPort> spi_;
    std::unique_ptr<host::Clock> clock_;
    std::unique_ptr<link::Link> wire_;  ///< the line as it is, if it leads out of this process
    std::optional<host::ScreenPlug> plug_;
    std::optional<host::FaultyLink> link_;
    std::unique_ptr<link::Link> host_wire_;  ///< the board's USB port as it is
    std::optional<host::FaultyLink> host_link_;
    std::optional<host::LineFaults> faults_;
    std::vector<std::string> broken_from_start_;  ///< faults of the printer, told when it starts
    std::optional<host::FaultWatch> fault_watch_;
    std::unique_ptr<host::Alarm> fault_alarm_;  ///< when a fault of the printer begins or ends
    std::optional<touch::TouchScreen> screen_;  ///< part of the board
    std::optional<board::Board> board_;
    std::optional<host::LiveBoard> live_;
    std::unique_ptr<control::Display> display_;
    std::unique_ptr<link::UdpSocket> udp_;
    std::optional<host::NetworkLine> network_;
    std::optional<host::LiveTarget> target_;
    std::optional<host::ControlServer> control_;
};

}  // namespace fauxboard::tools
