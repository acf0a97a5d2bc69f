#include "tests/world/live_bench.h"

#include "emulator/dlp/printer.h"
#include "emulator/filament/printer.h"
#include "emulator/host/board_display.h"
#include "emulator/host/screen_files.h"
#include "emulator/world/cast.h"
#include "protocol/framing.h"
#include "tests/support/resin_file.h"

namespace fauxboard::world {
namespace {

using namespace std::chrono_literals;

std::string many_moves() {
    std::string out = "G28\n";
    for (int i = 0; i < 20'000; ++i) {
        out += i % 2 == 0 ? "G1 X50 F3000\n" : "G1 X51\n";
    }
    return out;
}

/// Made once: they are large, and the same for every board.
const std::string& resin_file() {
    static const std::string bytes = [] {
        testing::ResinFile wishes;
        wishes.layers = 60;
        return testing::make_resin_file(wishes).bytes;
    }();
    return bytes;
}
const std::string& panel_file() {
    static const std::string bytes = [] {
        testing::PanelPws wishes;
        wishes.layers = 30;
        return testing::make_panel_pws(wishes);
    }();
    return bytes;
}

LiveBench::Kind kind_of(const machine::Machine& machine) {
    return machine::as<const filament::Printer>(machine) != nullptr ? LiveBench::Kind::filament
           : machine::as<const dlp::Printer>(machine) != nullptr    ? LiveBench::Kind::dlp
                                                                    : LiveBench::Kind::resin;
}

}  // namespace

LiveBench::LiveBench(const std::shared_ptr<const behaviour::Profile>& profile) : profile_(profile) {
    machine::Services services;
    (profile->machine->udisk_port ? services.udisk : services.sd) = &disk_;
    services.eeprom = &eeprom_;
    services.eeprom_cells = &cells_;
    services.job_place = &place_;
    board::Options options{true, 1, &hub_};
    if (!profile->screen.empty()) {
        options.front = &screen_.emplace(host::load_own_screen(profile->screen));
    }
    board_.emplace(profile, services, options);
    if (screen_) {
        display_ = std::make_unique<host::BoardDisplay>(*screen_, *board_);
    }
    kind_ = kind_of(board_->machine());
    put_files();
    session_.emplace(hub_, [] {});
    board_->connect(Channel::host, true);
    board_->power_on(SimTime{0});
    pass(30s);
}

void LiveBench::put_files() {
    disk_.put("part.gco", small_print(400));
    disk_.put("waits.gco", "G28\nM0 wait\nG1 X10\n");
    disk_.put("endless.gco", std::string(3'000'000, 'x'));
    disk_.put("moves.gco", many_moves());
    if (kind_ == Kind::resin) {
        disk_.put("part.ctb", resin_file());
    } else if (kind_ == Kind::dlp) {
        disk_.put("part.pws", panel_file());
    }
}

void LiveBench::pass(SimTime time) {
    const SimTime end = now_ + time;
    for (SimTime due{0}; due <= end;) {
        due = board_->advance(end);
        take();
    }
    now_ = end;
    hub_.on_moved(now_);
}

void LiveBench::say(Channel channel, const std::string& body) {
    if (channel == Channel::network) {
        board_->receive_datagram(now_, 1, body);
    } else {
        const bool framed = channel == Channel::main && profile_->line.framing == behaviour::Framing::frames;
        board_->receive(now_, framed ? protocol::frame(body) : body + "\n", channel);
    }
    take();
}

std::string_view LiveBench::ask(const std::string& request) {
    session_->receive(request + "\n");
    session_->proceed();
    answered_ = session_->take_output();
    return answered_;
}

void LiveBench::machine(const std::function<void(machine::Machine&)>& use) {
    board_->tinker(now_, use);
    take();
}

void LiveBench::act(const std::string& action) {
    ask(R"({"op": "do", "do": )" + action + "}");
}

void LiveBench::print(std::string_view file, SimTime time) {
    if (kind_ == Kind::filament || !file.empty()) {
        machine([&](machine::Machine& m) {
            m.select_file(file.empty() ? "part.gco" : file);
            m.start_or_resume_job();
        });
    } else {
        act(kind_ == Kind::resin ? R"({"resin.print": {"name": "part.ctb"}})"
                                 : R"({"print.start": {"path": "part.pws"}})");
    }
    pass(time);
}

void LiveBench::pause() {
    kind_ == Kind::dlp ? act(R"("print.pause")") : machine([](machine::Machine& m) { m.pause_job(); });
}

void LiveBench::stop() {
    kind_ == Kind::dlp ? act(R"("print.stop")") : machine([](machine::Machine& m) { m.stop_job(); });
}

bool LiveBench::printing() {
    const auto* const own = machine::as<const dlp::Printer>(std::as_const(*board_).machine());
    return own != nullptr ? own->board.print.active() : board_->machine().job.active();
}

void LiveBench::remove_cards() {
    machine([](machine::Machine& m) {
        m.remove_card(0);
        m.remove_card(1);
    });
}

void LiveBench::take() {
    heard_[0] += board_->output(Channel::main);
    heard_[1] += board_->output(Channel::host);
    board_->clear_output();
    board_->take_datagrams([this](std::uint64_t, std::string_view bytes) { heard_[2] += bytes; });
}

void LiveBench::visit(const std::function<void(board::Board&, SimTime)>& use) {
    use(*board_, now_);
    take();
}

}  // namespace fauxboard::world
