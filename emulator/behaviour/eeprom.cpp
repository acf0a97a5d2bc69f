#include "emulator/behaviour/eeprom.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <vector>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/number_text.h"

namespace fauxboard::behaviour {
namespace {

/// Calls `use(path, value)` for each line of the image.
template <class F>
void each_line(std::string_view image, F&& use) {
    while (!image.empty()) {
        const std::size_t end = std::min(image.find('\n'), image.size());
        const std::string_view line = image.substr(0, end);
        image.remove_prefix(std::min(end + 1, image.size()));
        const std::size_t blank = line.find(' ');
        if (blank != std::string_view::npos && blank != 0) {
            use(line.substr(0, blank), line.substr(blank + 1));
        }
    }
}

void append_value(std::string& out, const Field& field, const machine::Machine& machine) {
    const Value value = field.get(machine);
    if (value.none()) {
        return;  // of a part that this machine has not
    }
    out += field.path;
    out += ' ';
    if (value.is_text()) {
        out += value.text;
    } else {
        std::array<char, 32> text{};
        const auto end = std::to_chars(text.data(), text.data() + text.size(), value.number).ptr;
        out.append(text.data(), end);
    }
    out += '\n';
}

const std::vector<const Field*>& stored_fields() {
    static const std::vector<const Field*> stored = [] {
        std::vector<const Field*> rows;
        for (const Field& field : fields()) {
            if (field.stored) {
                rows.push_back(&field);
            }
        }
        return rows;
    }();
    return stored;
}

/// What is noted of a field that was written: its number's bits, so that -0.0 is not 0.0. Text has no note;
/// of a part that this machine has not there is nothing to write.
std::uint64_t note_of(const Value& value) {
    return std::bit_cast<std::uint64_t>(value.number);
}

/// Whether the image says all of it already.
bool written(machine::Machine& machine, std::string_view prefix) {
    const std::vector<std::uint64_t>& notes = machine.eeprom_image.notes();
    const std::vector<const Field*>& stored = stored_fields();
    if (notes.empty()) {
        return false;
    }
    for (std::size_t i = 0; i < stored.size(); ++i) {
        if (!prefix.empty() && !stored[i]->path.starts_with(prefix)) {
            continue;
        }
        const Value value = stored[i]->get(machine);
        if (value.is_text() || note_of(value) != notes[i]) {
            return false;
        }
    }
    return true;
}

void write(machine::Machine& machine, std::string_view prefix) {
    machine::EepromImage& image = machine.eeprom_image;
    const std::vector<const Field*>& stored = stored_fields();
    std::string& draft = image.draft();
    draft.clear();
    each_line(image, [&](std::string_view path, std::string_view value) {
        const Field* field = find_field(path);
        if (field == nullptr || !field->stored || !path.starts_with(prefix)) {
            draft.append(path).append(" ").append(value).append("\n");
        }
    });
    // Of a part that was never written nothing can be noted.
    std::vector<std::uint64_t>& notes = image.notes();
    if (prefix.empty()) {
        notes.resize(stored.size());
    }
    for (std::size_t i = 0; i < stored.size(); ++i) {
        if (stored[i]->path.starts_with(prefix)) {
            append_value(draft, *stored[i], machine);
            if (!notes.empty()) {
                notes[i] = note_of(stored[i]->get(machine));
            }
        }
    }
    image.take_draft();
}

}  // namespace

std::string make_image(const machine::Machine& machine) {
    std::string image;
    for (const Field* field : stored_fields()) {
        append_value(image, *field, machine);
    }
    return image;
}

bool save_fields(machine::Machine& machine, std::string_view prefix) {
    if (!written(machine, prefix)) {
        write(machine, prefix);
    }
    return machine.eeprom_store() == nullptr || machine.eeprom_store()->save(machine.eeprom_image);
}

void load_fields(machine::Machine& machine, std::string_view prefix) {
    apply_image(machine, machine.eeprom_image, prefix);
}

void apply_image(machine::Machine& machine, std::string_view image, std::string_view prefix) {
    each_line(image, [&](std::string_view path, std::string_view text) {
        const Field* field = find_field(path);
        if (field == nullptr || !field->stored || !path.starts_with(prefix)) {
            return;
        }
        if (field->type == FieldType::text) {
            set_field(machine, *field, Value::of(text));
            return;
        }
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc{} && end == text.data() + text.size()) {
            set_field(machine, *field, Value::of(number));
        }
    });
}

}  // namespace fauxboard::behaviour
