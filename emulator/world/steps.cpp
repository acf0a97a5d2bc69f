#include "emulator/world/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <string>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/machine/faults.h"
#include "emulator/machine/host_side.h"
#include "emulator/world/world.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

using board::Channel;
using fault::Dice;
using namespace std::chrono_literals;

template <class List>
const auto& one_of(const List& list, Dice& dice) {
    return list[dice.below(std::size(list))];
}

std::string number(Dice& dice) {
    switch (dice.below(6)) {
        case 0:
            return std::to_string(dice.below(4));
        case 1:
            return std::to_string(dice.below(300));
        case 2:
            return fmt::format("-{}.{}", dice.below(50), dice.below(100));
        case 3:
            return fmt::format("{}.{:03}", dice.below(300), dice.below(1000));
        case 4:
            return std::to_string(dice.next());
        default:
            return "";
    }
}

std::string with_parameters(const std::string& code, Dice& dice) {
    std::string out = code;
    for (std::uint64_t i = dice.below(4); i > 0; --i) {
        out += ' ';
        out += one_of(std::string_view("SPXYZEFRTABCDHIJKQUVW"), dice);
        out += number(dice);
    }
    return out;
}

std::string garbage(Dice& dice) {
    std::string out;
    for (std::uint64_t i = dice.below(dice.below(20) == 0 ? 5000 : 40); i > 0; --i) {
        out += static_cast<char>(dice.below(3) == 0 ? dice.below(256) : 0x20 + dice.below(95));
    }
    return out;
}

/// A code of a list with parameters, or with the name of a file, or none at all.
std::string request(const std::vector<std::string>& codes, Dice& dice) {
    if (codes.empty() || dice.below(20) == 0) {
        return garbage(dice);
    }
    const std::string& code = one_of(codes, dice);
    static constexpr std::array<std::string_view, 5> names{"part.gco", "long.gco", "empty.gco", "none.gco",
                                                           "../part.gco"};
    return dice.below(5) == 0 ? fmt::format("{} {}", code, one_of(names, dice)) : with_parameters(code, dice);
}

// Peers.
// -----------------------------------------------------------------------------------------------

void screen_asks(World& w, Dice& dice) {
    const std::string body = request(w.cast().requests, dice);
    const bool framed = w.cast().profile->line.framing == behaviour::Framing::frames;
    w.say(Channel::main, framed ? protocol::frame(body) : body + "\r\n");
}

void screen_stammers(World& w, Dice& dice) {
    std::string text = garbage(dice);
    if (dice.below(2) == 0) {
        text += '\n';
    }
    w.say(Channel::main, text);
}

void screen_is_touched(World& w, Dice& dice) {
    w.touch(dice);
}

void screen_floods(World& w, Dice& dice) {
    std::string all;
    for (std::uint64_t i = dice.below(200); i > 0; --i) {
        all += protocol::frame("M105");
    }
    w.say(Channel::main, all);
}

void host_commands(World& w, Dice& dice) {
    w.command(request(w.cast().commands, dice));
}

/// More than any queue holds, by a host that does not wait.
void host_floods(World& w, Dice& dice) {
    w.command("G4 S3");
    for (std::uint64_t i = dice.below(5000); i > 0; --i) {
        w.command("M105");
    }
}

void host_stammers(World& w, Dice& dice) {
    static constexpr std::array<std::string_view, 8> odd{
        "N3 M105*1\n", "N5 M105\n", "M105*7\n", "\n", "M\n", "N\n", "*\n", "N-1 M110*0\n"};
    w.say(Channel::host, dice.below(2) == 0 ? std::string(one_of(odd, dice)) : garbage(dice) + "\n");
}

void host_prints(World& w, Dice& dice) {
    for (std::uint64_t i = dice.below(30); i > 0; --i) {
        w.command(fmt::format("G1 X{} Y{} E{} F{}", dice.below(100), dice.below(100), dice.below(10),
                              600 + dice.below(6000)));
        w.pass(std::chrono::milliseconds(dice.below(50)));
    }
}

void host_uploads(World& w, Dice& dice) {
    if (w.owed() > 0) {
        return;  // a good host waits
    }
    // One that will not come back has a name of its own: what others say then goes into that file.
    const bool given_up = dice.below(8) == 0;
    const std::string name = given_up ? "left.gco" : fmt::format("up{}.gco", dice.below(3));
    const std::uint64_t lines = dice.below(60);
    std::string content;
    std::vector<std::string> said;
    for (std::uint64_t i = 0; i < lines; ++i) {
        said.push_back(fmt::format("G1 X{} Y{}", dice.below(100), dice.below(100)));
        content += said.back() + "\r\n";
    }
    if (!given_up) {
        w.will_be(name, content);
    }
    w.command("M28 " + name);
    for (const std::string& line : said) {
        w.command(line);
        w.let_most_be_acknowledged();  // what is logged is carried out as well
    }
    if (!given_up) {
        w.command("M29");
    }
}

void network_asks(World& w, Dice& dice) {
    static constexpr std::array<std::string_view, 6> ends{"", "\n", "\r\n", "\0", "\r", "  "};
    w.datagram(1 + dice.below(3), dice.below(4) == 0
                                      ? garbage(dice)
                                      : request(w.cast().requests, dice) + std::string(one_of(ends, dice)));
}

// The job.
// -----------------------------------------------------------------------------------------------

void job_begins(World& w, Dice& dice) {
    if (!w.cast().prints.empty()) {
        w.print(one_of(w.cast().prints, dice));
    }
}

void job_changes(World& w, Dice& dice) {
    w.tinker([&](machine::Machine& machine) {
        switch (dice.below(5)) {
            case 0:
                w.remark("the job is paused");
                machine.pause_job();
                break;
            case 1:
                w.remark("the job is resumed");
                machine.resume_job();
                break;
            case 2:
                w.remark("the user continues");
                machine.user_continues();
                break;
            case 3:
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

void board_is_reset(World& w, Dice&) {
    w.reset();
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
