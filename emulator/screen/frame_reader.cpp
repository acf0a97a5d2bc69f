#include "emulator/screen/frame_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/screen/c_numbers.h"
#include "emulator/screen/key_reader.h"
#include "protocol/framing.h"

namespace fauxboard::screen {
namespace {

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
