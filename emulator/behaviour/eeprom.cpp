#include "emulator/behaviour/eeprom.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

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

void append_value(std::string& out, const Field& field, const printer::Printer& printer) {
    const Value value = field.get(printer);
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

}  // namespace

std::string make_image(const printer::Printer& printer) {
    std::string image;
    for (const Field& field : fields()) {
        if (field.stored) {
            append_value(image, field, printer);
        }
    }
    return image;
}

bool save_fields(printer::Printer& printer, std::string_view prefix) {
    std::string image;
    image.reserve(printer.eeprom_image.size() + 64);
    each_line(printer.eeprom_image, [&](std::string_view path, std::string_view value) {
        const Field* field = find_field(path);
        if (field == nullptr || !field->stored || !path.starts_with(prefix)) {
            image.append(path).append(" ").append(value).append("\n");
        }
    });
    for (const Field& field : fields()) {
        if (field.stored && field.path.starts_with(prefix)) {
            append_value(image, field, printer);
        }
    }
    printer.eeprom_image = std::move(image);
    return printer.eeprom_store() == nullptr || printer.eeprom_store()->save(printer.eeprom_image);
}

void load_fields(printer::Printer& printer, std::string_view prefix) {
    apply_image(printer, printer.eeprom_image, prefix);
}

void apply_image(printer::Printer& printer, std::string_view image, std::string_view prefix) {
    each_line(image, [&](std::string_view path, std::string_view text) {
        const Field* field = find_field(path);
        if (field == nullptr || !field->stored || !path.starts_with(prefix)) {
            return;
        }
        if (field->type == FieldType::text) {
            set_field(printer, *field, Value::of(text));
            return;
        }
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc{} && end == text.data() + text.size()) {
            set_field(printer, *field, Value::of(number));
        }
    });
}

}  // namespace fauxboard::behaviour
