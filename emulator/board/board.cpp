#include "emulator/board/board_front.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "emulator/behaviour/eeprom.h"
#include "emulator/board/sizes.h"
#include "protocol/command.h"
#include "protocol/host_line.h"

namespace fauxboard::board {
namespace {

using behaviour::ActionContext;
using behaviour::Rule;
using behaviour::Scope;
using behaviour::Send;
using machine::never;

constexpr std::uint32_t outbox_bytes = 12 * 1024;
constexpr std::uint32_t outbox_messages = 128;
constexpr std::uint32_t inbox_bytes = 8 * 1024;
/// Of a line that speaks as a host. The firmware has room for a few, and its USB holds the rest back in the
/// computer, so that nothing is lost; here it waits in the board.
constexpr std::uint32_t command_bytes = 32 * 1024;
constexpr std::uint32_t command_count = 1024;
constexpr std::size_t first_output = 2 * line_bytes;

/// A code ("M2134"), not a word ("log"): words are no commands to the board and take no tick. The recorded
/// one answered an M2134 that came 0.8 ms behind a log line as fast as one that came alone.
bool is_code(std::string_view body) {
    return body.size() > 1 && body[1] >= '0' && body[1] <= '9';
}

}  // namespace

Board::Board(std::shared_ptr<const behaviour::Profile> profile, machine::Services services, Options options)
    : profile_(std::move(profile)),
      options_(options),
      machine_(profile_->kind->make(profile_->machine, services, options.seed)),
      schedule_(*profile_),
      inbox_(inbox_bytes, profile_->line.queue_lines),
      outbox_(outbox_bytes, outbox_messages),
      codes_(profile_->queue_codes, profile_->code_cells) {
    port(Channel::main).connected = true;
    if (profile_->line.framing == behaviour::Framing::commands) {
        machine_->commands.of_files = this;
    }
    for (const Channel channel : {Channel::main, Channel::host}) {
        if (takes_commands(channel)) {
            port(channel).commands = CommandQueue(command_bytes, command_count);
            port(channel).splitter.set_cutting(true);
        }
    }
    port(Channel::main).output = OutputBuffer(first_output);
    if (services.eeprom != nullptr) {
        machine_->eeprom_image = services.eeprom->load().value_or(std::string{});
    }
    for (const behaviour::VariableInfo& info : profile_->variables) {
        variables_.push_back(info.initial);
    }
}

Board::~Board() = default;

Scope Board::scope(const protocol::Command* command) const {
    return {*machine_, variables_, command, nullptr, 0};
}

void Board::notice(Level level, std::string_view text) {
    if (options_.observer != nullptr) {
        options_.observer->on_notice(time_, level, text);
    }
}

void Board::power_on(SimTime now) {
    time_ = power_on_ = now;
    if (options_.observer != nullptr) {
        options_.observer->on_power_on(now);
    }
    last_tick_ = now - profile_->tick;
    inbox_.clear();
    outbox_.clear();
    codes_.clear();
    ring_.reset();
    hold({});
    network_ = NetworkOutbox();
    unfinished_due_ = never;
    asker_.reset();
    after_ = nullptr;
    for (Port& each : ports_) {
        each.splitter.reset();
        each.commands.clear();
        each.deaf_at = nowhen;
    }
    machine_->power_on(now);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        variables_[i] = profile_->variables[i].initial;
    }
    ActionContext context{*machine_, variables_, *this};
    for (const behaviour::ActionCall& call : profile_->defaults) {
        behaviour::run_action(call, scope(), profile_->variables, context);
    }
    const behaviour::Variables kept{variables_, profile_->variables};
    machine_->factory_image = behaviour::make_image(*machine_, &kept);
    if (machine_->eeprom_image.empty()) {
        machine_->eeprom_image = machine_->factory_image;
    }
    behaviour::load_fields(*machine_, {}, &kept);
    machine_->events.clear();  // what setting up raised is nobody's business
    schedule_.power_on(now);
    schedule_.take_as_told(*machine_);
    for (const Send& entry : profile_->boot) {
        send(entry, scope());
    }
    call_front([now](Front& front, ActionContext& told) { front.power_on(now, told); });
}

void Board::reload(std::shared_ptr<const behaviour::Profile> profile) {
    if (profile->kind != &machine_->kind()) {
        notice(Level::warning,
               "the changed profile is of another kind of machine: it takes a new start of the program");
        return;
    }
    std::vector<double> variables;
    for (const behaviour::VariableInfo& info : profile->variables) {
        const auto same =
            std::find_if(profile_->variables.begin(), profile_->variables.end(),
                         [&](const behaviour::VariableInfo& old) { return old.name == info.name; });
        const double value = same == profile_->variables.end()
                                 ? info.initial
                                 : variables_[static_cast<std::size_t>(same - profile_->variables.begin())];
        variables.push_back(std::clamp(value, info.min, info.max));
    }
    profile_ = std::move(profile);
    variables_ = std::move(variables);
    schedule_.reload(*profile_, time_);
    codes_ = CodeQueue(profile_->queue_codes, profile_->code_cells);
    hold({});
    told_.clear();
    after_ = nullptr;
}

void Board::receive(SimTime now, std::string_view bytes, Channel channel) {
    catch_up(now);
    if (channel == Channel::main && profile_->line.small()) {
        std::optional<std::uint64_t> tick;
        if (options_.pacing) {
            tick = static_cast<std::uint64_t>((time_ - power_on_) / profile_->tick);
        }
        const std::size_t lost = ring_.feed(
            tick, bytes, profile_->line, [this](std::string_view line) { take_line(Channel::main, line); });
        counters_.bytes_lost += lost;
        if (lost != 0) {
            notice(Level::warning, "bytes lost: more came at once than the board's receiving ring holds");
        }
        return;
    }
    port(channel).splitter.feed(bytes, [this, channel](std::string_view line) { take_line(channel, line); });
    if (channel == Channel::main && profile_->line.unfinished > SimTime{0} && !bytes.empty()) {
        unfinished_due_ = port(channel).splitter.in_line() ? time_ + profile_->line.unfinished : never;
    }
}

std::uint64_t Board::lines_too_long() const {
    return std::accumulate(
        ports_.begin(), ports_.end(), std::uint64_t{0},
        [](std::uint64_t sum, const Port& each) { return sum + each.splitter.too_long(); });
}

std::uint64_t Board::nul_bytes() const {
    return std::accumulate(ports_.begin(), ports_.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const Port& each) { return sum + each.splitter.nuls(); }) +
           ring_.nuls();
}

bool Board::quiet() const {
    return std::all_of(ports_.begin(), ports_.end(), [](const Port& each) { return each.output.empty(); });
}

void Board::tell_received(Channel channel, std::string_view line, Verdict verdict) {
    if (options_.observer != nullptr) {
        options_.observer->on_received(time_, channel, line, verdict);
    }
}

void Board::hear(SimTime now, std::string_view line) {
    catch_up(now);
    take_line(Channel::main, line);
}

void Board::take_line(Channel channel, std::string_view line) {
    ++counters_.lines_received;
    if (takes_commands(channel)) {
        machine_->hear_host(time_);
        take_command_line(channel, line);
        return;
    }
    std::string_view body;
    const bool bad = !unframe(line, body);
    // Words are no commands to a board of frames, and take no tick.
    const bool ticks = profile_->line.framing != behaviour::Framing::frames ||
                       !profile_->line.codes.empty() || is_code(body);
    Verdict verdict = Verdict::accepted;
    const bool paced = options_.pacing && channel == Channel::main;
    const bool held = held_.rule != nullptr && channel == Channel::main;
    const bool waits = held || (paced ? ticks : port(channel).output.size() >= output_limit);
    if (machine_->hung()) {
        ++counters_.requests_lost;
        verdict = Verdict::queue_full;
    } else if (bad) {
        ++counters_.bad_frames;
        verdict = Verdict::bad_frame;
    } else if (waits && !inbox_.push(body)) {
        ++counters_.requests_lost;
        verdict = Verdict::queue_full;
    }
    tell_received(channel, line, verdict);
    if (verdict == Verdict::accepted && !waits) {
        if (std::exchange(idle_before_, nowhen) > time_) {
            machine_->pass(time_);
        } else {
            machine_->advance(time_);
        }
        execute(channel, body);
        settle();
        run_host();
    }
}

/// Takes a request out of the frame that the main line has. False when its checksum is wrong.
bool Board::unframe(std::string_view line, std::string_view& body) const {
    if (!profile_->line.codes.empty()) {
        body = line;  // it looks for nothing but its codes
        return true;
    }
    if (profile_->line.framing != behaviour::Framing::frames) {
        body = protocol::unframe_host_line(protocol::without_remark(line)).body;
        return true;
    }
    const protocol::Unframed unframed = protocol::unframe(line, profile_->line.checksum);
    body = unframed.body;
    return unframed.fault == protocol::FrameFault::none;
}

SimTime Board::next_tick() const {
    if ((inbox_.empty() && outbox_.empty() && codes_.empty()) || held_.rule != nullptr) {
        return never;
    }
    if (!options_.pacing) {
        return time_;
    }
    const SimTime tick = profile_->tick;
    const SimTime first = power_on_ + profile_->first_tick;
    if (time_ <= first) {
        return std::max(first, last_tick_ + tick);
    }
    const SimTime::rep passed = (time_ - first + tick - SimTime{1}) / tick;
    return std::max(first + passed * tick, last_tick_ + tick);
}

SimTime Board::next_due() const {
    if (machine_->hung()) {
        return machine_->next_event();
    }
    const SimTime slot = schedule_.next_slot() <= time_ ? schedule_.next_slot()
                                                        : schedule_.next_due(scope(), machine_->restless());
    return machine::earliest(machine_->next_event(), next_tick(), slot, unfinished_due_, front_due());
}

/// A time before which nothing is due, found without asking which of the schedule's slots may send.
SimTime Board::nothing_before() const {
    if (machine_->hung()) {
        return machine_->next_event();
    }
    return machine::earliest(machine_->next_event(), next_tick(), schedule_.next_slot(), unfinished_due_,
                             front_due());
}

/// Goes through the slots before `end`. Those passed over because nothing could come of them are among them,
/// for their rounds to count.
void Board::run_slots(SimTime end) {
    while (!machine_->hung() && schedule_.next_slot() < end &&
           port(Channel::main).output.size() < output_limit) {
        const behaviour::Slot* slot = schedule_.turn(scope());
        if (slot != nullptr) {
            Send entry;
            entry.frame = *slot->frame;
            entry.now = slot->now;
            send(entry, scope());
        }
    }
}

void Board::run_tick() {
    last_tick_ = time_;
    if (!outbox_.empty()) {
        emit(outbox_.front());
        outbox_.pop();
    } else if (!codes_.empty()) {
        emit_code(codes_.take());
    }
    if (!inbox_.empty() && held_.rule == nullptr) {
        std::array<char, protocol::max_line_bytes> line;
        const std::string_view front = inbox_.front();
        const std::size_t size = front.copy(line.data(), line.size());
        inbox_.pop();  // before it is executed: a reset empties the queue
        execute(Channel::main, {line.data(), size});
        settle();
        run_host();
    }
}

SimTime Board::advance(SimTime now) {
    while (quiet()) {
        run_host();  // what its output had no room for may go on
        run_own_requests();
        const SimTime due = next_due();
        if (due > now) {
            time_ = std::max(time_, now);
            return held_back_ ? time_ : due;
        }
        step(due);
    }
    return held_back_ ? time_ : next_due();
}

/// Carries out what the machine asks of itself.
void Board::run_own_requests() {
    while (const auto line = machine_->take_request()) {
        unasked_ = true;
        execute(Channel::main, protocol::unframe_host_line(*line).body);
        unasked_ = false;
        settle();
    }
}

void Board::step(SimTime due) {
    time_ = std::max(time_, due);
    machine_->advance(time_);
    settle();
    run_host();
    run_own_requests();
    if (unfinished_due_ <= time_) {
        unfinished_due_ = never;
        port(Channel::main).splitter.end_line([this](std::string_view line) {
            take_line(Channel::main, line);
        });
    }
    if (!machine_->hung() && front_due() <= time_) {
        call_front([this](Front& front, ActionContext& context) { front.advance(time_, context); });
        settle();
    }
    run_slots(time_ + SimTime{1});
    if (!machine_->hung() && next_tick() <= time_) {
        run_tick();
    }
}

void Board::catch_up(SimTime now) {
    // With so much output untaken the slots stand still; they go on, late, when it has been taken.
    while ((idle_before_ = nothing_before()) < now && port(Channel::main).output.size() < output_limit) {
        const SimTime due = next_due();
        if (due >= now) {
            // Nothing comes of the slots up to here. They are gone through now, else the next call would find
            // them overdue, and with them the one due at this very moment, before what comes with this call.
            run_slots(now);
            break;
        }
        step(due);
    }
    time_ = std::max(time_, now);
}

}  // namespace fauxboard::board
