// The end of a world: all troubles are taken away, and the board shows that it is none the worse for them.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "emulator/behaviour/fields.h"
#include "emulator/machine/host_side.h"
#include "emulator/world/peers.h"
#include "emulator/world/world.h"
#include "protocol/framing.h"

namespace fauxboard::world {
namespace {

using board::Channel;

/// What a board that was given peace needs to come to rest: the longest wait, and the queues behind it.
constexpr SimTime rest = std::chrono::hours(2);
/// Within which a good request is answered then.
constexpr SimTime patience = std::chrono::seconds(10);
/// At the slowest speed that can be set a few moves take days.
constexpr int most_rests = 500;

}  // namespace

/// As the main line has it.
std::string World::framed(std::string_view request) const {
    return cast_.profile->line.framing == behaviour::Framing::frames ? protocol::frame(request)
                                                                     : std::string(request) + "\n";
}

void World::ask(Channel channel) {
    const auto& probe = cast_.probes[static_cast<std::size_t>(channel)];
    if (!probe) {
        return;
    }
    asked_ = channel;
    heard_.clear();
    switch (channel) {
        case Channel::main:
            say(channel, "\n");  // ends what was left unfinished
            heard_.clear();
            say(channel, framed(probe->request));
            break;
        case Channel::host:
            say(channel, "\n");
            heard_.clear();
            say(channel, probe->request + "\n");
            break;
        case Channel::network:
            datagram(99, probe->request);
            break;
    }
    pass(patience);
    if (!probe->answered_by(heard_)) {
        ledger_.unanswered.push_back(fmt::format("{} on the {} line was not answered by \"{}\"",
                                                 probe->request, board::other_end(channel), probe->answer));
    }
}

/// As hosts do: a few ahead, and no more until they are acknowledged, however slow the axes are set. What
/// waits for the user is continued after an hour.
void World::let_most_be_acknowledged() {
    constexpr int few = 4;
    constexpr SimTime longest = std::chrono::hours(200);
    for (SimTime wait = std::chrono::seconds(1); owed() > few && wait < longest; wait += wait / 2) {
        pass(wait);
        if (wait > std::chrono::hours(1) && board_->machine().job.waits_for_user) {
            user_continues();
            wait = std::chrono::seconds(1);
        }
    }
}

/// Of a USB side: until all that was asked has been carried out, however slow the axes are set.
void World::let_moves_end() {
    for (int i = 0; i < most_rests && !command("M400"); ++i) {
        pass(std::chrono::seconds(10));
    }
    pass(rest);
    rest_while([this] { return owed() > 0; });
}

/// What waits for the user is continued.
void World::rest_while(const std::function<bool()>& goes_on) {
    const auto waits = [this] { return board_->machine().job.waits_for_user; };
    for (int i = 0; i < most_rests && (waits() || goes_on()); ++i) {
        if (waits()) {
            user_continues();
        }
        pass(rest);
    }
}

/// Half a line stands in the board when it is reset: nothing of it is left in the first request after that.
void World::reset_amid_line() {
    constexpr SimTime boot = std::chrono::seconds(30);
    const auto& probe = cast_.probes[static_cast<std::size_t>(Channel::main)];
    const bool may_be_ill = ledger_.harmed || ledger_.misset;
    if (!may_be_ill) {
        say(Channel::main, "M10");
    }
    reset();
    if (!probe || may_be_ill || screen_) {
        return;  // a screen has lines of its own to say, and ends this one
    }
    pass(boot);
    asked_ = Channel::main;
    heard_.clear();
    say(Channel::main, framed(probe->request));
    pass(patience);
    if (!probe->answered_by(heard_)) {
        ledger_.unanswered.push_back(probe->request + " was not answered after a reset amid a line");
    }
}

/// A board of frames answers one request a turn, however many come at once.
void World::hurry() {
    constexpr int many = 6;
    const auto& probe = cast_.probes[static_cast<std::size_t>(Channel::main)];
    const behaviour::Profile& profile = *cast_.profile;
    if (!probe || profile.line.framing != behaviour::Framing::frames || profile.tick <= SimTime{1}) {
        return;
    }
    std::string all;
    for (int i = 0; i < many; ++i) {
        all += protocol::frame(probe->request);
    }
    asked_ = Channel::main;
    heard_.clear();
    say(Channel::main, all);
    pass(profile.tick - SimTime{1});  // in which one turn has its place
    int answers = 0;
    for (std::size_t at = heard_.find(probe->answer); at != std::string::npos;
         at = heard_.find(probe->answer, at + 1)) {
        ++answers;
    }
    ledger_.too_soon = answers >= many ? answers : 0;
    pass(patience);
}

/// Many short moves by the USB side, each with its number and checksum, and where they lead: of X all by a
/// distance, so that each one counts; of Y some to a place, so that their order does. A patient host waits
/// for its acknowledgements, a hasty one says what the board takes, and again what it did not take.
void World::walk(int moves, bool hasty) {
    constexpr double corner = 50;
    constexpr int most_waits = 20'000;
    const int decimals = hasty ? 8 : 2;  // so long that queues are full of bytes before they are of lines
    const auto& probe = cast_.probes[static_cast<std::size_t>(Channel::host)];
    if (!probe || !number_of(board_->machine(), "position.x") || board_->machine().job.active()) {
        return;
    }
    fault::Dice dice(seed_, static_cast<std::uint64_t>(moves), 1);
    command("G28");
    command("G90");
    command(fmt::format("G1 X{} Y{} F6000", corner, corner));
    let_moves_end();
    const auto at = [this](std::string_view path) { return number_of(board_->machine(), path).value_or(0); };
    const std::array<double, 2> start{at("position.x"), at("position.y")};
    int waits = 0;
    const auto insist = [&](std::string_view body) {
        while (!command(body) && ++waits < most_waits) {
            pass(std::chrono::milliseconds(dice.below(100)));
        }
    };
    Ledger::Walk walk;
    walk.asked_mm = start;
    for (int i = 0; i < moves; ++i) {
        const double by_x = static_cast<double>(dice.below(101)) / 100 - 0.5;
        const double by_y = static_cast<double>(dice.below(100)) / 100;
        if (dice.below(6) == 0) {
            walk.asked_mm[1] = start[1] + by_y;
            insist("G90");
            insist(fmt::format("G1 Y{:.{}f} F3000", corner + by_y, decimals));
        } else {
            walk.asked_mm[0] += by_x;
            walk.asked_mm[1] += by_y;
            insist("G91");
            insist(fmt::format("G1 X{:.{}f} Y{:.{}f} F3000", by_x, decimals, by_y, decimals));
        }
        if (!hasty) {
            let_most_be_acknowledged();
            pass(std::chrono::milliseconds(dice.below(200)));
        }
    }
    insist("G90");
    let_moves_end();
    walk.came_mm = {at("position.x"), at("position.y")};
    if (waits < most_waits) {
        ledger_.walks.push_back(walk);
    }
}

/// A file that a fresh board prints is printed, from the card.
void World::proof_print() {
    const Cast::Proof& proof = cast_.proof;
    if (proof.file.empty() || ledger_.misset) {
        return;
    }
    disk_.put(proof.file, cast_.files.at(proof.file));
    tinker([](machine::Machine& machine) {
        machine.stop_job();
        machine.insert_card(0);  // a command that waited behind a print may have released it since
        machine.storage.choose(0);
    });
    act("print.stop");
    pass(rest);
    ledger_.prints.forget();
    ledger_.proof = proof.tally;
    // Twice, as a user would: after moves by hand a platform may be farther up than homing looks for its
    // switch.
    for (int tries = 0; tries < 2 && !ledger_.prints.ended(); ++tries) {
        if (tries > 0) {
            act(R"({"platform.jog": {"mm": -50}})");
            pass(rest);
        }
        print(proof.file);
        rest_while([this] { return prints(); });
    }
}

/// Of whatever kind.
bool World::prints() const {
    const machine::Machine& machine = board_->machine();
    return machine.job.active() || number_of(machine, "print.active").value_or(0) != 0;
}

void World::print(const std::string& file) {
    new_job();
    for (const std::string& words : words_to_print(file)) {
        act(words);
    }
}

/// That a host or a screen was writing, and has forgotten.
void World::close_files() {
    say(Channel::host, "M29\n");
    if (cast_.profile->line.framing == behaviour::Framing::commands) {
        say(Channel::main, "M29\n");
    }
}

void World::peace() {
    scene_.reset();
    disk_.set_trouble(Disk::Trouble::none);
    eeprom_.fails = false;
    tinker([](machine::Machine& machine) {
        machine.faults.clear();
        machine.insert_card(0);
        machine.transfer.trouble = {};
    });
    for (const Channel channel : {Channel::host, Channel::main}) {
        say(channel, "\n");
    }
    close_files();
    if (board_->machine().hung()) {
        reset();
    }
    pass(rest);
    const machine::HostSide& side = board_->machine().host_side();
    const auto waits = [](const auto& line) { return line.waiting > 0; };
    // What is asked waits behind the moves.
    rest_while([&] {
        return owed() > 0 || side.running() || std::any_of(side.lines.begin(), side.lines.end(), waits);
    });
    close_files();  // the first time a full queue may have lost it
    pass(std::chrono::minutes(1));
    if (board_->machine().hung()) {
        reset();
        pass(std::chrono::minutes(1));
    }
    for (const Channel channel : {Channel::main, Channel::host, Channel::network}) {
        ask(channel);
    }
    hurry();
    walk(60, false);
    if (seed_ % 4 == 0) {
        walk(900, true);
    }
    proof_print();
    tinker([](machine::Machine& machine) {
        machine.insert_card(0);
        machine.storage.choose(0);
    });
    if (std::string refused = upload_of_a_newcomer(*this); !refused.empty()) {
        ledger_.unanswered.push_back(std::move(refused));
    }
    ledger_.unheard = ledger_.unheard || board_->machine().job.waits_for_user;
    after_step();
    look(Moment::peace);
}

}  // namespace fauxboard::world
