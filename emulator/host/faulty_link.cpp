#include "emulator/host/faulty_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "emulator/fault/kind.h"

namespace fauxboard::host {
namespace {

using link::LinkState;

constexpr SimTime retry_period{500'000};

/// "acted once", "acted 5 times on 10 lines".
std::string deeds(const fault::FaultStatus::Counts& counts) {
    const std::string lines = fmt::format("{} line{}", counts.seen, counts.seen == 1 ? "" : "s");
    if (counts.acted == 0) {
        return counts.seen == 0 ? "never acted" : "acted on none of " + lines;
    }
    const std::string times = counts.acted == 1 ? "acted once" : fmt::format("acted {} times", counts.acted);
    return counts.seen == 0 ? times : times + " on " + lines;
}

}  // namespace

FaultyLink::FaultyLink(link::Link& inner, Clock& clock, fault::Direction reads)
    : inner_(inner),
      clock_(clock),
      reads_to_board_(reads == fault::Direction::to_board),
      alarm_(clock.make_alarm([this] { ring(); })),
      describe_(inner.describe()),
      path_(inner.path()) {}

FaultyLink::~FaultyLink() {
    *alive_ = false;
}

// --- faults ---

fault::FaultId FaultyLink::add(const fault::FaultSpec& spec) {
    const fault::FaultId id = faults_.add(clock_.now(), spec);
    settle();
    return id;
}

bool FaultyLink::change(fault::FaultId id, const fault::FaultSpec& spec) {
    const bool found = faults_.change(clock_.now(), id, spec);
    settle();
    return found;
}

bool FaultyLink::remove(fault::FaultId id) {
    const bool found = faults_.remove(clock_.now(), id);
    settle();
    return found;
}

void FaultyLink::clear() {
    faults_.clear(clock_.now());
    settle();
}

// --- the link ---

void FaultyLink::open_inner() {
    inner_.open(*this);
    connected_ = true;
    inner_.hold(held_);
    describe_ = inner_.describe();
    path_ = inner_.path();
}

void FaultyLink::open(link::LinkListener& listener) {
    listener_ = &listener;
    held_ = false;
    try {
        open_inner();
    } catch (...) {
        listener_ = nullptr;
        throw;
    }
    // A disconnection that lasts already begins on the loop's next turn: whoever opens learns the path first.
    alarm_->at(clock_.now());
}

void FaultyLink::close() {
    listener_ = nullptr;
    alarm_->at(machine::never);
    news_.clear();
    complained_ = false;
    incoming().clear_output();
    if (std::exchange(connected_, false)) {
        inner_.close();
    }
}

LinkState FaultyLink::state() const {
    return listener_ == nullptr ? LinkState::opening : connected_ ? inner_.state() : LinkState::waiting;
}

const link::LinkStats& FaultyLink::stats() const {
    stats_ = inner_.stats();
    stats_.bytes_lost += bytes_refused_;
    stats_.writes_lost += writes_refused_;
    return stats_;
}

void FaultyLink::hold(bool held) {
    held_ = held;
    if (connected_) {
        inner_.hold(held);
    }
    if (!held && !incoming().output().empty()) {
        alarm_->at(clock_.now());
    }
}

void FaultyLink::write(std::string_view message) {
    if (faults_.empty() && connected_) {
        outgoing().passed(message);
        inner_.write(message);
        return;
    }
    if (!connected_) {
        ++writes_refused_;
        bytes_refused_ += message.size();
    }
    outgoing().push(clock_.now(), message);
    settle();
}

void FaultyLink::on_bytes(std::string_view bytes) {
    if (faults_.empty() && incoming().output().empty()) {
        incoming().passed(bytes);
        listener_->on_bytes(bytes);
        return;
    }
    incoming().push(clock_.now(), bytes);
    ring();
}

void FaultyLink::on_state(LinkState state, std::string_view why) {
    listener_->on_state(state, why);
}

void FaultyLink::on_drained() {
    listener_->on_drained();
}

// --- what faults do ---

/// Does what is due without a word to the listener, who hears of it when the alarm rings.
void FaultyLink::settle() {
    const SimTime now = clock_.now();
    send();  // what came through before a disconnection
    SimTime next = faults_.advance(now);
    send();
    if (listener_ == nullptr) {
        return;
    }
    if (connected_ && !faults_.connected(now)) {
        take_away();
    } else if (!connected_ && faults_.connected(now)) {
        next = std::min(next, std::max(now, retry_));
    }
    if (!news_.empty() || (!held_ && !incoming().output().empty())) {
        next = now;
    }
    alarm_->at(next);
}

void FaultyLink::send() {
    if (!outgoing().output().empty()) {
        if (connected_) {
            inner_.write(outgoing().output());
        }
        outgoing().clear_output();
    }
}

void FaultyLink::take_away() {
    connected_ = false;
    retry_ = SimTime{0};
    inner_.close();
    news_.emplace_back("a fault disconnects the line");
}

void FaultyLink::bring_back() {
    try {
        open_inner();
        news_.push_back("the line is connected again: " + describe_);
        complained_ = false;
    } catch (const link::LinkError& error) {
        retry_ = clock_.now() + retry_period;
        if (!std::exchange(complained_, true)) {
            news_.push_back(fmt::format("the line does not come back yet: {}", error.what()));
        }
    }
}

void FaultyLink::ring() {
    const auto alive = alive_;
    settle();
    if (!connected_ && faults_.connected(clock_.now()) && clock_.now() >= retry_) {
        bring_back();
    }
    for (const std::string& why : std::exchange(news_, {})) {
        listener_->on_state(state(), why);
        if (!*alive || listener_ == nullptr) {
            return;
        }
    }
    deliver();
    if (*alive && listener_ != nullptr) {
        settle();
    }
}

void FaultyLink::deliver() {
    const auto alive = alive_;
    while (*alive && listener_ != nullptr && !held_ && !incoming().output().empty()) {
        const std::string bytes(incoming().output());
        incoming().clear_output();
        std::string_view rest = bytes;
        while (!rest.empty()) {
            const std::string_view piece = rest.substr(0, read_limit);
            rest.remove_prefix(piece.size());
            listener_->on_bytes(piece);
            if (!*alive || listener_ == nullptr) {
                return;
            }
        }
    }
}

std::string fault_sentence(const fault::FaultStatus& status) {
    const std::string name = fmt::format("Fault {}, {}, ", status.id, fault::fault_to_text(status.spec));
    const auto& [to_screen, to_board] = status.by;
    const bool one_event = status.seen == 0 && status.acted < 2;
    if (status.spec.direction != fault::Direction::both || one_event) {
        return name + deeds({status.seen, status.acted}) + ".";
    }
    if (to_screen == to_board) {
        return name + deeds(to_screen) + " in each direction.";
    }
    const std::string_view other = status.spec.line == fault::Line::usb ? "host" : "screen";
    return fmt::format("{}{} to the {}, {} to the board.", name, deeds(to_screen), other, deeds(to_board));
}

}  // namespace fauxboard::host
