#include "tests/world/machine_states.h"

#include <iterator>

#include "emulator/filament/printer.h"

namespace fauxboard::world {
namespace {

using namespace std::chrono_literals;

std::function<void(LiveBench&)> acts(std::string action) {
    return [action = std::move(action)](LiveBench& b) { b.act(action); };
}

std::function<void(LiveBench&)> prints_and(std::function<void(LiveBench&)> then) {
    return [then = std::move(then)](LiveBench& b) {
        b.print();
        then(b);
    };
}

std::function<void(LiveBench&)> filament(std::function<void(filament::Printer&)> use) {
    return [use = std::move(use)](LiveBench& b) {
        b.machine([&](machine::Machine& m) { use(*machine::as<filament::Printer>(m)); });
    };
}

/// Every machine's.
std::vector<State> common_states() {
    return {
        {"at rest", [](LiveBench&) {}},
        {"printing", [](LiveBench& b) { b.print(); }, false, true},
        {"beginning to print", [](LiveBench& b) { b.print({}, 10s); }, false, true},
        {"pausing", prints_and([](LiveBench& b) { b.pause(); }), false, true},
        {"paused", prints_and([](LiveBench& b) {
             b.pause();
             b.pass(2min);
         }),
         false, true},
        {"stopped", prints_and([](LiveBench& b) { b.stop(); })},
        {"printed", [](LiveBench& b) { b.print({}, 24h); }},
        {"card out", [](LiveBench& b) { b.remove_cards(); }},
        {"card out while printing", prints_and([](LiveBench& b) { b.remove_cards(); })},
        {"card out while printing, and a minute later", prints_and([](LiveBench& b) {
             b.remove_cards();
             b.pass(1min);
         })},
        {"disk fails while printing", prints_and([](LiveBench& b) {
             b.disk().set_trouble(Disk::Trouble::read_fails);
             b.pass(1min);
         })},
        {"emergency stop",
         prints_and([](LiveBench& b) { b.machine([](machine::Machine& m) { m.emergency_stop(); }); })},
        {"flooded",
         [](LiveBench& b) {
             for (int i = 0; i < 500; ++i)
                 b.say(Channel::main, "M105");
         }},
        {"half a line lies there", [](LiveBench& b) { b.say(Channel::main, "\n"); }},
    };
}

std::vector<State> filament_states() {
    return {
        {"heating",
         filament([](filament::Printer& p) { p.thermal.set_target(filament::HeaterId::nozzle, 200); })},
        {"homing", filament([](filament::Printer& p) { p.home(0); })},
        {"tuning a heater",
         filament([](filament::Printer& p) { p.start_tuning(filament::HeaterId::nozzle, 200); })},
        {"no filament while printing",
         prints_and(filament([](filament::Printer& p) { p.set_filament(false); }))},
        {"printing many short moves", [](LiveBench& b) { b.print("moves.gco"); }, false, true},
        {"printing a line without end", [](LiveBench& b) { b.print("endless.gco", 1s); }},
        {"waiting for the user", [](LiveBench& b) { b.print("waits.gco"); }, false, true},
        {"host waits for heat", [](LiveBench& b) { b.say(Channel::host, "M109 S200"); }, true},
        {"host waits for a dwell", [](LiveBench& b) { b.say(Channel::host, "G4 S60"); }, true},
        {"host waits for moves",
         [](LiveBench& b) {
             for (int i = 0; i < 40; ++i)
                 b.say(Channel::host, i % 2 == 0 ? "G1 X100 F600" : "G1 X1");
         },
         true},
        {"host waits for the user", [](LiveBench& b) { b.say(Channel::host, "M0"); }, true},
    };
}

std::vector<State> resin_states() {
    return {
        {"homing", [](LiveBench& b) { b.say(Channel::main, "G28"); }},
        {"the lamp by hand", [](LiveBench& b) { b.say(Channel::main, "M106 S255"); }},
        {"upload begun by the network", [](LiveBench& b) { b.say(Channel::network, "M28 up.ctb"); }},
        {"upload begun while printing",
         prints_and([](LiveBench& b) { b.say(Channel::network, "M28 up.ctb"); }), false, true},
        {"download begun by the network", [](LiveBench& b) { b.say(Channel::network, "M6032 'part.ctb'"); }},
        {"printing a file of commands", [](LiveBench& b) { b.print("waits.gco"); }},
        {"printing commands without a line end", [](LiveBench& b) { b.print("endless.gco", 1s); }},
    };
}

std::vector<State> dlp_states() {
    return {
        {"homing", acts(R"("platform.home")")},
        {"test picture", acts(R"({"uvtest.image": {"n": 1}})")},
        {"the lamp by hand", acts(R"({"uvtest.light": {"on": true}})")},
        {"the screensaver", acts(R"("board.doze")")},
    };
}

void add(std::vector<State>& all, std::vector<State> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<State> states_of(LiveBench& one_of_them) {
    std::vector<State> all = common_states();
    switch (one_of_them.kind()) {
        case LiveBench::Kind::filament:
            add(all, filament_states());
            break;
        case LiveBench::Kind::resin:
            add(all, resin_states());
            break;
        case LiveBench::Kind::dlp:
            add(all, dlp_states());
            break;
    }
    for (const machine::FaultInfo* const sort : machine::fault_rows()) {
        if (machine::has_fault(one_of_them.printer().kind(), *sort)) {
            all.push_back({"broken: " + std::string(sort->name), prints_and([sort](LiveBench& b) {
                               b.machine([&](machine::Machine& m) {
                                   m.faults.add(b.now(), machine::default_request(*sort));
                               });
                               b.pass(1min);
                           })});
        }
    }
    return all;
}

}  // namespace fauxboard::world
