#include "tools/board_unit.h"

#include <fmt/format.h>

#include <utility>

#include "emulator/fault/printer_fault.h"
#include "emulator/host/board_display.h"
#include "emulator/host/screen_files.h"
#include "emulator/link/host_error.h"
#include "emulator/link/ports.h"

namespace fauxboard::tools {

using machine::SimTime;

BoardUnit::BoardUnit(link::EventLoop& loop, const RunOptions& options,
                     std::shared_ptr<const behaviour::Profile> profile, const script::Scenario* scenario,
                     host::Observers& observers)
    : loop_(loop),
      options_(options),
      profile_(std::move(profile)),
      scenario_(scenario),
      observers_(observers),
      clock_(host::make_clock(loop, options.speed)) {}

void BoardUnit::say(board::Level level, std::string_view text) {
    observers_.on_notice(live_ ? live_->now() : SimTime{0}, level, text);
}

// Setting up.
// -----------------------------------------------------------------------------------------------

/// A screen is there when the board starts, and has heard all of it; a host opens its port some time, and
/// hears what comes from then on.
bool BoardUnit::is_for_a_screen() const {
    return profile_->line.peer == "screen";
}

link::Link& BoardUnit::make_wire() {
    if (!options_.screen.empty()) {
        return plug_.emplace(scenario_->cast.screen, *clock_).board_end();
    }
    wire_ = make_link();
    return *wire_;
}

std::unique_ptr<link::Link> BoardUnit::make_link() {
    if (profile_->line.none && options_.line_given) {
        throw link::HostError(fmt::format(
            "The board of the profile {} has no line: leave --port, --pty and --tcp out.", profile_->name));
    }
    if (!has_main_line()) {
        return link::make_no_link();
    }
    if (!options_.tcp.empty()) {
        return link::make_tcp_listen_link(loop_, options_.tcp, is_for_a_screen());
    }
    if (!options_.port.empty()) {
        const std::string port = options_.port == "auto" ? link::pick_auto_port() : options_.port;
        return link::make_port_link(loop_, port, options_.baud != 0 ? options_.baud : profile_->line.baud);
    }
    return link::make_pty_link(loop_, options_.pty_name,
                               {profile_->line.baud, is_for_a_screen(), options_.exact_baud});
}

std::unique_ptr<link::Link> BoardUnit::make_host_link() {
    const HostLine& line = options_.host;
    if (!line.tcp.empty()) {
        return link::make_tcp_listen_link(loop_, line.tcp, false);
    }
    if (!line.port.empty()) {
        return link::make_port_link(loop_, line.port, line.baud);
    }
    return link::make_pty_link(loop_, line.pty_name, {profile_->line.baud, false, options_.exact_baud});
}

void BoardUnit::set_up() {
    machine::Services services;
    set_up_disks(services);
    set_up_memory(services);
    board::Options options;
    options.pacing = options_.pacing;
    options.seed = options_.seed;
    options.observer = &observers_;
    if (!profile_->screen.empty()) {
        options.front = &screen_.emplace(host::load_own_screen(profile_->screen));
    }
    board_.emplace(profile_, services, options);
    set_up_panel();
    board_->connect(board::Channel::main, has_main_line());
    link_.emplace(make_wire(), *clock_, fault::Direction::to_board);
    if (options_.host.wanted()) {
        host_wire_ = make_host_link();
        host_link_.emplace(*host_wire_, *clock_, fault::Direction::to_board);
    }
    faults_.emplace(*link_, host_link_ ? &*host_link_ : nullptr, has_main_line());
    add_faults();
    live_.emplace(*board_, *link_, *clock_, &observers_);
    tell_of_faults();
    if (screen_) {
        display_ = std::make_unique<host::BoardDisplay>(*screen_, *board_);
    } else if (plug_) {
        display_ = std::make_unique<host::PlugDisplay>(*plug_);
    }
}

/// A fault that names no line is for the one that was asked for: the USB side, where only that was.
void BoardUnit::add_faults() {
    const bool usb_alone = host_link_ && !options_.line_given;
    for (const std::string& text : options_.faults) {
        fault::FaultSpec spec = fault::fault_from_text(text);
        if (!spec.line && usb_alone && !fault::is_for_printer(spec)) {
            spec.line = fault::Line::usb;
        }
        if (!fault::is_for_printer(spec)) {
            faults_->add(spec);
            continue;
        }
        const machine::FaultRequest request = fault::to_request(spec);
        if (board_->machine().faults.add(SimTime{0}, request) == 0) {
            throw fault::FaultSpecError({fmt::format("fault \"{}\": {}", text,
                                                     board_->machine().faults.refusal(*spec.kind->printer))});
        }
        broken_from_start_.push_back(fault::world_words(request, SimTime{0}));
    }
}

/// In the log, to clients and wherever else people look: when a fault begins, what it does, when it is over.
void BoardUnit::tell_of_faults() {
    const auto listen = [this](host::FaultyLink& line, board::Channel channel) {
        line.on_deed([this, &line, channel](fault::Deed deed) {
            deed.fault = faults_->known_as(line, deed.fault);
            observers_.on_deed(live_->now(), channel, deed);
        });
    };
    listen(*link_, board::Channel::main);
    if (host_link_) {
        listen(*host_link_, board::Channel::host);
    }
    fault_alarm_ = clock_->make_alarm([this] {
        live_->visit([](board::Board& board, SimTime now) { board.refresh(now); });
        fault_watch_->look();
    });
    observers_.add(fault_watch_.emplace(
        *board_, *faults_,
        [this](const std::string& sentence) { observers_.on_fault(live_->now(), sentence); },
        [this](SimTime when) { fault_alarm_->at(when); }));
}

/// What a board keeps when it is off: some as values, some byte by byte.
void BoardUnit::set_up_memory(machine::Services& services) {
    if (options_.eeprom.empty()) {
        return;
    }
    const auto trouble = [this](std::string_view text) { say(board::Level::error, text); };
    if (profile_->machine->eeprom_bytes != 0) {
        services.eeprom_cells =
            &eeprom_cells_.emplace(options_.eeprom, profile_->machine->eeprom_bytes, trouble);
        return;
    }
    // The place first: it is what tells that another board has both.
    services.job_place = &job_place_.emplace(host::JobPlaceFile::beside(options_.eeprom), trouble);
    services.eeprom = &eeprom_.emplace(options_.eeprom, trouble);
}

void BoardUnit::set_up_panel() {
    if (options_.panel.empty() && options_.spi.empty()) {
        return;
    }
    auto* const machine = machine::as<dlp::Printer>(board_->machine());
    if (machine == nullptr) {
        throw link::HostError(fmt::format(
            "The board of the profile {} has no UV panel: leave --panel and --spi out.", profile_->name));
    }
    const auto trouble = [this](std::string_view text) { say(board::Level::warning, text); };
    if (!options_.panel.empty()) {
        panel_folder_.emplace(options_.panel, trouble);
        panel_folder_->watch(*machine);
        observers_.add(*panel_folder_);
    }
    if (!options_.spi.empty()) {
        const auto start = std::chrono::floor<SimTime>(std::chrono::system_clock::now().time_since_epoch());
        machine->board.panel.tap = &spi_.emplace(options_.spi, start, trouble);
    }
}

void BoardUnit::set_up_disks(machine::Services& services) {
    if (!options_.sd.empty()) {
        services.sd = &card_.emplace(options_.sd);
    } else if (scenario_ != nullptr && scenario_->card) {
        services.sd = &scenario_card_.emplace(*scenario_->card);
    }
    if (!options_.udisk.empty()) {
        if (!profile_->machine->udisk_port) {
            throw link::HostError(
                fmt::format("The board of the profile {} has no port for a U-disk. Leave --udisk out, or say "
                            "\"machine\": {{\"udisk_port\": true}} in a profile of your own that extends it.",
                            profile_->name));
        }
        services.udisk = &udisk_.emplace(options_.udisk, "the U-disk");
    }
}

void BoardUnit::open_target(std::function<void()> quit) {
    target_.emplace(host::LiveTarget::Parts{loop_, *board_, *live_, *clock_, *link_, &*faults_,
                                            std::move(quit), options_.speed.max ? 0 : options_.speed.factor,
                                            plug_ || screen_ ? nullptr : host::screen_of(*profile_),
                                            display_.get(), [this](SimTime now, std::string_view sentence) {
                                                observers_.on_notice(now, board::Level::info, sentence);
                                            }});
    if (plug_) {
        target_->show(*plug_);
    }
    observers_.add(*target_);
    if (!options_.control.empty()) {
        control_.emplace(loop_, target_->hub(),
                         [this](board::Level level, std::string_view text) { say(level, text); });
        control_->open(options_.control);
    }
}

// The run.
// -----------------------------------------------------------------------------------------------

void BoardUnit::open() {
    if (!options_.udp.empty()) {
        udp_ = link::make_udp_socket(loop_, options_.udp);
        udp_->open(network_.emplace(*live_, *udp_, &observers_));
    }
    link_->open(*live_);
    if (host_link_) {
        host_link_->open(live_->attach(board::Channel::host, *host_link_));
    }
}

nlohmann::ordered_json BoardUnit::ready() const {
    nlohmann::ordered_json ready{
        {"profile", profile_->name}, {"link", link_->kind()}, {"path", link_->path()}};
    if (!options_.pty_name.empty()) {
        ready["name"] = options_.pty_name;
    }
    if (host_link_) {
        ready["host"] = {{"link", host_link_->kind()}, {"path", host_link_->path()}};
        if (!options_.host.pty_name.empty()) {
            ready["host"]["name"] = options_.host.pty_name;
        }
    }
    if (control_) {
        ready["control"] = options_.control;
    }
    if (udp_) {
        ready["udp"] = udp_->path();
    }
    if (spi_) {
        ready["spi"] = spi_->ready();
    }
    return ready;
}

std::vector<std::string> BoardUnit::network_paths() const {
    std::vector<std::string> paths;
    if (link_->kind() == "tcp") {
        paths.push_back(link_->path());
    }
    if (host_link_ && host_link_->kind() == "tcp") {
        paths.push_back(host_link_->path());
    }
    if (udp_) {
        paths.push_back(udp_->path());
    }
    if (spi_ && !spi_->network_path().empty()) {
        paths.push_back(spi_->network_path());
    }
    return paths;
}

void BoardUnit::warn_of_network(const std::string& web) {
    std::vector<std::string> paths = network_paths();
    if (constexpr std::string_view scheme = "http://"; web.starts_with(scheme)) {
        paths.push_back(web.substr(scheme.size(), web.find('/', scheme.size()) - scheme.size()));
    }
    for (const std::string& path : paths) {
        if (link::reaches_network(path)) {
            say(board::Level::warning,
                fmt::format("{} can be reached from other computers; whoever reaches it can drive this board",
                            path));
        }
    }
}

std::string BoardUnit::where() const {
    return " on " + link_->describe() +
           (host_link_ ? ", its USB port on " + host_link_->describe() : std::string());
}

void BoardUnit::start(SimTime duration, std::function<void()> on_end) {
    for (const std::string& words : broken_from_start_) {
        observers_.on_world(SimTime{0}, words);
    }
    live_->start(duration, std::move(on_end));
    if (plug_) {
        plug_->start();
    }
}

void BoardUnit::reload(std::shared_ptr<const behaviour::Profile> profile) {
    profile_ = profile;
    live_->reload(std::move(profile));
    if (target_) {
        target_->on_reload();
    }
}

void BoardUnit::close() {
    fault_watch_->look();
    if (control_) {
        control_->close();
    }
    if (udp_) {
        udp_->close();
    }
    link_->close();
    if (plug_) {
        plug_->close();
    }
    if (host_link_) {
        host_link_->close();
    }
    if (spi_) {
        spi_->finish();
    }
    if (panel_folder_) {
        panel_folder_->finish();
    }
}

/// What passed on its lines; nothing of a board that has none.
std::string BoardUnit::line_summary() const {
    if (!has_main_line() && !host_link_) {
        return ".\n";
    }
    const board::Counters& c = board_->counters();
    const link::LinkStats& l = link_->stats();
    return fmt::format(
        ": {} lines heard, {} said, on all lines. Bad frames {}, too long {}, "
        "unknown codes {}, "
        "no rule {}, requests lost {}, messages lost {}, cut {}. Bytes of the main line: in {}, "
        "out {}, lost {}.\n",
        c.lines_received, c.lines_sent, c.bad_frames, board_->lines_too_long(), c.unknown_codes, c.unmatched,
        c.requests_lost, c.messages_lost, c.lines_cut, l.bytes_in, l.bytes_out, l.bytes_lost);
}

std::string BoardUnit::summary() const {
    std::string out = fmt::format("After {:.3f} s", machine::to_seconds(live_->now())) + line_summary();
    for (const fault::FaultStatus& status : faults_->list()) {
        out += host::fault_sentence(status);
        const bool elsewhere = status.seen == 0 && !status.spec.line && host_link_;
        out += elsewhere ? " It was for the main line; line=usb is the USB side.\n" : "\n";
    }
    for (const machine::Fault& broken : board_->machine().faults.list()) {
        out += fault::printer_fault_sentence(broken) + "\n";
    }
    return out;
}

}  // namespace fauxboard::tools
