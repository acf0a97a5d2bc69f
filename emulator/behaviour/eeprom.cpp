#include "emulator/behaviour/eeprom.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <optional>
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

void append_value(std::string& out, std::string_view path, const Value& value) {
    out += path;
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

void append_value(std::string& out, const Field& field, const machine::Machine& machine) {
    if (const Value value = field.get(machine); !value.none()) {  // else of a part that this machine has not
        append_value(out, field.path, value);
    }
}

constexpr std::string_view variable_path = "var.";

/// Calls `use(path, variable)` for each variable that is kept and whose path begins so.
template <class F>
void each_kept(const Variables* kept, std::string_view prefix, F&& use) {
    for (std::size_t i = 0; kept != nullptr && i < kept->infos.size(); ++i) {
        const std::string path = std::string(variable_path) + kept->infos[i].name;
        if (kept->infos[i].stored && path.starts_with(prefix)) {
            use(path, i);
        }
    }
}

void append_kept(std::string& out, const Variables* kept, std::string_view prefix) {
    each_kept(kept, prefix, [&](const std::string& path, std::size_t i) {
        append_value(out, path, Value::of(kept->values[i]));
    });
}

std::optional<double> number_in(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    return whole ? std::optional(number) : std::nullopt;
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
bool written(machine::Machine& machine, std::string_view prefix, const Variables* kept) {
    bool variables = false;
    each_kept(kept, prefix, [&](const std::string&, std::size_t) { variables = true; });
    const std::vector<std::uint64_t>& notes = machine.eeprom_image.notes();
    const std::vector<const Field*>& stored = stored_fields();
    if (notes.empty() || variables) {
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

void write(machine::Machine& machine, std::string_view prefix, const Variables* kept) {
    machine::EepromImage& image = machine.eeprom_image;
    const std::vector<const Field*>& stored = stored_fields();
    std::string& draft = image.draft();
    draft.clear();
    each_line(image, [&](std::string_view path, std::string_view value) {
        bool known = false;
        each_kept(kept, prefix, [&](const std::string& name, std::size_t) { known = known || name == path; });
        const Field* field = known ? nullptr : find_field(path);
        if (!known && (field == nullptr || !field->stored || !path.starts_with(prefix))) {
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
    append_kept(draft, kept, prefix);
    image.take_draft();
}

}  // namespace

std::string make_image(const machine::Machine& machine, const Variables* kept) {
    std::string image;
    for (const Field* field : stored_fields()) {
        append_value(image, *field, machine);
    }
    append_kept(image, kept, {});
    return image;
}

bool save_fields(machine::Machine& machine, std::string_view prefix, const Variables* kept) {
    if (!written(machine, prefix, kept)) {
        write(machine, prefix, kept);
    }
    return machine.eeprom_store() == nullptr || machine.eeprom_store()->save(machine.eeprom_image);
}

void load_fields(machine::Machine& machine, std::string_view prefix, const Variables* kept) {
    apply_image(machine, machine.eeprom_image, prefix, kept);
}

void apply_image(machine::Machine& machine, std::string_view image, std::string_view prefix,
                 const Variables* kept) {
    each_line(image, [&](std::string_view path, std::string_view text) {
        each_kept(kept, prefix, [&](const std::string& name, std::size_t i) {
            if (const auto number = number_in(text); number && name == path) {
                kept->values[i] = std::clamp(*number, kept->infos[i].min, kept->infos[i].max);
            }
        });
        const Field* field = find_field(path);
        if (field == nullptr || !field->stored || !path.starts_with(prefix)) {
            return;
        }
        if (field->type == FieldType::text) {
            set_field(machine, *field, Value::of(text));
            return;
        }
        if (const auto number = number_in(text)) {
            set_field(machine, *field, Value::of(*number));
        }
    });
}

}  // namespace fauxboard::behaviour
