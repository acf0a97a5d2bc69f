#include "emulator/screen/frame_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/screen/c_numbers.h"
#include "protocol/framing.h"

namespace fauxboard::screen {
namespace {

/// Reads the keys of one frame. The place in the text moves on as the firmware's pointer does.
class KeyReader {
  public:
    /// `frame_end` is where the checksum of a frame begins that this screen does not take off.
    KeyReader(std::string_view text, std::size_t frame_end, const ScreenProfile& profile,
              std::vector<Shown>& values, Judgement& judgement)
        : text_(text), frame_end_(frame_end), profile_(profile), values_(values), judgement_(judgement) {}

    /// False when the rest of the line is not taken.
    bool read_all(const std::vector<Read>& reads) {
        return std::all_of(reads.begin(), reads.end(), [this](const Read& read) { return read_one(read); });
    }
    void say(Verdict verdict, const std::string& why) {
        judgement_.verdict = std::max(judgement_.verdict, verdict);
        if (!why.empty()) {
            judgement_.why += (judgement_.why.empty() ? "" : "; ") + why;
        }
    }

  private:
    bool read_one(const Read& read) {
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

    bool take(const Read& read) {
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

    void missing(const Read& read, std::size_t from) {
        if (from != 0 &&
            text_.substr(0, std::min(from, text_.size())).find(read.key) != std::string_view::npos &&
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

    /// A key such as "S" or "R:" stands inside others ("SD:", "FR:"): only a key behind a blank was meant.
    bool belongs_to_another(const std::string& key) const {
        return text_.find(' ' + key) == std::string_view::npos && !text_.starts_with(key);
    }

    bool fail(Read::Bad bad, const std::string& why) {
        say(bad == Read::Bad::crash       ? Verdict::would_crash
            : bad == Read::Bad::drop_rest ? Verdict::rest_dropped
            : bad == Read::Bad::zero      ? Verdict::misread
                                          : Verdict::cut,
            why);
        return bad == Read::Bad::zero || bad == Read::Bad::cut;
    }

    double number(const Read& read) {
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
    double kept(const Read& read, double number) {
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
    void note_no_number(const Read& read, std::size_t used) {
        if (used == 0) {
            say(Verdict::misread, fmt::format("\"{}\" without a number behind it is taken as 0", read.key));
        }
    }

    bool take_number(const Read& read) {
        double value = number(read);
        if (!read.bounds_first) {
            value = kept(read, value);
        }
        if ((read.min && value < *read.min) || (read.max && value > *read.max)) {
            const std::string why =
                read.why.empty() ? fmt::format("\"{}\" {} is out of bounds{}", read.key, short_text(value),
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

    bool take_text(const Read& read) {
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
            if (!fail(read.too_long,
                      fmt::format("a text of {} characters behind \"{}\", there is room for {}", text.size(),
                                  read.key, read.max_bytes))) {
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

    bool take_entry(const Read& read) {
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

    void start_list(const Read& read) {
        Shown& value = values_[*read.into];
        value.list.clear();
        value.coming.clear();
        if (!profile_.values.at(*read.into).at_end) {
            carry(read);
        }
    }
    void end_list(const Read& read) {
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

    /// What was read goes on to the end of a frame, which this screen does not know for one.
    void note_frame(std::string_view what) {
        if (at_ > frame_end_) {
            say(Verdict::misread, fmt::format("the frame's checksum becomes part of the {}", what));
        }
    }

    bool append_entry(const Read& read) {
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

    void carry(const Read& read) {
        const Shown& value = values_[*read.into];
        judgement_.carried.push_back({*read.into, value.number, value.text});
    }

    std::string_view text_;
    std::size_t frame_end_;
    const ScreenProfile& profile_;
    std::vector<Shown>& values_;
    Judgement& judgement_;
    std::size_t at_ = 0;
};

std::string frame_fault(const protocol::Unframed& unframed, std::string_view line) {
    switch (unframed.fault) {
        case protocol::FrameFault::none:
            return "no \"N-0\" before it";
        case protocol::FrameFault::checksum_missing:
            return "no checksum";
        case protocol::FrameFault::checksum_malformed:
            return "no number behind the star";
        case protocol::FrameFault::checksum_wrong:
            break;
    }
    const std::string_view covered = line.substr(0, line.rfind('*'));
    return fmt::format("wrong checksum; expected {}", protocol::xor_checksum(covered));
}

std::string no_case(const FrameRule& rule) {
    std::vector<std::string> wanted;
    for (const FrameCase& one : rule.cases) {
        wanted.push_back(fmt::format("\"{}\"", fmt::join(one.has, "\" with \"")));
    }
    return fmt::format("{} is taken only with {}", rule.name, fmt::join(wanted, ", or "));
}

/// Of what stands behind the word that says who speaks ("Error:", "echo:"), if one does.
std::size_t longest_word(std::string_view text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto speaker = std::find_if_not(text.begin(), text.end(), is_letter);
    if (speaker != text.end() && *speaker == ':') {
        text.remove_prefix(static_cast<std::size_t>(speaker - text.begin()) + 1);
    }
    std::size_t longest = 0;
    std::size_t word = 0;
    for (const char c : text) {
        word = c == ' ' ? 0 : word + 1;
        longest = std::max(longest, word);
    }
    return longest;
}

/// What the profile wants to know of the line itself.
void measure(const ScreenProfile& profile, std::string_view text, std::vector<Shown>& values) {
    for (std::size_t id = 0; id < values.size(); ++id) {
        const ValueSource source = profile.values.at(id).is;
        if (source == ValueSource::line_bytes) {
            values[id].number = static_cast<double>(text.size());
        } else if (source == ValueSource::longest_word) {
            values[id].number = static_cast<double>(longest_word(text));
        }
    }
}

/// One line on its way through the rules.
class Taking {
  public:
    Taking(const ScreenProfile& profile, std::string_view text, std::size_t frame_end,
           std::vector<Shown>& values, Taken& taken)
        : profile_(profile), text_(text), frame_end_(frame_end), values_(values), taken_(taken) {}

    void by_rules() {
        for (const FrameRule& rule : profile_.words) {
            if (matches(rule) && !by_rule(rule)) {
                return;
            }
        }
        if (taken_.how.empty() && taken_.judgement.verdict == Verdict::ok) {
            by_code();
        }
    }

  private:
    bool matches(const FrameRule& rule) const {
        return rule.anywhere ? text_.find(rule.name) != std::string_view::npos : text_.starts_with(rule.name);
    }
    bool stands(const std::string& word) const { return text_.find(word) != std::string_view::npos; }
    bool fits(const FrameCase& one) const {
        return std::all_of(one.has.begin(), one.has.end(), [&](const auto& word) { return stands(word); }) &&
               std::none_of(one.lacks.begin(), one.lacks.end(),
                            [&](const auto& word) { return stands(word); }) &&
               all_hold(one.when, {values_, 0, {}, 0});
    }

    void ignore(const std::string& why) {
        Judgement& judgement = taken_.judgement;
        judgement.verdict = std::max(judgement.verdict, Verdict::ignored);
        judgement.why += judgement.why.empty() || why.empty() ? why : "; " + why;
    }

    /// True when the rules below it take the line, too.
    bool by_rule(const FrameRule& rule) {
        const auto hit = std::find_if(rule.cases.begin(), rule.cases.end(),
                                      [&](const FrameCase& one) { return fits(one); });
        if (hit == rule.cases.end() && rule.anywhere) {
            return true;
        }
        if (taken_.judgement.frame.empty() || !taken_.how.empty()) {
            taken_.judgement.frame = rule.name;
        }
        if (hit == rule.cases.end()) {
            ignore(no_case(rule));
            return false;
        }
        if (!hit->ignored.empty()) {
            ignore(hit->ignored);
            return rule.goes_on;
        }
        taken_.how.push_back(&*hit);
        KeyReader reader(text_, frame_end_, profile_, values_, taken_.judgement);
        reader.read_all(hit->read);
        if (hit->restarts) {
            reader.say(Verdict::restarts, "the screen starts anew");
        }
        if (hit->verdict != Verdict::ok) {
            reader.say(hit->verdict, hit->why);
        }
        assign(hit->assume, profile_.values, {values_, 0, {}, 0}, values_);
        return rule.goes_on;
    }

    void by_code() {
        Judgement& judgement = taken_.judgement;
        if (profile_.codes.empty()) {
            ignore("this screen looks for nothing in it");
            return;
        }
        const std::size_t within = profile_.line.code_within;
        const std::size_t letter = text_.substr(0, within).find('L');
        if (letter == std::string_view::npos) {
            ignore(fmt::format("no L in the first {} characters", within));
            return;
        }
        const std::int32_t number = read_integer(text_.substr(letter + 1)).value;
        const unsigned code = static_cast<std::uint32_t>(number) & 0xFFU;
        judgement.frame = fmt::format("L{}", code);
        const auto hit = profile_.codes.find(code);
        if (hit == profile_.codes.end()) {
            ignore(fmt::format("this screen knows no L{}", code));
            return;
        }
        if (static_cast<std::int64_t>(code) != number) {
            judgement.verdict = Verdict::misread;
            judgement.why = fmt::format("L{} is taken as L{}", number, code);
        }
        by_rule(hit->second);
    }

    const ScreenProfile& profile_;
    std::string_view text_;
    std::size_t frame_end_;
    std::vector<Shown>& values_;
    Taken& taken_;
};

}  // namespace

Taken take_line(const ScreenProfile& profile, std::string_view line, std::vector<Shown>& values) {
    Taken taken;
    taken.judgement.line = line;
    std::string_view text = line;
    std::size_t frame_end = line.size();
    const auto unframed = protocol::unframe(line, protocol::ChecksumPolicy::required);
    const bool framed = unframed.prefixed && unframed.fault == protocol::FrameFault::none;
    if (profile.line.framed_in) {
        if (!framed) {
            taken.judgement.verdict = Verdict::ignored;
            taken.judgement.why = frame_fault(unframed, line);
            return taken;
        }
        text = unframed.body;
        frame_end = text.size();
    } else if (framed) {
        frame_end = line.rfind('*');
    }
    if (profile.line.skips_blanks) {
        const std::size_t blanks = std::min(text.find_first_not_of(' '), text.size());
        text.remove_prefix(blanks);
        frame_end -= std::min(blanks, frame_end);
    }
    measure(profile, text, values);
    Taking(profile, text, frame_end, values, taken).by_rules();
    return taken;
}

Taken take_received(const ScreenProfile& profile, std::string_view line, std::vector<Shown>& values) {
    if (line.size() >= profile.line.buffer_bytes) {
        Taken lost;
        lost.judgement.line = line;
        lost.judgement.verdict = Verdict::ignored;
        lost.judgement.why = fmt::format("a line of {} bytes or more is lost", profile.line.buffer_bytes);
        return lost;
    }
    const std::size_t nul = line.find('\0');
    Taken taken = take_line(profile, line.substr(0, nul), values);
    if (nul != std::string_view::npos) {
        taken.judgement.verdict = std::max(taken.judgement.verdict, Verdict::cut);
        taken.judgement.why += taken.judgement.why.empty() ? "" : "; ";
        taken.judgement.why += "a NUL ends the text";
    }
    return taken;
}

}  // namespace fauxboard::screen
