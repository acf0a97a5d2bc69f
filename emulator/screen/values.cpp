#include "emulator/screen/values.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "emulator/behaviour/fields.h"
#include "emulator/behaviour/lists.h"
#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/number_text.h"
#include "emulator/behaviour/wire_text.h"

namespace fauxboard::screen {

bool ValueTable::add(ValueInfo info) {
    if (!ids_.emplace(info.name, infos_.size()).second) {
        return false;
    }
    infos_.push_back(std::move(info));
    return true;
}

std::optional<std::size_t> ValueTable::find(std::string_view name) const {
    const auto hit = ids_.find(name);
    return hit == ids_.end() ? std::nullopt : std::optional(hit->second);
}

std::optional<std::size_t> ValueTable::want(std::string_view name) {
    if (const auto id = find(name); id || !machine_) {
        return id;
    }
    ValueInfo info;
    info.name = name;
    if (const behaviour::List* list = behaviour::find_list(name)) {
        info.kind = ValueKind::list;
        info.source = list;
        info.columns.assign(list->columns.begin(), list->columns.end());
        add(std::move(info));
        return infos_.size() - 1;
    }
    const behaviour::Field* field = behaviour::find_field(name);
    if (field == nullptr) {
        return std::nullopt;
    }
    info.kind = field->type == behaviour::FieldType::text ? ValueKind::text : ValueKind::number;
    info.unit = field->unit;
    info.help = field->help;
    info.field = field;
    add(std::move(info));
    return infos_.size() - 1;
}

std::string ValueTable::nearest(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const ValueInfo& info : infos_) {
        names.emplace_back(info.name);
    }
    if (machine_) {
        for (const behaviour::Field& field : behaviour::fields()) {
            names.emplace_back(field.path);
        }
    }
    return std::string(behaviour::nearest(name, names));
}

std::vector<Shown> ValueTable::power_on() const {
    std::vector<Shown> values(infos_.size());
    for (std::size_t i = 0; i < infos_.size(); ++i) {
        values[i].number = infos_[i].start;
        values[i].text = infos_[i].start_text;
    }
    return values;
}

std::string fixed_text(double value, int decimals) {
    if (!std::isfinite(value)) {
        return std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
    }
    std::array<char, 48> text{};
    std::string out(text.data(), behaviour::write_fixed(text, value, decimals).size);
    if (out.starts_with('-') && out.find_first_not_of("-0.") == std::string::npos) {
        out.erase(0, 1);
    }
    return out;
}

std::string short_text(double value) {
    std::string out = fixed_text(value, 3);
    if (out.find('.') != std::string::npos) {
        out.erase(out.find_last_not_of('0') + 1);
        if (out.ends_with('.')) {
            out.pop_back();
        }
    }
    return out;
}

std::string printable(std::string_view bytes) {
    std::string out;
    for (const char byte : bytes) {
        const auto c = static_cast<unsigned char>(byte);
        if (c < 0x20 || (c >= 0x7F && c < 0xA0)) {
            out += fmt::format("\\x{:02X}", c);
        } else {
            out += behaviour::from_wire(std::string_view(&byte, 1));
        }
    }
    return out;
}

}  // namespace fauxboard::screen
