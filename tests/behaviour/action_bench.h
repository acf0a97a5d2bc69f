#pragma once

// A machine to try actions on, and the rows of the tests that do.

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/rule_compiler.h"
#include "tests/support/printers.h"
#include "tests/support/small_profile.h"

namespace fauxboard::testing {

using namespace fauxboard::behaviour;
using machine::EventId;
using std::string;

struct Bench final : NoticeSink {
    std::shared_ptr<const Profile> profile;
    std::unique_ptr<machine::Machine> made{profile->kind->make(profile->machine, {}, 1)};
    machine::Machine& machine{*made};
    std::vector<double> variables{profile->variables[0].initial};
    std::vector<string> notices;
    bool reset = false;
    machine::SimTime now{0};

    explicit Bench(std::shared_ptr<const Profile> of = small_profile()) : profile(std::move(of)) {
        machine.power_on(now);
        machine.factory_image = machine.eeprom_image = "settings.steps.x 80\nsettings.steps.y 80\n";
        pass(1);
    }
    void notice(Level, std::string_view text) override { notices.emplace_back(text); }

    /// Does what stands in a rule's "do", as if `request` had come.
    void run(const string& todo, const string& request = "M1") {
        Document document;
        Findings findings{document, {}};
        Names names;
        names.variables.emplace("count", 0);
        names.request = true;
        RuleCompiler compiler(findings, names, {}, *profile->machine);
        const auto calls = compiler.actions(Json::parse(todo), "");
        for (const Problem& problem : findings.problems) {
            FAIL_CHECK(todo << ": " << problem.sentence());
        }
        const auto command = protocol::parse_command(request);
        ActionContext context{machine, variables, *this};
        for (const ActionCall& call : calls) {
            run_action(call, {machine, variables, &*command, nullptr, 0}, profile->variables, context);
        }
        reset = context.reset;
    }
    void pass(double seconds) {
        now += machine::from_seconds(seconds);
        machine.advance(now);
    }
    double number(std::string_view path) const { return find_field(path)->get(machine).number; }
    string text(std::string_view path) const { return string(find_field(path)->get(machine).text); }
    bool raised(EventId id) {
        bool found = false;
        while (const auto event = machine.events.take()) {
            found = found || *event == id;
        }
        return found;
    }
    void heat(double c) { printer().thermal.set_temperature(filament::HeaterId::nozzle, c); }
    filament::Printer& printer() { return filament_printer(machine); }
    void print() {
        run(R"([{"job.select": {"name": "a.gcode"}}, "job.start"])");
        machine.events.clear();
    }
};

struct ActionRow {
    const char* action;
    std::function<void(Bench&)> check;
};

const std::vector<ActionRow>& machine_action_rows();
const std::vector<ActionRow>& device_action_rows();
const std::vector<ActionRow>& fault_action_rows();
const std::vector<ActionRow>& host_action_rows();
/// Of a resin printer; `resin_profile` is one that they are tried on.
const std::vector<ActionRow>& resin_action_rows();
inline constexpr std::string_view resin_profile = R"({ "machine": {
    "resin": { "stick_visible_s": 0 },
    "card": { "entries": [ { "file": "a.gcode", "lines": [ "G28" ] }, { "file": "no.ctb", "lines": [ "no layers" ] },
                           { "folder": "sub", "entries": [ { "file": "b.gcode", "lines": [ "G28" ] } ] } ] } } })";
/// Of the MKS DLP board, and a profile of it: a stick with a print and a settings file.
const std::vector<ActionRow>& dlp_action_rows();
inline constexpr std::string_view dlp_profile = R"({ "machine": {
    "kind": "dlp",
    "card": { "folders": true, "entries": [
        { "file": "m.cbddlp", "sample": { "layers": 3, "exposure_s": 2, "lift_mm": 2, "width": 1440, "height": 2560 } },
        { "file": "set.acfg", "lines": [ "[General]", "buzzer_touch_duration = 33" ] },
        { "folder": "sub", "entries": [ { "file": "n.cbddlp", "sample": { "layers": 2, "width": 1440, "height": 2560 } } ] } ] } } })";
const std::vector<ActionRow>& transfer_action_rows();

}  // namespace fauxboard::testing
