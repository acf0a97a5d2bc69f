#include "emulator/dlp/acfg.h"

#include <algorithm>
#include <array>

namespace fauxboard::dlp {
namespace {

constexpr std::size_t longest_name = 127;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

struct ResultWords {
    std::string_view name;
    std::string_view box;
};
constexpr std::array<ResultWords, 4> result_words{{{"ok", ""},
                                                   {"unknown_section", "Unknown section name"},
                                                   {"unknown_param", "Unknown parameter name"},
                                                   {"invalid_value", "Parameter value is invalid"}}};

struct SectionWord {
    std::string_view name;
    Section section;
    Firmware since;
};
constexpr std::array<SectionWord, 3> sections{{{"[ZMOTOR]", Section::z_motor, Firmware::v001},
                                               {"[GENERAL]", Section::general, Firmware::v001},
                                               {"[PRINTING]", Section::printing, Firmware::v008}}};

/// Lines as the board reads them: a full buffer is a line, and its last byte is lost.
class Lines {
  public:
    explicit Lines(const AcfgBytes& bytes) : bytes_(bytes) {}

    /// The next line. False at the end; a last line without its end still comes.
    bool next() {
        text_.clear();
        cut_ = false;
        ++number_;
        for (std::size_t count = 0; count < acfg_line_bytes; ++count) {
            const int byte = take();
            if (byte < 0 || byte == '\n') {
                return byte >= 0 || !text_.empty();
            }
            text_ += static_cast<char>(byte);
        }
        text_.pop_back();
        cut_ = true;
        return true;
    }
    /// Up to a NUL, which ends a string for the board.
    std::string_view text() const {
        const std::string_view all = text_;
        return all.substr(0, all.find('\0'));
    }
    unsigned number() const { return number_; }
    bool too_large() const { return taken_ > acfg_most_bytes; }
    bool cut() const { return cut_; }

  private:
    int take() {
        if (at_ == filled_) {
            at_ = 0;
            filled_ = bytes_(buffer_.data(), buffer_.size());
        }
        ++taken_;
        return at_ == filled_ ? -1 : static_cast<unsigned char>(buffer_[at_++]);
    }

    const AcfgBytes& bytes_;
    std::array<char, 4096> buffer_{};
    std::size_t at_ = 0;
    std::size_t filled_ = 0;
    std::size_t taken_ = 0;
    std::string text_;
    unsigned number_ = 0;
    bool cut_ = false;
};

bool white(char c) {
    return static_cast<unsigned char>(c) < 33;
}

/// The board's trim. One character with white space behind it comes out empty.
std::string_view trimmed(std::string_view text) {
    const auto begin = std::find_if_not(text.begin(), text.end(), white);
    text.remove_prefix(static_cast<std::size_t>(begin - text.begin()));
    const std::size_t before = text.size();
    while (!text.empty() && white(text.back())) {
        text.remove_suffix(1);
    }
    return text.size() == 1 && before > 1 ? std::string_view{} : text;
}

std::string upper(std::string_view text) {
    std::string out(text);
    for (char& c : out) {
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return out;
}

bool blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

std::string_view name_of(std::string_view line) {
    const auto end = std::find_if(line.begin(), line.end(), [](char c) { return blank(c) || c == '='; });
    return line.substr(0, std::min<std::size_t>(static_cast<std::size_t>(end - line.begin()), longest_name));
}

/// What stands behind the first '='; empty when nothing does.
std::string_view value_of(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
        return {};
    }
    line.remove_prefix(equals + 1);
    while (!line.empty() && blank(line.front())) {
        line.remove_prefix(1);
    }
    return line;
}

bool digit(char c) {
    return c >= '0' && c <= '9';
}

bool numeric(std::string_view value) {
    const char second = value.size() > 1 ? value[1] : '\0';
    return digit(value.front()) || value.front() == '.' ||
           (value.front() == '-' && (digit(second) || second == '.'));
}

/// One line after the other; the first that is wrong ends it.
class AcfgReader {
  public:
    AcfgReader(Settings& settings, Firmware firmware) : settings_(settings), firmware_(firmware) {}

    AcfgReport read(const AcfgBytes& bytes) {
        Lines lines(bytes);
        while (report_.result == AcfgResult::ok && lines.next()) {
            line_ = lines.number();
            if (lines.too_large()) {
                report_.too_large = true;
                report_.result = AcfgResult::invalid_value;
                report_.line = line_;
                break;
            }
            if (lines.cut() && report_.cut_lines.size() < AcfgReport::most_taken) {
                report_.cut_lines.push_back(line_);
            }
            std::string_view text = lines.text();
            if (line_ == 1 && text.starts_with(byte_order_mark)) {
                text.remove_prefix(byte_order_mark.size());
            }
            text = trimmed(text);
            if (!text.empty() && text.front() != '#') {
                report_.result = take(upper(text));
                report_.line = report_.result == AcfgResult::ok ? 0 : line_;
            }
        }
        return std::move(report_);
    }

  private:
    AcfgResult take(std::string_view line) {
        const std::string_view name = name_of(line);
        if (name.starts_with('[')) {
            return enter(name);
        }
        const std::string_view value = value_of(line);
        if (value.empty()) {
            return AcfgResult::invalid_value;
        }
        const auto all = parameters();
        const auto hit = std::find_if(all.begin(), all.end(), [&](const Parameter& parameter) {
            return parameter.section == section_ && parameter.name == name && parameter.since <= firmware_;
        });
        if (hit == all.end()) {
            return AcfgResult::unknown_parameter;
        }
        if (!numeric(value)) {
            return AcfgResult::invalid_value;
        }
        const bool same = hit->take(settings_, read_number(value), *hit, firmware_);
        if (report_.taken.size() < AcfgReport::most_taken) {
            report_.taken.push_back({&*hit, line_, std::string(value), !same});
        }
        return AcfgResult::ok;
    }

    AcfgResult enter(std::string_view name) {
        for (const SectionWord& word : sections) {
            if (word.name == name && word.since <= firmware_) {
                section_ = word.section;
                return AcfgResult::ok;
            }
        }
        return AcfgResult::unknown_section;
    }

    Settings& settings_;
    Firmware firmware_;
    AcfgReport report_;
    Section section_ = Section::general;
    unsigned line_ = 0;
};

}  // namespace

std::string_view to_string(AcfgResult result) {
    return result_words[static_cast<std::size_t>(result)].name;
}

std::string_view box_text(AcfgResult result) {
    return result_words[static_cast<std::size_t>(result)].box;
}

AcfgReport read_acfg(const AcfgBytes& bytes, Settings& settings, Firmware firmware) {
    return AcfgReader(settings, firmware).read(bytes);
}

AcfgReport read_acfg(std::string_view text, Settings& settings, Firmware firmware) {
    return read_acfg(
        [&text](char* out, std::size_t room) {
            const std::size_t count = text.copy(out, room);
            text.remove_prefix(count);
            return count;
        },
        settings, firmware);
}

}  // namespace fauxboard::dlp
