// What the commands of a host or of a file do beside their codes, and the board's death.

#include "emulator/machine/event_rows.h"
#include "tests/behaviour/action_bench.h"

namespace fauxboard::testing {
namespace {

/// A command under way that only notes how it was carried out.
struct Noted final : machine::BegunCommand {
    explicit Noted(bool known) : is_known(known) {}
    bool run_code(bool by_rule) override {
        ran_by_rule = by_rule;
        return is_known;
    }
    bool is_known;
    bool ran_by_rule = false;
};

}  // namespace

const std::vector<ActionRow>& host_action_rows() {
    static const std::vector<ActionRow> rows{
        {"code.run",
         [](Bench& b) {
             Noted known(true);
             b.machine.commands.begun = &known;
             b.run(R"("code.run")");
             CHECK(known.ran_by_rule);
             CHECK_FALSE(b.raised(machine::event("host.unknown")));
             Noted unknown(false);
             b.machine.commands.begun = &unknown;
             b.run(R"("code.run")");
             CHECK(b.raised(machine::event("host.unknown")));
             b.machine.commands.begun = nullptr;
             b.run(R"("code.run")");
             CHECK(b.raised(machine::event("host.unknown")));
         }},
        {"code.unknown",
         [](Bench& b) {
             b.run(R"("code.unknown")");
             CHECK(b.raised(machine::event("host.unknown")));
         }},
        {"code.unanswered",
         [](Bench& b) {
             machine::HostSide& host = b.machine.host_side();
             host.begin(1, "M105", b.now);
             b.machine.transfer.asker = machine::Transfer::host_line(1);
             b.run(R"("code.unanswered")");
             host.over();
             CHECK_FALSE(b.raised(machine::event("host.done")));
             CHECK(host.line().unanswered == 1);
             // What the network asks for takes nothing from the command of the line.
             host.begin(1, "M400", b.now);
             b.machine.transfer.asker = 7;
             b.run(R"("code.unanswered")");
             host.over();
             CHECK(b.raised(machine::event("host.done")));
             CHECK(host.line().unanswered == 1);
         }},
        {"card.look_up",
         [](Bench& b) {
             b.run(R"({"card.look_up": {"name": "/SUB/B.GCODE"}})");
             CHECK(b.text("card.looked_up") == "/sub/b.gcode");
             b.run(R"({"card.look_up": {"name": "nothing"}})");
             CHECK(b.text("card.looked_up").empty());
         }},
        {"machine.kill",
         [](Bench& b) {
             b.run(R"([{"heater.target": {"heater": "bed", "c": 60}}, "machine.kill"])");
             CHECK(b.raised(machine::event("board.killed")));
             CHECK(b.number("heaters.bed.target") == 0);
             CHECK_FALSE(b.machine.hung());  // what it says comes first
             b.machine.die_if_told();
             CHECK(b.machine.hung());
         }},
    };
    return rows;
}

}  // namespace fauxboard::testing
