#include "tests/support/resin_bench.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "emulator/fault/kind.h"
#include "emulator/fault/printer_fault.h"
#include "tests/support/board_driver.h"

namespace fauxboard::testing {
namespace {

using machine::SimTime;

machine::Services services_of(MemoryDisk& disk, machine::EepromStore* eeprom) {
    machine::Services made;
    made.sd = &disk;
    made.eeprom = eeprom;
    return made;
}

}  // namespace

ResinBench::ResinBench(std::string_view profile, std::uint64_t room, machine::EepromStore* eeprom)
    : board(shipped_profile(profile), services_of(disk, eeprom), {}),
      pause_(profile == "chitu-4.4.3" ? SimTime{25'000} : SimTime{1'000}) {
    disk.set_room(room);
    board.power_on(now_);
    run_for(3);
    heard_.clear();
}

void ResinBench::fault(std::string_view spec) {
    const fault::FaultSpec made = fault::fault_from_text(spec);
    if (!fault::is_for_printer(made)) {
        faults_.add(now_, made);
        return;
    }
    board.tinker(now_,
                 [&](machine::Machine& p) { REQUIRE(p.faults.add(now_, fault::to_request(made)) != 0); });
    run_for(0);
}

void ResinBench::clear_faults() {
    faults_.clear(now_);
    board.tinker(now_, [](machine::Machine& p) { p.faults.clear(); });
    run_for(0);
}

/// Bytes of both directions, until none are left to carry at this moment.
void ResinBench::carry() {
    do {
        board.receive(now_, faults_.to_board().output());
        faults_.to_board().clear_output();
        due_ = board.advance(now_);
        faults_.to_screen().push(now_, board.output());
        board.clear_output();
    } while (due_ <= now_ || !board.output().empty());
    board.take_datagrams(
        [this](std::uint64_t peer, std::string_view bytes) { answers_.emplace_back(peer, bytes); });
    heard_ += faults_.to_screen().output();
    faults_.to_screen().clear_output();
}

void ResinBench::run_for(double seconds) {
    const SimTime end = now_ + machine::from_seconds(seconds);
    carry();
    while (now_ < end) {
        now_ = std::clamp(std::min(due_, faults_.advance(now_)), now_ + SimTime{1}, end);
        faults_.advance(now_);
        carry();
    }
}

std::string ResinBench::say(std::string_view bytes, double seconds) {
    heard_.clear();
    faults_.to_board().push(now_, bytes);
    run_for(seconds);
    return heard_;
}

std::vector<std::string> ResinBench::send(std::string_view datagram, std::uint64_t peer) {
    run_for(machine::to_seconds(pause_));
    answers_.clear();
    board.receive_datagram(now_, peer, datagram);
    run_for(0);
    std::vector<std::string> out;
    for (const auto& [to, text] : answers_) {
        CHECK(to == peer);
        out.push_back(text);
    }
    return out;
}

TransferClient ResinBench::client(TransferClient::Trouble trouble, std::uint64_t peer) {
    return {{[this, peer](std::string_view bytes) { send(bytes, peer); },
             [this] {
                 const std::string answer = answers_.empty() ? "" : answers_.front().second;
                 if (!answers_.empty()) answers_.pop_front();
                 return answer;
             }},
            trouble};
}

void ResinBench::world(std::string_view phrase) {
    REQUIRE(board.world(now_, phrase));
    run_for(0);
}

double ResinBench::number(std::string_view path) {
    board.refresh(now_);
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE(field != nullptr);
    return field->get(board.machine()).number;
}

std::string ResinBench::text(std::string_view path) {
    board.refresh(now_);
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE(field != nullptr);
    return std::string(field->get(board.machine()).text);
}

bool ResinBench::reaches(std::string_view path, double value, double seconds) {
    const SimTime end = now_ + machine::from_seconds(seconds);
    while (number(path) < value) {
        if (now_ >= end) {
            return false;
        }
        run_for(0.05);
    }
    return true;
}

}  // namespace fauxboard::testing
