#include "emulator/machine/transfer.h"

#include <array>
#include <utility>

#include "emulator/machine/storage.h"

namespace fauxboard::machine {

bool Transfer::say(Outcome result) {
    outcome = result;
    return result == Outcome::done;
}

void Transfer::power_on() {
    mode_ = Mode::none;
    outcome = Outcome::done;
    name_.clear();
    asked_.clear();
    asker = serial_line;
    last_block.size = 0;
    path_.clear();
    beside_.clear();
    replaced_.clear();
    existed_ = false;
    position_ = bytes_ = 0;
}

void Transfer::drop() {
    if (Volume* const disk = storage_.writable(disk_); mode_ == Mode::upload && disk != nullptr) {
        disk->remove(beside_);
    }
    mode_ = Mode::none;
}

bool Transfer::may_begin(SimTime now, Peer peer) {
    if (mode_ == Mode::none) {
        return true;
    }
    const bool left_alone = now - last_ >= idle_limit;
    if (peer == owner_ ? mode_ == Mode::upload && position_ != 0 && !left_alone : !left_alone) {
        return say(Outcome::busy);
    }
    drop();
    return true;
}

bool Transfer::may_go_on(SimTime now, Peer peer, Mode mode) {
    if (mode_ != mode) {
        return say(Outcome::not_open);
    }
    if (peer != owner_) {
        return say(Outcome::busy);
    }
    last_ = now;
    return true;
}

bool Transfer::look_for(std::string_view name) {
    const Storage::Found found = storage_.find(name);
    // find() also takes a checksum off a name; that one is another file.
    const bool there = found.kind == Volume::Kind::file && found.path.size() == path_.size();
    replaced_ = there ? found.path : std::string();
    return there;
}

bool Transfer::upload(SimTime now, Peer peer, std::string_view name, std::string_view in_use) {
    asked_ = name;
    if (!may_begin(now, peer)) {
        return false;
    }
    disk_ = storage_.chosen();
    name_ = name;
    Volume* const disk = storage_.writable(disk_);
    if (disk == nullptr) {
        return say(Outcome::no_disk);
    }
    if (!storage_.path_for_writing(name, path_)) {
        return say(Outcome::no_name);
    }
    existed_ = look_for(name);
    if (existed_ && replaced_ == in_use) {
        return say(Outcome::in_use);
    }
    beside_ = unfinished_path(*disk, path_);
    if (!disk->create(beside_)) {
        return say(Outcome::write_failed);
    }
    mode_ = Mode::upload;
    owner_ = peer;
    last_ = now;
    position_ = bytes_ = 0;
    return say(Outcome::done);
}

bool Transfer::piece(SimTime now, Peer peer, bool intact, std::uint64_t offset, std::string_view bytes) {
    if (!may_go_on(now, peer, Mode::upload)) {
        return false;
    }
    if (!intact || offset != position_) {
        return say(Outcome::resend);
    }
    Volume* const disk = storage_.writable(disk_);
    if (disk == nullptr || bytes.size() > max_bytes - position_ || !disk->append(beside_, position_, bytes)) {
        return say(Outcome::write_failed);
    }
    position_ += bytes.size();
    return say(Outcome::done);
}

bool Transfer::finish(SimTime now, Peer peer, std::string_view in_use) {
    if (!may_go_on(now, peer, Mode::upload)) {
        return false;
    }
    Volume* const disk = storage_.writable(disk_);
    if (!replaced_.empty() && replaced_ == in_use) {  // its print was begun meanwhile
        drop();
        return say(Outcome::in_use);
    }
    if (disk == nullptr || !disk->rename(beside_, path_)) {
        drop();
        return say(Outcome::write_failed);
    }
    if (!replaced_.empty() && replaced_ != path_) {
        disk->remove(replaced_);  // the same name to the board, spelled otherwise
    }
    mode_ = Mode::none;
    return say(Outcome::done);
}

bool Transfer::download(SimTime now, Peer peer, std::string_view name) {
    asked_ = name;
    if (!may_begin(now, peer)) {
        return false;
    }
    disk_ = storage_.chosen();
    name_ = name;
    if (storage_.volume(disk_) == nullptr) {
        return say(Outcome::no_disk);
    }
    const Storage::Found found = storage_.find(name);
    if (found.kind != Volume::Kind::file) {
        return say(Outcome::missing);
    }
    path_ = found.path;
    mode_ = Mode::download;
    owner_ = peer;
    last_ = now;
    position_ = 0;
    bytes_ = found.bytes;
    return say(Outcome::done);
}

bool Transfer::seek(SimTime now, Peer peer, std::uint64_t offset) {
    if (!may_go_on(now, peer, Mode::download)) {
        return false;
    }
    if (offset >= bytes_) {
        return say(Outcome::at_end);
    }
    position_ = offset;
    return say(Outcome::done);
}

bool Transfer::block(SimTime now, Peer peer, std::span<char> out, std::size_t& got) {
    got = 0;
    if (!may_go_on(now, peer, Mode::download)) {
        return false;
    }
    const Volume* const disk = storage_.volume(disk_);
    if (disk == nullptr) {
        return say(Outcome::no_disk);
    }
    const std::optional<std::size_t> read = disk->read(path_, position_, out);
    if (!read) {
        return say(Outcome::missing);
    }
    got = *read;
    position_ += got;
    return say(got == 0 ? Outcome::at_end : Outcome::done);
}

bool Transfer::remove(std::string_view name) {
    asked_ = name;
    std::string path;
    if (!storage_.usable(storage_.chosen())) {
        return say(Outcome::no_disk);
    }
    return say(clean_path({}, name, path) && storage_.remove("/" + path) ? Outcome::done : Outcome::missing);
}

bool Transfer::close(SimTime now, Peer peer) {
    if (mode_ == Mode::none) {
        return say(Outcome::done);
    }
    if (peer != owner_ && now - last_ < idle_limit) {
        return say(Outcome::busy);
    }
    drop();
    return say(Outcome::done);
}

Transfer::Mishap Transfer::Trouble::mishap(double draw) const {
    for (const auto& [share, what] :
         {std::pair{lost, Mishap::lost}, std::pair{answers_lost, Mishap::answer_lost},
          std::pair{damaged, Mishap::damaged}, std::pair{repeated, Mishap::repeated}}) {
        if (draw < share) {
            return what;
        }
        draw -= share;
    }
    return Mishap::none;
}

std::string_view to_string(Transfer::Outcome outcome) {
    constexpr std::array<std::string_view, 10> names{"done",         "busy",    "in_use",  "not_open",
                                                     "no_name",      "no_disk", "missing", "resend",
                                                     "write_failed", "at_end"};
    return names[static_cast<std::size_t>(outcome)];
}

std::string_view to_string(Transfer::Mode mode) {
    constexpr std::array<std::string_view, 3> names{"none", "upload", "download"};
    return names[static_cast<std::size_t>(mode)];
}

}  // namespace fauxboard::machine
