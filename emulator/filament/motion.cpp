#include "emulator/filament/motion.h"
#include "emulator/filament/event_rows.h"
#include "emulator/filament/names.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::filament {
namespace {

using Kind = ProcedureStep::Kind;
constexpr std::size_t z_axis = 2;
constexpr std::size_t e_axis = 3;
constexpr double far_mm = 1e5;    // beyond any machine; keeps arithmetic finite whatever the line says
constexpr double far_e_mm = 1e9;  // the extruder runs on and on: a spool is more than 300 m

double sane(double mm, double most = far_mm) {
    return std::isfinite(mm) ? std::clamp(mm, -most, most) : 0.0;
}

double most_of(std::size_t axis) {
    return axis == e_axis ? far_e_mm : far_mm;
}

/// Time of a move from rest to rest with one acceleration.
double trapezoid_s(double distance, double feed, double acceleration) {
    if (distance <= 0) {
        return 0;
    }
    if (distance < feed * feed / acceleration) {
        return 2 * std::sqrt(distance / acceleration);
    }
    return distance / feed + feed / acceleration;
}

}  // namespace

Motion::Motion(const MotionConfig& config, const Settings& settings, std::uint64_t seed)
    : series(seed),
      config_(config),
      settings_(settings),
      planner_(settings),
      offset_(config.power_on_mm),
      modal_feed_(config.default_feed_mm_s) {
    planner_.set_blocks(config.planner_blocks);
}

void Motion::power_on() {
    for (std::size_t i = 0; i < offset_.size(); ++i) {
        offset_[i] += executed_[i];
    }
    planner_.clear();
    head_ = count_ = 0;
    step_end_ = never;
    planned_ = accepted_ = executed_ = {};
    modal_feed_ = config_.default_feed_mm_s;
    shown_feed_ = 0;
    babystep_ = 0;
    speed_percent_ = flow_percent_ = 100;
    lost_rounds_ = 0;
    homed_ = 0;
    relative_ = relative_e_ = motors_ = false;
    mesh = {};
    probed_ = {};
}

void Motion::set_motors(bool on) {
    motors_ = on;
    if (!on) {
        if (busy()) {
            abort();  // at rest what was too short to be a move stays part of the place, as with Marlin
        }
        homed_ = 0;  // a loose head may be anywhere
    }
}

void Motion::abort() {
    planner_.clear();
    head_ = count_ = 0;
    step_end_ = never;
    planned_ = accepted_ = executed_;
}

void Motion::set_position(const AxisTargets& values) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        if (!values[i]) {
            continue;
        }
        const double mm = sane(*values[i], most_of(i));
        if (i < offset_.size()) {
            offset_[i] += planned_[i] - mm;
        }
        if (count_ == 0) {
            // Blocks that wait, and what was too short to be one, keep their way in the new coordinates.
            planner_.shift(i, mm - planned_[i]);
            executed_[i] = executed_[i] == planned_[i] ? mm : executed_[i] + (mm - planned_[i]);
            accepted_[i] = mm;
        }
        planned_[i] = mm;
    }
}

int Motion::take_lost_rounds() {
    const int rounds = lost_rounds_;
    lost_rounds_ = 0;
    return rounds;
}

MoveOutcome Motion::move(const MoveRequest& request, SimTime now, EventQueue& events) {
    ProcedureStep step;
    step.kind = Kind::to;
    step.feed_mm_s = modal_feed_;
    if (request.feed_mm_min && std::isfinite(*request.feed_mm_min) && *request.feed_mm_min > 0) {
        step.feed_mm_s = std::min(*request.feed_mm_min / 60.0, far_mm);
    }
    if (!request.feed_passes) {
        modal_feed_ = step.feed_mm_s;
    }
    bool any = false;
    MoveOutcome outcome = MoveOutcome::accepted;
    for (std::size_t i = 0; i < axis_count; ++i) {
        if (!request.values[i]) {
            continue;
        }
        any = true;
        const bool relative = request.force_relative || (i == 3 ? relative_e() : relative_);
        const double most = most_of(i);
        double target = sane(sane(*request.values[i], most) + (relative ? planned_[i] : 0.0), most);
        if (request.limits && i < 3) {
            const double inside = std::clamp(target, 0.0, config_.volume_mm[i]);
            if (inside != target) {
                outcome = MoveOutcome::clamped;
                target = inside;
            }
        }
        step.values[i] = target;
    }
    if (!any) {
        return outcome;  // "G1 F6000" only sets the feed
    }
    if (count_ == capacity) {
        return MoveOutcome::queue_full;
    }
    motors_ = true;
    enqueue(step, true);
    begin(now, events);
    return outcome;
}

bool Motion::run(const Procedure& procedure, SimTime now, EventQueue& events) {
    if (count_ + procedure.size() > capacity) {
        return false;
    }
    motors_ = true;
    for (const ProcedureStep& step : procedure) {
        enqueue(step, false);
    }
    begin(now, events);
    return true;
}

void Motion::enqueue(const ProcedureStep& step, bool buffered) {
    Step& slot = at(count_);
    slot = Step{step, planned_, buffered, false};
    for (std::size_t i = 0; i < axis_count; ++i) {
        if (!step.values[i]) {
            continue;
        }
        switch (step.kind) {
            case Kind::to:
                slot.target[i] = *step.values[i];
                break;
            case Kind::by:
                slot.target[i] += *step.values[i];
                break;
            case Kind::zero:
            case Kind::home:
                slot.target[i] = 0;
                break;
            default:
                break;
        }
    }
    if (step.kind == Kind::probe) {
        const double bed = step.reference ? 0.0
                                          : bed_height_mm(slot.target[0] + config_.probe_offset_mm[0],
                                                          slot.target[1] + config_.probe_offset_mm[1]);
        slot.target[z_axis] = config_.probe_trigger_mm + bed;
    }
    planned_ = slot.target;
    ++count_;
    accept_ahead();
}

/// Plain moves enter the planner ahead of their turn, as many as it has blocks; a procedure's steps wait for
/// the one before.
void Motion::accept_ahead() {
    const std::size_t blocks = std::min<std::size_t>(count_, config_.planner_blocks);
    for (std::size_t i = 0; i < blocks && at(i).buffered; ++i) {
        if (!at(i).accepted) {
            at(i).accepted = true;
            accepted_ = at(i).target;
        }
    }
}

void Motion::begin(SimTime now, EventQueue& events) {
    // Starts the front step if none is under way; steps without duration are done on the spot.
    while (count_ != 0 && step_end_ == never && planner_.empty()) {
        Step& step = at(0);
        const bool travels = step.what.kind == Kind::to || step.what.kind == Kind::by;
        if (travels && !step.accepted) {
            step.accepted = true;
            accepted_ = step.target;
        }
        if (step.what.feed_mm_s > 0) {
            shown_feed_ = step.buffered ? step.what.feed_mm_s * speed_percent_ / 100.0 : step.what.feed_mm_s;
        }
        const double seconds = duration_s(step);
        if (seconds > 0) {
            step_end_ = now + from_seconds(std::min(seconds, 86400.0));
            return;
        }
        finish(events);
    }
}

void Motion::stream(const AxisValues& target, double feed_mm_s, std::uint64_t byte) {
    AxisValues inside = target;
    for (std::size_t i = 0; i < config_.volume_mm.size(); ++i) {
        inside[i] = std::clamp(sane(target[i]), 0.0, config_.volume_mm[i]);
    }
    inside[e_axis] = std::isfinite(target[e_axis]) ? sane(target[e_axis], far_e_mm) : executed_[e_axis];
    motors_ = true;
    planner_.add({executed_, inside, feed_mm_s, byte});
    planned_ = accepted_ = inside;
}

void Motion::tell_travel(const AxisValues& to) const {
    const bool moves = to[0] != executed_[0] || to[1] != executed_[1];
    if (moves) {
        travelled_({executed_[0], executed_[1], to[0], to[1], to[2], to[3] > executed_[3]});
    }
}

void Motion::start_stream(SimTime now) {
    if (!planner_.empty() && !planner_.running()) {
        planner_.start(now);
        shown_feed_ = planner_.feed_mm_s();
    }
}

void Motion::advance(SimTime now, EventQueue& events) {
    while (planner_.running() && planner_.end() <= now) {
        const SimTime end = planner_.end();
        extruded_ += planner_.target()[3] - executed_[3];
        if (travelled_) {
            tell_travel(planner_.target());
        }
        executed_ = planner_.target();
        planner_.finish();
        if (planner_.empty()) {
            begin(end, events);
        } else if (end < now) {
            start_stream(end);
        }
    }
    while (count_ != 0 && step_end_ <= now) {
        const SimTime end = step_end_;
        finish(events);
        begin(end, events);
    }
}

void Motion::finish(EventQueue& events) {
    const Step step = at(0);
    if (fails(step, events)) {
        return;
    }
    head_ = (head_ + 1) % capacity;
    --count_;
    step_end_ = never;
    std::uint8_t mask = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        mask = static_cast<std::uint8_t>(mask | (step.what.values[i] ? 1U << i : 0U));
    }
    for (std::size_t i = 0; i < offset_.size(); ++i) {
        if ((mask & (1U << i)) == 0) {
            continue;
        }
        if (step.what.kind == Kind::zero) {
            offset_[i] += executed_[i];
        } else if (step.what.kind == Kind::home || step.what.kind == Kind::homed) {
            offset_[i] = 0;
        }
    }
    extruded_ += step.target[3] - executed_[3];
    executed_ = step.target;
    switch (step.what.kind) {
        case Kind::probe:
            note_probed(step, events);
            accepted_ = step.target;
            break;
        case Kind::zero:
        case Kind::home:
            accepted_ = step.target;
            break;
        case Kind::homed:
            homed_ |= mask;
            babystep_ = 0;  // measured: every G28 drops it
            break;
        case Kind::lose_rounds:
            lost_rounds_ += step.what.rounds;
            break;
        case Kind::raise:
            events.raise(step.what.event);
            break;
        default:
            break;
    }
    accept_ahead();
}

void Motion::note_probed(const Step& step, EventQueue& events) {
    const double height = step.target[z_axis] - config_.probe_trigger_mm;
    probed_ = {step.target[0] + config_.probe_offset_mm[0], step.target[1] + config_.probe_offset_mm[1],
               height};
    if (step.what.mesh_point >= 0) {
        mesh.mm[static_cast<std::size_t>(step.what.mesh_point)] = height;
    }
    if (step.what.repeats) {
        series.add(height, config_.probe_spread_mm);
        events.raise(event("motion.touched"));
    }
}

bool Motion::fails(const Step& step, EventQueue& events) {
    const bool probes = step.what.kind == Kind::probe;
    bool failed = probes && (faults_.probe_alarm || dead_endstop(z_axis));
    for (std::size_t i = 0; i < 3 && step.what.kind == Kind::home; ++i) {
        failed = failed || (step.what.values[i] && dead_endstop(i));
    }
    if (failed) {
        abort();
        homed_ = 0;
        events.raise(probes && faults_.probe_alarm ? event("leveling.probe_alarm")
                                                   : event("motion.homing_failed"));
    }
    return failed;
}

double Motion::duration_s(const Step& step) const {
    if (step.what.kind == Kind::probe && faults_.probe_alarm) {
        return 0;  // it is not even tried
    }
    if (step.what.kind == Kind::probe && dead_endstop(z_axis)) {
        return config_.volume_mm[z_axis] / std::max(shown_feed_, 0.01);
    }
    if (step.what.seconds >= 0) {
        return step.what.seconds;
    }
    if (step.what.kind == Kind::home) {
        return homing_s(step.what);
    }
    double square = 0;
    double feed = std::max(shown_feed_, 0.01);
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double way = std::abs(step.target[i] - executed_[i]);
        square += i < 3 ? way * way : 0;
        if (way > 0 && step.buffered) {
            feed = std::min(feed, std::max(settings_.velocity_mm_s[i], 0.01));
        }
    }
    if (step.what.kind != Kind::to && step.what.kind != Kind::by) {
        return 0;
    }
    const double extruded = std::abs(step.target[3] - executed_[3]);
    const double distance = square > 0 ? std::sqrt(square) : extruded;
    return trapezoid_s(distance, feed, std::max(settings_.acceleration_mm_s2, 1.0));
}

/// Time to run into the end stops; up to the one that is dead, if one is.
double Motion::homing_s(const ProcedureStep& step) const {
    const double bump_s = step.bump_s >= 0 ? step.bump_s : config_.homing_bump_s;
    double seconds = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (step.values[i] && dead_endstop(i)) {
            return seconds + config_.volume_mm[i] / config_.homing_feed_mm_s;
        }
        if (step.values[i]) {
            const double way_s = std::abs(executed_[i] + offset_[i]) / config_.homing_feed_mm_s + bump_s;
            seconds = step.together ? std::max(seconds, way_s) : seconds + way_s;
        }
    }
    return seconds;
}

/// Bilinear in the 3 x 3 mesh over the build area.
double Motion::bed_height_mm(double x, double y) const {
    const auto place = [](double mm, double size) {
        return std::clamp(mm / std::max(size, 1.0), 0.0, 1.0) * 2.0;
    };
    const double u = place(x, config_.volume_mm[0]);
    const double v = place(y, config_.volume_mm[1]);
    const auto column = static_cast<std::size_t>(std::min(u, 1.0));
    const auto row = static_cast<std::size_t>(std::min(v, 1.0));
    const double fu = u - static_cast<double>(column);
    const double fv = v - static_cast<double>(row);
    const auto& bed = config_.bed_mesh_mm;
    const double front = bed[row][column] * (1 - fu) + bed[row][column + 1] * fu;
    const double back = bed[row + 1][column] * (1 - fu) + bed[row + 1][column + 1] * fu;
    return front * (1 - fv) + back * fv;
}

}  // namespace fauxboard::filament
