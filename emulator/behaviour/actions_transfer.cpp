// A file onto the chosen disk, or off it, piece by piece. Each leaves what became of it in transfer.outcome.

#include <array>

#include "emulator/behaviour/action_rows.h"
#include "emulator/behaviour/action_tables.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum ArgType;
using machine::Transfer;

/// The place in a file that a request names; beyond every file when it is none.
std::uint64_t place(const Value& v) {
    return v.number >= 0 && v.number < static_cast<double>(Transfer::max_bytes)
               ? static_cast<std::uint64_t>(v.number)
               : Transfer::max_bytes;
}

/// The file that must not change: the one being printed.
std::string_view in_use(const machine::Machine& p) {
    return p.job.active() && p.job.volume() == p.storage.chosen() ? std::string_view(p.job.path())
                                                                  : std::string_view{};
}

void upload(ActionContext& c, Args a) {
    Transfer& transfer = c.machine.transfer;
    if (!transfer.upload(c.machine.now(), transfer.asker, text_or_none(a[0]), in_use(c.machine)) &&
        transfer.outcome == Transfer::Outcome::write_failed && c.machine.storage.fixed_volume() != nullptr) {
        refuse(c, "the profile's own card can be read only; give a folder as the card with --sd");
    }
}

void finish(ActionContext& c, Args) {
    c.machine.transfer.finish(c.machine.now(), c.machine.transfer.asker, in_use(c.machine));
}

void download(ActionContext& c, Args a) {
    c.machine.transfer.download(c.machine.now(), c.machine.transfer.asker, text_or_none(a[0]));
}

void block(ActionContext& c, Args a) {
    Transfer& transfer = c.machine.transfer;
    transfer.last_block.size = 0;
    if (!a[0].is_number() || transfer.seek(c.machine.now(), transfer.asker, place(a[0]))) {
        transfer.block(c.machine.now(), transfer.asker, transfer.last_block.room, transfer.last_block.size);
    }
}

void remove(ActionContext& c, Args a) {
    c.machine.transfer.remove(text_or_none(a[0]));
}

constexpr std::array name_args{ArgInfo{"name", text, false, "of the file, from the root of the disk on"}};
constexpr std::array block_args{
    ArgInfo{"offset", number, false, "byte it begins at; if left out, the next one"}};

constexpr std::array table{
    ActionInfo{"transfer.upload", "", "begins to take a file in (M28); written beside until it is finished",
               name_args, upload},
    ActionInfo{"transfer.finish", "", "the upload is whole and takes its name (M29)", {}, finish},
    ActionInfo{"transfer.download", "", "begins to give a file out (M6032)", name_args, download},
    ActionInfo{"transfer.block", "", "reads a block of it, for a frame with \"chunk\" (M3000, M3001)",
               block_args, block},
    ActionInfo{"transfer.remove", "", "deletes a file of the chosen disk (M30)", name_args, remove},
    ActionInfo{
        "transfer.close",
        "",
        "closes what is open (M22); of an upload nothing remains",
        {},
        [](ActionContext& c, Args) { c.machine.transfer.close(c.machine.now(), c.machine.transfer.asker); }},
};

}  // namespace

std::span<const ActionInfo> transfer_actions() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
