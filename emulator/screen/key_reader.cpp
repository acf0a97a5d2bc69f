#include "emulator/screen/key_reader.h"

#include <fmt/format.h>

#include "emulator/screen/c_numbers.h"

namespace fauxboard::screen {

void KeyReader::say(Verdict verdict, const std::string& why) {
    judgement_.verdict = std::max(judgement_.verdict, verdict);
    if (!why.empty()) {
        judgement_.why += (judgement_.why.empty() ? "" : "; ") + why;
    }
}

bool KeyReader::read_one(const Read& read) {
    const std::size_t from = read.from == Read::From::last     ? at_
                             : read.from == Read::From::column ? std::min(read.column, text_.size())
                                                               : 0;
    const std::size_t hit = from <= text_.size() ? text_.find(read.key, from) : std::string_view::npos;
    if (hit == std::string_view::npos) {
        missing(read, from);
        return true;
    }
    at_ = hit + read.key.size();
    const bool go_on = take(read);
    if (!read.bug.empty()) {
        say(Verdict::misread, read.bug);
    }
    return go_on && read_all(read.then);
}

bool KeyReader::take(const Read& read) {
    switch (read.as) {
        case Read::As::text:
            return take_text(read);
        case Read::As::mark:
            return true;
        case Read::As::list_start:
            start_list(read);
            return true;
        case Read::As::list_end:
            end_list(read);
            return true;
        case Read::As::list_entry:
            return take_entry(read);
        case Read::As::list_append:
            return append_entry(read);
        default:
            return take_number(read);
    }
}

void KeyReader::missing(const Read& read, std::size_t from) {
    if (from != 0 && text_.substr(0, std::min(from, text_.size())).find(read.key) != std::string_view::npos &&
        !belongs_to_another(read.key)) {
        say(Verdict::part_missed,
            fmt::format("\"{}\" is looked for behind what was read before, and is not there", read.key));
    }
    for (const Read& next : read.then) {
        const bool telling = next.key.find_first_not_of(" /:") != std::string::npos;
        if (telling && text_.find(next.key, std::min(at_, text_.size())) != std::string_view::npos) {
            say(Verdict::part_missed,
                fmt::format("without \"{}\" \"{}\" is not looked for", read.key, next.key));
            return;
        }
    }
}

bool KeyReader::belongs_to_another(const std::string& key) const {
    return text_.find(' ' + key) == std::string_view::npos && !text_.starts_with(key);
}

bool KeyReader::fail(Read::Bad bad, const std::string& why) {
    say(bad == Read::Bad::crash       ? Verdict::would_crash
        : bad == Read::Bad::drop_rest ? Verdict::rest_dropped
        : bad == Read::Bad::zero      ? Verdict::misread
                                      : Verdict::cut,
        why);
    return bad == Read::Bad::zero || bad == Read::Bad::cut;
}

double KeyReader::number(const Read& read) {
    if (read.as == Read::As::real) {
        const ReadReal real = read_real(text_.substr(at_));
        at_ += real.used;
        note_no_number(read, real.used);
        return static_cast<double>(real.value);
    }
    const ReadInteger integer = read_integer(text_.substr(at_));
    at_ += integer.used;
    note_no_number(read, integer.used);
    return integer.value;
}

double KeyReader::kept(const Read& read, double number) {
    if (read.as == Read::As::real) {
        return number;
    }
    const auto value = static_cast<std::int64_t>(number);
    const std::uint32_t bits = static_cast<std::uint32_t>(value);
    const std::int64_t kept = read.as == Read::As::u8    ? bits & 0xFFU
                              : read.as == Read::As::u16 ? bits & 0xFFFFU
                                                         : value;
    if (kept != value) {
        say(Verdict::misread, fmt::format("\"{}\" {} is taken as {}", read.key, value, kept));
    }
    return static_cast<double>(kept);
}

void KeyReader::note_no_number(const Read& read, std::size_t used) {
    if (used == 0) {
        say(Verdict::misread, fmt::format("\"{}\" without a number behind it is taken as 0", read.key));
    }
}

bool KeyReader::take_number(const Read& read) {
    double value = number(read);
    if (!read.bounds_first) {
        value = kept(read, value);
    }
    if ((read.min && value < *read.min) || (read.max && value > *read.max)) {
        const std::string why = read.why.empty()
                                    ? fmt::format("\"{}\" {} is out of bounds{}", read.key, short_text(value),
                                                  read.outside == Read::Bad::zero ? " and taken as 0" : "")
                                    : read.why;
        if (!fail(read.outside, why)) {
            return false;
        }
        value = 0;
    }
    if (read.bounds_first) {
        value = kept(read, value);
    }
    if (read.into) {
        values_[*read.into].number = value;
        carry(read);
    }
    return true;
}

bool KeyReader::take_text(const Read& read) {
    std::size_t end = read.until.empty() ? text_.size() : text_.find(read.until, at_);
    if (end == std::string_view::npos || end < at_ + read.less) {
        const std::string why =
            read.why.empty() ? fmt::format("no \"{}\" behind \"{}\"", read.until, read.key) : read.why;
        if (!fail(read.no_end, why)) {
            return false;
        }
        end = text_.size();
    }
    std::string_view text = text_.substr(at_, end - at_);
    text.remove_suffix(std::min(read.less, text.size()));
    at_ = end;
    if (read.max_bytes != 0 && text.size() > read.max_bytes) {
        if (!fail(read.too_long, fmt::format("a text of {} characters behind \"{}\", there is room for {}",
                                             text.size(), read.key, read.max_bytes))) {
            return false;
        }
        text = text.substr(0, read.max_bytes);
    }
    if (text.size() < read.min_bytes) {
        return fail(Read::Bad::drop_rest, "an empty text");
    }
    note_frame("text");
    if (read.into) {
        values_[*read.into].text = text;
        carry(read);
    }
    return true;
}

bool KeyReader::take_entry(const Read& read) {
    const ReadInteger index = read_integer(text_.substr(at_));
    at_ += index.used;
    note_no_number(read, index.used);
    const std::size_t most = profile_.values.at(*read.into).most;
    if (index.value < 0 || static_cast<std::size_t>(index.value) >= most) {
        return fail(read.outside, fmt::format("entry {}: the list holds {}", index.value, most));
    }
    std::string_view name = text_.substr(std::min(at_ + 1, text_.size()));
    if (read.max_bytes != 0 && name.size() > read.max_bytes) {
        fail(Read::Bad::cut,
             fmt::format("a name of {} characters, there is room for {}", name.size(), read.max_bytes));
        name = name.substr(0, read.max_bytes);
    }
    at_ = text_.size();
    note_frame("name");
    Shown& value = values_[*read.into];
    auto& list = profile_.values.at(*read.into).at_end ? value.coming : value.list;
    const auto slot = static_cast<std::size_t>(index.value);
    list.resize(std::max(list.size(), slot + 1));
    list[slot] = name;
    carry(read);
    return true;
}

void KeyReader::start_list(const Read& read) {
    Shown& value = values_[*read.into];
    value.list.clear();
    value.coming.clear();
    if (!profile_.values.at(*read.into).at_end) {
        carry(read);
    }
}

void KeyReader::end_list(const Read& read) {
    const ValueInfo& info = profile_.values.at(*read.into);
    Shown& value = values_[*read.into];
    if (value.coming.size() > info.shows_most) {
        say(Verdict::misread, fmt::format("a list of {} entries is shown as none; at most {} are",
                                          value.coming.size(), info.shows_most));
        value.coming.clear();
    }
    value.list = std::move(value.coming);
    value.coming.clear();
    carry(read);
}

void KeyReader::note_frame(std::string_view what) {
    if (at_ > frame_end_) {
        say(Verdict::misread, fmt::format("the frame's checksum becomes part of the {}", what));
    }
}

bool KeyReader::append_entry(const Read& read) {
    auto& list = values_[*read.into].list;
    const std::size_t most = profile_.values.at(*read.into).most;
    if (list.size() >= most) {
        return fail(read.outside, fmt::format("entry {}: the list holds {}", list.size() + 1, most));
    }
    const std::size_t end =
        read.until.empty() ? text_.size() : std::min(text_.find(read.until, at_), text_.size());
    std::string_view entry = text_.substr(at_, end - at_);
    at_ = end;
    if (read.max_bytes != 0 && entry.size() > read.max_bytes) {
        fail(Read::Bad::cut,
             fmt::format("a name of {} characters, there is room for {}", entry.size(), read.max_bytes));
        entry = entry.substr(0, read.max_bytes);
    }
    list.emplace_back(entry);
    carry(read);
    return true;
}

void KeyReader::carry(const Read& read) {
    const Shown& value = values_[*read.into];
    judgement_.carried.push_back({*read.into, value.number, value.text});
}

}  // namespace fauxboard::screen
