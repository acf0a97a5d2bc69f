#pragma once

#include <array>

#include "emulator/machine/events.h"

namespace fauxboard::machine {

/// What may happen to a machine of any kind.
inline constexpr auto common_events = std::to_array<EventInfo>({
    {"motion.homed", "a full homing run has ended; X, Y and Z are known"},
    {"motion.homing_failed", "an end stop did not trigger; what was still to be done is dropped"},
    {"card.inserted", "the SD card or the U-disk was put in"},
    {"card.removed", "the SD card or the U-disk was taken out"},
    {"card.found", "after power-on the board found an SD card (machine.card.found_s)"},
    {"card.missing", "after power-on the board found that there is no SD card"},
    {"card.failed", "the SD card or the U-disk can no longer be read"},
    {"file.selected", "a file to print was selected"},
    {"file.missing", "the file to select does not exist"},
    {"file.unreadable", "the file to select cannot be opened"},
    {"job.started", "the selected file starts to print"},
    {"job.pausing", "a pause was asked for again while the first one is under way"},
    {"job.paused", "the job has come to rest with the head parked"},
    {"job.resumed", "a paused job goes on"},
    {"job.stopped", "the job was stopped before its end"},
    {"job.replaced", "the job ended before its end because another file was selected"},
    {"job.finished", "the job reached its end"},
    {"job.closed", "the finished job is no longer shown; the board is idle"},
    {"job.refused", "what was asked for cannot be done while a job is under way"},
    {"job.file_lost", "the file being printed is gone; the job pauses and resuming tries again"},
    {"job.file_unreadable",
     "the file being printed is there and cannot be read; the job pauses and resuming tries again"},
    {"job.message", "the file being printed has a message (M117): job.message"},
    {"job.waits_for_user",
     "the file being printed, or the USB side, waits for the user (M0, M1, M600); resuming goes on"},
    {"job.line_too_long",
     "a line of the file being printed is longer than 1024 bytes; the rest of it is passed over"},
    {"host.done", "a command of the USB side is over, and nothing of its own has acknowledged it"},
    {"host.busy", "the USB side has been waiting for its command for machine.host.busy_s"},
    {"host.unknown", "the USB side sent a command that nobody knows: host.command"},
    {"host.wrong_number", "a line of the USB side has not the number after host.last_line"},
    {"host.wrong_checksum", "a line of the USB side has a wrong checksum"},
    {"host.no_checksum", "a numbered line of the USB side has no checksum"},
    {"host.no_number", "a line of the USB side has a checksum and no number"},
    {"host.overflow", "a line of the USB side had no room, and is lost"},
    {"host.write_failed",
     "the disk does not take what the USB side writes to a file (M28); its lines go nowhere until M29"},
    {"board.killed", "the board stops for good (M112): what is sent now is the last before a reset"},
    {"power.lost", "the supply breaks down; there is still time to store what must be kept"},
    {"job.layer_done", "a layer has been exposed"},
    {"timer.over", "the time that timer.start was given has passed"},
    {"transfer.piece",
     "a piece of an uploaded file came in; transfer.outcome says what became of it, and what is sent goes to "
     "its "
     "sender"},
});

/// The row of that name in one of the tables. A name that is in none does not compile.
template <class... Tables>
consteval EventId event_in(std::string_view name, const Tables&... tables) {
    EventId hit = nullptr;
    const auto look = [&](const auto& table) {
        for (const EventInfo& row : table) {
            hit = row.name == name ? &row : hit;
        }
    };
    (look(tables), ...);
    return hit != nullptr ? hit : throw "no event has this name";
}

/// The event of all machines that has this name.
consteval EventId event(std::string_view name) {
    return event_in(name, common_events);
}

}  // namespace fauxboard::machine
