// What can go wrong with every machine: a table, and the functions that break something and mend it.

#include <array>

#include "emulator/machine/event_rows.h"
#include "emulator/machine/faults.h"
#include "emulator/machine/machine.h"

namespace fauxboard::machine {
namespace {

using Values = const FaultValues&;
using enum FaultUnit;

constexpr std::array<std::string_view, 2> disks{"sd", "udisk"};

constexpr std::array disk_only{FaultParameter{"disk", choice, 0, 0, 1, "which disk", disks}};

constexpr std::array<std::string_view, 2> ways{"piece", "answer"};
constexpr std::array lost_parameters{
    FaultParameter{"what", choice, 0, 0, 1,
                   "a piece of an upload, or what the board answers to it; a block of a download is both",
                   ways},
    FaultParameter{"share", percent, 10, 1, 100, "how many of them"}};
constexpr std::array share_only{FaultParameter{"share", percent, 10, 1, 100, "how many of them"}};

constexpr std::array card_failed_event{event("card.failed")};
constexpr std::array card_removed_event{event("card.removed")};
constexpr std::array job_refused_event{event("job.refused")};
constexpr std::array job_waits_for_user_event{event("job.waits_for_user")};
constexpr std::array power_lost_event{event("power.lost")};
constexpr std::array missing_events{event("file.missing"), event("job.file_lost")};
constexpr std::array unreadable_events{event("file.unreadable"), event("job.file_unreadable")};

int disk(Values v) {
    return static_cast<int>(v[0]);
}

void file_trouble(Machine& p, Volume::Kind kind) {
    p.storage.set_file_trouble(kind);
}

double& lost_share(Machine& p, Values v) {
    Transfer::Trouble& trouble = p.transfer.trouble;
    return v[0] == 0 ? trouble.lost : trouble.answers_lost;
}

void ask_for_user(Machine& p, Values) {
    p.job.waits_for_user = true;
    if (p.job.status() == JobStatus::printing && !p.job.pausing()) {
        p.pause_job(false);
    }
    p.events.raise(event("job.waits_for_user"));
}

constexpr auto table = std::to_array<FaultInfo>({
    {"card_removed", "a disk is pulled out; a job that prints from it pauses", card_removed_event,
     "card.insert, udisk.insert (\"card in\")", disk_only, never,
     [](Machine& p, Values v) { p.remove_card(disk(v)); },
     [](Machine& p, Values v) { p.insert_card(disk(v)); },
     [](const Machine& p, Values v) { return p.storage.usable(disk(v)); }},
    {"card_failed", "a disk stays in its slot and can no longer be read; a job that prints from it pauses",
     card_failed_event, "card.insert, udisk.insert (\"card in\")", disk_only, never,
     [](Machine& p, Values v) { p.fail_card(disk(v)); }, [](Machine& p, Values v) { p.insert_card(disk(v)); },
     [](const Machine& p, Values v) { return p.storage.usable(disk(v)); }},
    {"file_missing",
     "files are still listed, and are not there when they are selected or read on; a job that prints pauses",
     missing_events,
     "",
     {},
     never,
     [](Machine& p, Values) { file_trouble(p, Volume::Kind::missing); },
     [](Machine& p, Values) { file_trouble(p, Volume::Kind::file); },
     nullptr},
    {"file_unreadable",
     "files cannot be opened or read on; a job that prints pauses",
     unreadable_events,
     "",
     {},
     never,
     [](Machine& p, Values) { file_trouble(p, Volume::Kind::unreadable); },
     [](Machine& p, Values) { file_trouble(p, Volume::Kind::file); },
     nullptr},
    {"refused",
     "the board takes itself for printing and refuses to select a file or to start one",
     job_refused_event,
     "a reset",
     {},
     never,
     [](Machine& p, Values) { p.refusing = true; },
     [](Machine& p, Values) { p.refusing = false; },
     [](const Machine& p, Values) { return !p.refusing; }},
    {"wait_for_user",
     "the board waits for the user to continue; a job that prints pauses where it is",
     job_waits_for_user_event,
     "job.continue (M0, M108); a reset",
     {},
     never,
     ask_for_user,
     [](Machine& p, Values) { p.user_continues(); },
     [](const Machine& p, Values) { return !p.job.waits_for_user; }},
    {"hang",
     "the board's program stands still: it hears and says nothing, and its heaters stay as they are; its "
     "end, by \"for\" or by taking it away, is a reset, as by a watchdog",
     {},
     "board.reset (\"board reset\")",
     {},
     never,
     [](Machine& p, Values) { p.hang(true); },
     [](Machine& p, Values) { p.request_reset(3); },
     [](const Machine& p, Values) { return !p.hung(); }},
    {"board_reset",
     "the board restarts; a job is lost",
     {},
     "",
     {},
     never,
     [](Machine& p, Values) { p.request_reset(1); },
     nullptr,
     nullptr},
    {"brown_out",
     "the supply breaks down, for half a second unless \"for\" says otherwise; the board notices in time to "
     "keep its job, and then restarts",
     power_lost_event,
     "",
     {},
     SimTime{500'000},
     [](Machine& p, Values) {
         p.events.raise(event("power.lost"));
         p.hang(false);
     },
     [](Machine& p, Values) { p.request_reset(2); },
     [](const Machine& p, Values) { return !p.hung(); }},
    {"chunk_lost",
     "the network loses pieces of files, up or down, or the answers to them: their sender has to notice",
     {},
     "",
     lost_parameters,
     never,
     [](Machine& p, Values v) { lost_share(p, v) = v[1] / 100; },
     [](Machine& p, Values v) { lost_share(p, v) = 0; },
     nullptr},
    {"chunk_damaged",
     "pieces of files arrive damaged: the board asks for one again (resend), a client has to find it out",
     {},
     "",
     share_only,
     never,
     [](Machine& p, Values v) { p.transfer.trouble.damaged = v[0] / 100; },
     [](Machine& p, Values) { p.transfer.trouble.damaged = 0; },
     nullptr},
    {"chunk_repeated",
     "pieces of files arrive twice: the board does not write the second (resend), a client must not",
     {},
     "",
     share_only,
     never,
     [](Machine& p, Values v) { p.transfer.trouble.repeated = v[0] / 100; },
     [](Machine& p, Values) { p.transfer.trouble.repeated = 0; },
     nullptr},
});

consteval bool all_fit() {
    for (const FaultInfo& row : table) {
        if (row.parameters.size() > FaultValues{}.size()) {
            return false;
        }
    }
    return true;
}
static_assert(all_fit(), "the values of all parameters fit");

}  // namespace

std::span<const FaultInfo> common_faults() {
    return table;
}

}  // namespace fauxboard::machine
