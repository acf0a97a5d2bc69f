#include "emulator/host/line_faults.h"

#include <fmt/format.h>

#include <algorithm>

namespace fauxboard::host {

/// The fault with the line that it is for where nobody said so and there is one alone.
fault::FaultSpec LineFaults::placed(fault::FaultSpec spec) const {
    if (!spec.line && !has_main_ && usb_ != nullptr) {
        spec.line = fault::Line::usb;
    }
    return spec;
}

fault::FaultControl& LineFaults::line_of(const fault::FaultSpec& spec) {
    if (!has_main_ && usb_ == nullptr) {
        throw fault::FaultSpecError({fmt::format("fault \"{}\": this board has no line that it could spoil",
                                                 fault::fault_to_text(spec))});
    }
    if (spec.line.value_or(fault::Line::main) == fault::Line::main) {
        if (!has_main_ && usb_ != nullptr) {
            throw fault::FaultSpecError({fmt::format(
                "fault \"{}\": line: there is no main line here; expected \"usb\", or `run` with --pty, "
                "--port or --tcp",
                fault::fault_to_text(spec))});
        }
        return main_;
    }
    if (usb_ == nullptr) {
        throw fault::FaultSpecError({fmt::format(
            "fault \"{}\": line: found \"usb\", and there is no USB side here; expected \"main\", or "
            "`run` with --host-pty, --host-port or --host-tcp",
            fault::fault_to_text(spec))});
    }
    return *usb_;
}

std::vector<LineFaults::Entry>::iterator LineFaults::find(fault::FaultId id) {
    return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.id == id; });
}

fault::FaultId LineFaults::add(const fault::FaultSpec& asked) {
    const fault::FaultSpec spec = placed(asked);
    fault::FaultControl& line = line_of(spec);
    entries_.push_back({last_id_ + 1, &line, line.add(spec)});
    return ++last_id_;
}

bool LineFaults::change(fault::FaultId id, const fault::FaultSpec& asked) {
    const fault::FaultSpec spec = placed(asked);
    const auto entry = find(id);
    if (entry == entries_.end()) {
        return false;
    }
    fault::FaultControl& line = line_of(spec);
    if (&line == entry->line) {
        return line.change(entry->id_there, spec);
    }
    const fault::FaultId there = line.add(spec);  // which may throw: the old one stays then
    entry->line->remove(entry->id_there);
    *entry = {id, &line, there};
    return true;
}

bool LineFaults::remove(fault::FaultId id) {
    const auto entry = find(id);
    if (entry == entries_.end()) {
        return false;
    }
    entry->line->remove(entry->id_there);
    entries_.erase(entry);
    return true;
}

void LineFaults::clear() {
    main_.clear();
    if (usb_ != nullptr) {
        usb_->clear();
    }
    entries_.clear();
}

std::vector<fault::FaultStatus> LineFaults::list() const {
    std::vector<fault::FaultStatus> out;
    const std::vector<fault::FaultStatus> of_main = main_.list();
    const std::vector<fault::FaultStatus> of_usb =
        usb_ != nullptr ? usb_->list() : std::vector<fault::FaultStatus>{};
    for (const Entry& entry : entries_) {
        const auto& all = entry.line == &main_ ? of_main : of_usb;
        const auto status = std::find_if(all.begin(), all.end(),
                                         [&](const fault::FaultStatus& s) { return s.id == entry.id_there; });
        if (status != all.end()) {
            out.push_back(*status);
            out.back().id = entry.id;
        }
    }
    return out;
}

fault::FaultId LineFaults::known_as(const fault::FaultControl& line, fault::FaultId id_there) const {
    const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& each) {
        return each.line == &line && each.id_there == id_there;
    });
    return entry == entries_.end() ? id_there : entry->id;  // one that is being added acts at once
}

}  // namespace fauxboard::host
