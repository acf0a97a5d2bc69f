#include "emulator/world/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/machine/faults.h"
#include "emulator/machine/host_side.h"
#include "emulator/world/peers.h"
#include "emulator/world/world.h"

namespace fauxboard::world {
namespace {

using fault::Dice;
using namespace std::chrono_literals;

// The job.
// -----------------------------------------------------------------------------------------------

/// Files with nothing to print in them, farther than a board reads at once: remarks, or a line without end.
const std::string& chatter(bool in_lines) {
    constexpr std::size_t size = 3'500'000;
    static const std::string endless(size, 'x');
    static const std::string lines = [] {
        std::string out;
        while (out.size() < size) {
            out += "; nothing but a remark\n";
        }
        return out;
    }();
    return in_lines ? lines : endless;
}

void job_begins(World& w, Dice& dice) {
    if (w.cast().prints.empty()) {
        return;
    }
    const std::string& file = one_of(w.cast().prints, dice);
    if (dice.below(8) != 0 || !file.ends_with(".gco")) {
        w.print(file);
        return;
    }
    w.disk().put("chatter.gco", chatter(dice.below(2) == 0));
    w.print("chatter.gco");
}

void job_changes(World& w, Dice& dice) {
    const std::uint64_t change = dice.below(5);
    if (change == 4) {
        w.remark("the user continues");
        w.user_continues();
        return;
    }
    w.tinker([&](machine::Machine& machine) {
        switch (change) {
            case 0:
                w.remark("the job is paused");
                machine.pause_job();
                break;
            case 1:
                w.remark("the job is resumed");
                machine.resume_job();
                break;
            case 2:
                w.remark("the job is stopped");
                w.new_job();
                machine.stop_job();
                break;
            default:
                w.remark("the job goes on elsewhere");
                w.new_job();
                machine.seek_job(static_cast<double>(dice.below(5000)));
        }
    });
}

void job_is_taken_up(World& w, Dice&) {
    w.new_job();
    w.act("job.recover");
}

// The machine and what is around it.
// -----------------------------------------------------------------------------------------------

void something_is_done(World& w, Dice& dice) {
    const auto all = behaviour::actions();
    const behaviour::ActionInfo& action = one_of(all, dice);
    if (!action.phrase.empty()) {
        w.act(action.phrase);
    }
}

/// Of whatever kind of machine; jobs, files and breakdowns are seen to by steps of their own.
void something_is_wished(World& w, Dice& dice) {
    static constexpr std::array<std::string_view, 9> others{
        "job.", "transfer.", "code.", "fault.", "board.", "timer.", "machine.", "wifi.", "config."};
    static constexpr std::array<std::string_view, 5> names{"part.gco", "part.cbddlp", "panel.cbddlp",
                                                           "nozzle", "bed"};
    const auto all = behaviour::actions();
    const behaviour::ActionInfo& action = one_of(all, dice);
    const bool is_other = std::any_of(others.begin(), others.end(), [&action](std::string_view begin) {
        return action.name.starts_with(begin);
    });
    if (action.run == nullptr || is_other) {
        return;
    }
    std::string args;
    for (const behaviour::ArgInfo& arg : action.args) {
        const std::string value =
            arg.type == behaviour::ArgType::text
                ? fmt::format("\"{}\"", one_of(names, dice))
                : std::to_string(dice.below(arg.type == behaviour::ArgType::number ? 20 : 2));
        if (arg.required || dice.below(2) == 0) {
            args += fmt::format("{}\"{}\": {}", args.empty() ? "" : ", ", arg.name, value);
        }
    }
    if (action.name.starts_with("card.")) {
        w.harmed();  // among them: one that cannot be read
    }
    if (action.name == "platform.set_zero") {
        w.misset();  // in the air, or within what is printed
        w.harmed();
    }
    w.act(fmt::format("{{\"{}\": {{{}}}}}", action.name, args));
}

void value_changes(World& w, Dice& dice) {
    const auto all = behaviour::fields();
    const behaviour::Field& field = one_of(all, dice);
    const bool of_job = field.path.starts_with("job.");
    if (field.set == nullptr || of_job) {
        return;
    }
    // A switch that is taken for open when it is closed, a motor without a speed, an alarm that nobody calls
    // off.
    for (const std::string_view begin :
         {"setup.", "config.", "platform.", "print.", "leveling.probe_alarm"}) {
        if (field.path.starts_with(begin)) {
            w.misset();
        }
    }
    if (field.path == "platform.zero") {
        w.harmed();  // the platform's zero lies within what is printed, then
    }
    const double share = static_cast<double>(dice.below(101)) / 100;
    if (field.type == behaviour::FieldType::text) {
        return;
    }
    const double value = field.min + share * (field.max - field.min);
    w.remark(fmt::format("changes: {} = {}", field.path, value));
    w.tinker([&](machine::Machine& machine) {
        behaviour::set_field(machine, field, behaviour::Value::of(value));
    });
}

void something_breaks(World& w, Dice& dice) {
    const machine::FaultInfo& sort = *one_of(machine::fault_rows(), dice);
    w.harmed();  // some of it is over at once, and has happened all the same
    w.remark(fmt::format("breaks: {}", sort.name));
    w.tinker([&](machine::Machine& machine) { machine.faults.add(w.now(), machine::default_request(sort)); });
}

void all_is_mended(World& w, Dice&) {
    w.remark("all is mended");
    w.tinker([](machine::Machine& machine) { machine.faults.clear(); });
}

void disk_has_trouble(World& w, Dice& dice) {
    w.remark("the disk has trouble, or none any more");
    w.disk().set_trouble(static_cast<Disk::Trouble>(dice.below(4)));
}

void eeprom_has_trouble(World& w, Dice& dice) {
    w.eeprom().fails = dice.below(2) == 0;
}

void settings_are_saved(World& w, Dice&) {
    w.act(R"({"eeprom.save": {}})");
}

void power_is_cut(World& w, Dice& dice) {
    w.power_cut(dice);
}

void board_is_reset(World& w, Dice& dice) {
    if (dice.below(2) == 0) {
        w.reset();
    } else {
        w.reset_amid_line();
    }
}

void profile_is_reloaded(World& w, Dice&) {
    w.reload();
}

void time_jumps(World& w, Dice& dice) {
    static constexpr std::array<SimTime, 4> far{1h, 12h, 48h, 240h};
    w.pass(one_of(far, dice));
}

constexpr std::array table{
    StepKind{"screen asks", 20, screen_asks},
    StepKind{"screen stammers", 4, screen_stammers},
    StepKind{"screen is touched", 10, screen_is_touched},
    StepKind{"screen floods", 1, screen_floods},
    StepKind{"host commands", 20, host_commands},
    StepKind{"host stammers", 4, host_stammers},
    StepKind{"host floods", 1, host_floods},
    StepKind{"host prints", 3, host_prints},
    StepKind{"host uploads", 3, host_uploads},
    StepKind{"network asks", 8, network_asks},
    StepKind{"network uploads", 3, network_uploads},
    StepKind{"job begins", 5, job_begins},
    StepKind{"job changes", 6, job_changes},
    StepKind{"job is taken up", 2, job_is_taken_up},
    StepKind{"something is done", 8, something_is_done},
    StepKind{"something is wished", 8, something_is_wished},
    StepKind{"value changes", 5, value_changes},
    StepKind{"something breaks", 3, something_breaks},
    StepKind{"all is mended", 1, all_is_mended},
    StepKind{"disk has trouble", 2, disk_has_trouble},
    StepKind{"eeprom has trouble", 1, eeprom_has_trouble},
    StepKind{"settings are saved", 2, settings_are_saved},
    StepKind{"power is cut", 2, power_is_cut},
    StepKind{"board is reset", 1, board_is_reset},
    StepKind{"profile is reloaded", 1, profile_is_reloaded},
    StepKind{"time jumps", 1, time_jumps},
};

constexpr unsigned all_weights = [] {
    unsigned sum = 0;
    for (const StepKind& kind : table) {
        sum += kind.weight;
    }
    return sum;
}();

SimTime pause(Dice& dice) {
    switch (dice.below(8)) {
        case 0:
            return SimTime{0};
        case 1:
        case 2:
        case 3:
            return std::chrono::milliseconds(dice.below(200));
        case 7:
            return std::chrono::seconds(dice.below(1200));
        default:
            return std::chrono::milliseconds(dice.below(20'000));
    }
}

const StepKind& kind_of(Dice& dice) {
    std::uint64_t at = dice.below(all_weights);
    const StepKind* kind = table.begin();
    for (; at >= kind->weight; ++kind) {
        at -= kind->weight;
    }
    return *kind;
}

}  // namespace

std::span<const StepKind> step_kinds() {
    return table;
}

std::string_view step_name(Dice dice) {
    static_cast<void>(pause(dice));
    return kind_of(dice).name;
}

void do_step(World& world, Dice& dice) {
    world.pass(pause(dice));
    kind_of(dice).run(world, dice);
}

}  // namespace fauxboard::world
