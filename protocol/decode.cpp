#include "protocol/decode.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "protocol/command.h"
#include "protocol/scan.h"

namespace fauxboard::protocol {

namespace {

bool is_numeric(FieldKind kind) {
    return kind != FieldKind::text;
}

/// Walks over one body. Each field of the code is used once, and later ones are tried first, so that L2's
/// four "/" pairs find their heater and a file name cannot be taken for a second "P".
class FieldReader {
  public:
    FieldReader(std::string_view text, std::span<const FieldInfo> infos)
        : text_(text), infos_(infos), used_(infos.size(), false) {}

    std::vector<DecodedField> read(std::string& tail) {
        std::vector<DecodedField> fields;
        while (at_ < text_.size()) {
            const std::size_t blanks = scan::blanks_at(text_, at_);
            const bool rest = next_takes_rest();
            if (at_ + blanks == text_.size() && !rest) {
                tail = text_.substr(at_);
                break;
            }
            const std::size_t lead = rest && blanks != 0 ? 1 : blanks;
            fields.push_back(read_field(lead));
        }
        return fields;
    }

  private:
    /// The next field of the table is a text without key: all that is left belongs to it.
    bool next_takes_rest() const {
        return next_ < infos_.size() && infos_[next_].key.empty() && infos_[next_].kind == FieldKind::text &&
               !used_[next_];
    }

    DecodedField read_field(std::size_t lead) {
        DecodedField field;
        field.lead = text_.substr(at_, lead);
        at_ += lead;
        const std::size_t index = find_info();
        if (index == infos_.size()) return read_unknown(std::move(field));
        const FieldInfo& info = infos_[index];
        used_[index] = true;
        next_ = index + 1;
        field.info = &info;
        field.key = info.key;
        at_ += info.key.size();
        const std::size_t length = value_length(info);
        set_value(field, text_.substr(at_, length));
        at_ += length;
        if (info.closing != '\0' && at_ < text_.size() && text_[at_] == info.closing) {
            field.closed = true;
            ++at_;
        }
        if (index == 0 && field.number) {
            // No `when` is that large: a number beyond selects nothing.
            selector_ = static_cast<std::int32_t>(std::clamp(*field.number, -1e9, 1e9));
        }
        return field;
    }

    /// The field that starts here, or infos_.size().
    std::size_t find_info() const {
        if (next_takes_rest()) return next_;
        for (std::size_t i = 0; i < infos_.size(); ++i) {
            const std::size_t index = (next_ + i) % infos_.size();
            if (starts_here(index, at_)) return index;
        }
        return infos_.size();
    }

    bool starts_here(std::size_t index, std::size_t at) const {
        const FieldInfo& info = infos_[index];
        if (used_[index] || (info.when != always && info.when != selector_)) return false;
        if (info.key.empty()) {
            return index == next_ && is_numeric(info.kind) && scan::number_length(text_.substr(at)) != 0;
        }
        return text_.substr(at).starts_with(info.key) && !longer_key_at(at, info.key);
    }

    /// Whether another key of the code fits here and is longer ("F0:" against "F").
    bool longer_key_at(std::size_t at, std::string_view key) const {
        for (const FieldInfo& info : infos_) {
            if (info.key.size() > key.size() && text_.substr(at).starts_with(info.key)) return true;
        }
        return false;
    }

    bool any_starts_at(std::size_t at, std::size_t from) const {
        for (std::size_t i = from; i < infos_.size(); ++i) {
            if (!infos_[i].key.empty() && starts_here(i, at)) return true;
        }
        return false;
    }

    std::size_t value_length(const FieldInfo& info) const {
        return info.kind == FieldKind::text ? text_length(info) : number_length();
    }

    /// Up to the closing mark, else up to the blanks before a later key of the table, else all.
    std::size_t text_length(const FieldInfo& info) const {
        if (info.closing != '\0') {
            const std::size_t mark = text_.find(info.closing, at_);
            if (mark != std::string_view::npos) return mark - at_;
        }
        if (info.key.empty()) return text_.size() - at_;
        for (std::size_t i = at_; i < text_.size(); ++i) {
            if (scan::is_blank(text_[i]) && any_starts_at(i + 1, next_)) {
                std::size_t end = i;
                while (end > at_ && scan::is_blank(text_[end - 1])) {
                    --end;
                }
                return end - at_;
            }
        }
        return text_.size() - at_;
    }

    /// The number, where one stands and a blank, a letter's parameter, a key or the end follows; else all up
    /// to the blank, as it was written.
    std::size_t number_length() const {
        const std::size_t length = scan::number_length(text_.substr(at_));
        const std::size_t end = at_ + length;
        if (end == text_.size() || scan::is_blank(text_[end]) || any_starts_at(end, 0) ||
            (length != 0 && scan::is_capital(text_[end]))) {
            return length;
        }
        return run_to_blank();
    }

    std::size_t run_to_blank() const {
        std::size_t end = at_;
        while (end < text_.size() && !scan::is_blank(text_[end])) {
            ++end;
        }
        return end - at_;
    }

    DecodedField read_unknown(DecodedField field) {
        const std::string_view token = text_.substr(at_, run_to_blank());
        const std::size_t colon = token.find(':');
        std::size_t key = 0;
        if (colon != std::string_view::npos) {
            key = colon + 1;
        } else if (!token.empty() && scan::is_capital(token[0])) {
            key = 1;
        }
        field.key = token.substr(0, key);
        std::string_view value = token.substr(key);
        const std::size_t number = scan::number_length(value);
        // "G1X10Y20": the next parameter begins right behind the number.
        if (key == 1 && number != 0 && number < value.size() && scan::is_capital(value[number])) {
            value = value.substr(0, number);
        }
        set_value(field, value);
        at_ += key + value.size();
        return field;
    }

    static void set_value(DecodedField& field, std::string_view value) {
        field.text = value;
        if (field.info != nullptr && !is_numeric(field.info->kind)) return;
        // 15 digits are what a double holds for certain.
        if (value.empty() || value.size() > 15 || scan::number_length(value) != value.size()) return;
        if (value.find('e') != std::string_view::npos) return;
        const std::size_t point = value.find('.');
        const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(value.size() - point - 1);
        const double number = read_number(value);
        if (format_number(number, decimals) != value) return;
        field.number = number;
        field.decimals = decimals;
    }

    std::string_view text_;
    std::span<const FieldInfo> infos_;
    std::vector<bool> used_;
    std::size_t at_ = 0;
    std::size_t next_ = 0;
    std::int32_t selector_ = always;
};

}  // namespace

std::vector<DecodedField> decode_fields(std::string_view text, std::span<const FieldInfo> infos,
                                        std::string& tail) {
    return FieldReader(text, infos).read(tail);
}

std::string format_number(double value, int decimals) {
    std::array<char, 400> buffer;  // DBL_MAX has 309 digits before the point
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed,
                      decimals < 0 ? 0 : (decimals > 20 ? 20 : decimals));
    return end.ec == std::errc{} ? std::string(buffer.data(), end.ptr) : std::string{};
}

}  // namespace fauxboard::protocol
