#include "emulator/touch/number_entry.h"

#include <charconv>

namespace fauxboard::touch {

void NumberEntry::start(double value, int decimals, std::size_t most_characters) {
    text = screen::fixed_text(value, decimals);
    fresh = true;
    fractions = decimals > 0;
    most = most_characters;
}

void NumberEntry::press(screen::EntryKey key, char digit) {
    using screen::EntryKey;
    const bool first = fresh;
    if (key != EntryKey::sign) {
        fresh = false;
    }
    switch (key) {
        case EntryKey::digit:
            if (first || text == "0") {
                text.assign(1, digit);
            } else if (text.size() < most) {
                text += digit;
            }
            break;
        case EntryKey::dot:
            if (first && fractions) {
                text = "0.";
            } else if (fractions && text.find('.') == std::string::npos && text.size() < most) {
                text += '.';
            }
            break;
        case EntryKey::erase:
            text.pop_back();
            if (text.empty() || text == "-") {
                text = "0";
            }
            break;
        case EntryKey::clear:
            text = "0";
            break;
        case EntryKey::sign:
            if (text.front() == '-') {
                text.erase(0, 1);
            } else if (text != "0") {
                text.insert(0, 1, '-');
            }
            break;
    }
}

double NumberEntry::number() const {
    double out = 0;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
}

}  // namespace fauxboard::touch
