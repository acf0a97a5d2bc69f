// Actions that break the machine and mend it, and the user who continues.

#include "emulator/filament/event_rows.h"
#include "tests/behaviour/action_bench.h"

namespace fauxboard::testing {

const std::vector<ActionRow>& fault_action_rows() {
    static const std::vector<ActionRow> rows{
        {"fault.set",
         [](Bench& b) {
             b.run(R"({"fault.set": {"fault": "thermistor_short", "part": "bed"}})");
             b.pass(1);
             CHECK(b.number("faults.thermistor_short") == 1);
             CHECK(b.number("heaters.bed.printed") == 300);
             CHECK(b.number("heaters.nozzle.printed") < 30);
             CHECK(b.text("heaters.bed.alarm") == "too hot");
             CHECK(b.raised(filament::event("heater.bed_abnormal")));
             b.run(R"({"fault.set": {"fault": "jam", "value": 40, "for_s": 5}})");
             b.pass(1);
             CHECK(b.printer().filament_path.lost == doctest::Approx(0.4));
             b.pass(5);
             CHECK(b.number("faults.jam") == 0);
             CHECK(b.printer().filament_path.lost == 0);
             CHECK(b.notices.empty());
             b.run(R"({"fault.set": {"fault": "{arg}"}})", "M1 jamm");
             b.run(R"({"fault.set": {"fault": "jam", "value": 101}})");
             b.run(R"({"fault.set": {"fault": "jam", "part": "bed"}})");
             b.run(R"({"fault.set": {"fault": "heater_dead", "part": "bad"}})");
             b.run(R"({"fault.set": {"fault": "hang", "value": 5}})");
             b.pass(1);
             CHECK(b.notices.size() == 5);
             CHECK(b.notices.front() == "unknown fault of the printer \"jamm\"; did you mean \"jam\"?");
             CHECK(b.number("faults.jam") == 0);
         }},
        {"fault.clear",
         [](Bench& b) {
             b.run(R"([{"fault.set": {"fault": "endstop_dead"}}, {"fault.set": {"fault": "refused"}}])");
             b.pass(1);
             b.run(R"({"fault.clear": {"fault": "refused"}})");
             CHECK(b.number("faults.refused") == 0);
             CHECK(b.number("faults.endstop_dead") == 1);
             b.run(R"("fault.clear")");
             CHECK(b.number("faults.endstop_dead") == 0);
             CHECK_FALSE(b.printer().motion.faults().dead_endstops[0]);
             b.run(R"({"fault.clear": {"fault": "{arg}"}})", "M1 refuse");
             CHECK(b.notices.size() == 1);
         }},
        {"job.continue",
         [](Bench& b) {
             b.run(R"("job.continue")");  // nobody waits
             CHECK(b.number("job.status") == 0);
             b.machine.job.waits_for_user = true;
             b.run(R"([{"job.select": {"name": "a.gcode"}}])");
             b.machine.job.waits_for_user = true;
             b.run(R"("job.continue")");
             CHECK(b.number("job.waits_for_user") == 0);
             CHECK(b.number("job.status") == 0);  // what was selected is not started by it
             b.run(R"(["job.start", "job.pause"])");
             b.pass(60);
             CHECK(b.number("job.status") == 2);
             b.machine.job.waits_for_user = true;
             b.run(R"("job.continue")");
             CHECK(b.number("job.status") == 1);
             CHECK(b.number("job.waits_for_user") == 0);
         }},
    };
    return rows;
}

}  // namespace fauxboard::testing
