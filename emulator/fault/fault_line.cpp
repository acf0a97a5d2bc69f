#include "emulator/fault/fault_line.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace fauxboard::fault {

Json status_to_json(const FaultStatus& status) {
    return {{"id", status.id},
            {"fault", fault_to_json(status.spec)},
            {"seen", status.seen},
            {"acted", status.acted},
            {"over", status.over}};
}

FaultLine::Fault::Fault(FaultId new_id, const FaultSpec& new_spec, Direction direction, SimTime now)
    : id(new_id), spec(new_spec), judge(spec, direction, now) {
    if (spec.kind->interrupt != nullptr) {
        interruption = spec.kind->interrupt(spec.values);
        announced = !spec.trigger.by_line();
        if (announced) {
            dead_from = judge.begin();
            dead_until = dead_from + interruption.length;
        }
    }
}

// --- the list of faults ---

std::size_t FaultLine::find(FaultId id) const {
    const auto hit =
        std::find_if(faults_.begin(), faults_.end(), [id](const Fault& f) { return f.id == id; });
    return static_cast<std::size_t>(hit - faults_.begin());
}

FaultId FaultLine::add(SimTime now, const FaultSpec& spec) {
    const FaultId id = last_id_ + 1;
    put(now, id, spec);
    return id;
}

void FaultLine::put(SimTime now, FaultId id, const FaultSpec& spec) {
    advance(now);
    const std::size_t index = find(id);
    Fault fault(id, spec, direction_, now_);
    if (index != faults_.size()) {
        drain(index);
        faults_[index] = std::move(fault);
    } else {
        if (faults_.size() >= most_faults) {
            throw FaultSpecError(
                {"found " + std::to_string(most_faults) +
                 " faults on this line already; expected fewer: remove one before adding another"});
        }
        const auto place =
            std::find_if(faults_.begin(), faults_.end(), [id](const Fault& f) { return f.id > id; });
        faults_.insert(place, std::move(fault));
    }
    last_id_ = std::max(last_id_, id);
    advance(now_);  // an interruption may begin now
}

bool FaultLine::change(SimTime now, FaultId id, const FaultSpec& spec) {
    if (!has(id)) {
        return false;
    }
    put(now, id, spec);
    return true;
}

bool FaultLine::remove(SimTime now, FaultId id) {
    advance(now);
    const std::size_t index = find(id);
    if (index == faults_.size()) {
        return false;
    }
    drain(index);
    faults_.erase(faults_.begin() + static_cast<std::ptrdiff_t>(index));
    flush_if_idle();
    return true;
}

void FaultLine::clear(SimTime now) {
    advance(now);
    while (!faults_.empty()) {
        drain(faults_.size() - 1);  // what is nearest to the way out goes first
        faults_.pop_back();
    }
    flush_if_idle();
}

void FaultLine::drain(std::size_t index) {
    PaceQueue& queue = faults_[index].queue;
    while (!queue.empty()) {
        Piece piece = queue.take_rest();
        piece.time = now_;
        pace_from(index + 1, std::move(piece));
    }
}

std::vector<FaultStatus> FaultLine::list(SimTime now) const {
    std::vector<FaultStatus> out;
    for (const Fault& fault : faults_) {
        const Judge& judge = fault.judge;
        const bool dead_yet = fault.dead_from != machine::never && now < fault.dead_until;
        out.push_back({fault.id, fault.spec, judge.seen(), judge.acted(), judge.over(now) && !dead_yet, {}});
        out.back().by[static_cast<std::size_t>(direction_)] = {judge.seen(), judge.acted()};
    }
    return out;
}

// --- time ---

bool FaultLine::cuts_link(SimTime time) const {
    return std::any_of(faults_.begin(), faults_.end(), [time](const Fault& fault) {
        return fault.interruption.link_down && time >= fault.dead_from && time < fault.dead_until;
    });
}

std::size_t FaultLine::held() const {
    std::size_t sum = cutter_.held();
    for (const Fault& fault : faults_) {
        sum += fault.queue.held();
    }
    return sum;
}

/// True while lines have to be taken one by one; false: bytes may pass as they come.
bool FaultLine::shapes_lines() const {
    return std::any_of(faults_.begin(), faults_.end(), [this](const Fault& fault) {
        return !fault.queue.empty() || (fault.acting && cutter_.in_rest()) ||
               (fault.spec.kind->interrupt == nullptr && fault.judge.in_force(now_));
    });
}

SimTime FaultLine::next_work() const {
    SimTime due = cutter_.due();
    for (const Fault& fault : faults_) {
        due = std::min(due, fault.announced ? fault.dead_from : fault.queue.due());
    }
    return due;
}

/// Does one thing that is due now.
void FaultLine::work() {
    // The nearest to the way out first, so that what left a queue earlier is not overtaken.
    for (std::size_t i = faults_.size(); i-- != 0;) {
        Fault& fault = faults_[i];
        if (fault.announced && fault.dead_from <= now_) {
            fault.announced = false;
            fault.judge.act();
            return;
        }
        if (fault.queue.due() <= now_) {
            return pace_from(i + 1, fault.queue.take());
        }
    }
    cutter_.flush([this](Piece&& piece) { edit_from(0, std::move(piece)); });
}

SimTime FaultLine::advance(SimTime now) {
    const SimTime end = later(now);
    for (SimTime due = next_work(); due <= end; due = next_work()) {
        now_ = std::max(now_, due);
        work();
    }
    now_ = end;
    flush_if_idle();
    SimTime next = next_work();
    for (const Fault& fault : faults_) {
        if (fault.interruption.link_down && dead(fault)) {
            next = std::min(next, fault.dead_until);
        }
    }
    return next;
}

// --- bytes ---

void FaultLine::push(SimTime now, std::string_view bytes) {
    if (faults_.empty() && (peer_ == nullptr || peer_->faults_.empty())) {
        now_ = later(now);
        pass(bytes);
        in_line_ = LineCutter::ends_in_line(bytes, in_line_);
        return;
    }
    advance(now);
    Fault* interruption = nullptr;
    const std::size_t size = link_up() ? admitted(bytes, interruption) : 0;
    in_line_ = LineCutter::ends_in_line(bytes, in_line_);
    bytes_lost_ += bytes.size() - size;
    bytes = bytes.substr(0, size);
    if (shapes_lines()) {
        cutter_.feed(now_, bytes, [this](Piece&& piece) { edit_from(0, std::move(piece)); });
        flush_if_idle();
    } else {
        pass(bytes);
    }
    if (interruption != nullptr) {
        while (next_work() <= now_) {
            work();  // what came before the line that brings it is through
        }
        interruption->dead_from = now_;
        interruption->dead_until = now_ + interruption->interruption.length;
    }
}

void FaultLine::flush_if_idle() {
    if (cutter_.held() != 0 && !shapes_lines()) {
        cutter_.flush([this](Piece&& piece) { edit_from(0, std::move(piece)); });
    }
}

void FaultLine::pass(std::string_view bytes) {
    for (Fault& fault : faults_) {
        fault.acting = false;
    }
    cutter_.passed(bytes);
    output_.append(bytes);
}

/// How many of the bytes get past silence and disconnection: none, all, or those up to a line that begins
/// one, which is `begins` then.
std::size_t FaultLine::admitted(std::string_view bytes, Fault*& begins) {
    bool judges = false;
    for (const Fault& fault : faults_) {
        if (dead(fault)) {
            tell(fault, bytes);
            return 0;
        }
        judges = judges || (fault.spec.trigger.by_line() && fault.spec.kind->interrupt != nullptr);
    }
    if (!judges) {
        return bytes.size();
    }
    std::size_t at = in_line_ ? bytes.find_first_of(LineCutter::line_ends) : 0;
    while (true) {
        at = bytes.find_first_not_of(LineCutter::gaps, at);
        if (at >= bytes.size()) {
            return bytes.size();
        }
        begins = interrupted_by_line();
        if (begins != nullptr) {
            tell(*begins, bytes.substr(at));
            return at;
        }
        at = bytes.find_first_of(LineCutter::line_ends, at);
    }
}

/// A line begins; the fault that makes the line dead with it, or null.
FaultLine::Fault* FaultLine::interrupted_by_line() {
    for (Fault& fault : faults_) {
        if (fault.spec.kind->interrupt == nullptr || !fault.spec.trigger.by_line() ||
            !fault.judge.in_force(now_)) {
            continue;
        }
        if (fault.judge.line()) {
            return &fault;
        }
    }
    return nullptr;
}

void FaultLine::edit_from(std::size_t index, Piece piece) {
    if (index == 0) {
        room_ = most_growth;
    }
    for (; index < faults_.size() && !piece.gap; ++index) {
        Fault& fault = faults_[index];
        const Kind& kind = *fault.spec.kind;
        if (kind.edit == nullptr) {
            continue;
        }
        LineEdit line{std::move(piece.bytes), piece.first, 1, room_};
        if (line.first) {
            fault.acting = fault.judge.in_force(piece.time) &&
                           (kind.applies == nullptr || kind.applies(line)) && fault.judge.line();
        }
        const std::size_t size = line.bytes.size();
        if (fault.acting && line.first) {
            tell(fault, line.bytes);
        }
        if (fault.acting) {
            kind.edit(line, fault.spec.values, fault.judge.dice());
        }
        if (line.bytes.empty()) {
            return;
        }
        const std::size_t grown = line.bytes.size() - std::min(line.bytes.size(), size);
        room_ -= std::min(room_, grown + (line.copies - 1) * line.copy_cost());
        piece.bytes = std::move(line.bytes);
        for (; line.copies > 1; --line.copies) {
            edit_from(index + 1, piece);
        }
    }
    pace_from(0, std::move(piece));
}

void FaultLine::pace_from(std::size_t index, Piece piece) {
    for (; index < faults_.size(); ++index) {
        Fault& fault = faults_[index];
        const Kind& kind = *fault.spec.kind;
        if (kind.pace == nullptr) {
            continue;
        }
        if (piece.first && !piece.gap) {
            fault.acting = fault.judge.in_force(piece.time) && fault.judge.line();
            if (fault.acting) {
                tell(fault, piece.bytes);
            }
            fault.pace = fault.acting ? kind.pace(fault.spec.values, fault.judge.dice()) : Pace{};
        }
        if (!fault.acting && fault.queue.empty()) {
            continue;
        }
        const std::size_t size = std::min(piece.bytes.size(), most_held - std::min(most_held, held()));
        bytes_overflowed_ += piece.bytes.size() - size;
        piece.bytes.resize(size);
        if (size != 0) {
            fault.queue.put(std::move(piece), fault.pace);
        }
        return;
    }
    leave(piece.bytes);
}

void FaultLine::tell(const Fault& fault, std::string_view bytes) const {
    if (told_) {
        bytes.remove_prefix(std::min(bytes.find_first_not_of(LineCutter::line_ends), bytes.size()));
        told_({fault.id, direction_, fault.spec.kind->name,
               bytes.substr(0, bytes.find_first_of(LineCutter::line_ends))});
    }
}

void FaultLine::leave(std::string_view bytes) {
    if (link_up()) {
        output_.append(bytes);
    } else {
        bytes_lost_ += bytes.size();
    }
}

}  // namespace fauxboard::fault
