#include "emulator/behaviour/reader.h"

#include <fmt/format.h>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/wire_text.h"

namespace fauxboard::behaviour {

std::string found(const Json& value) {
    switch (value.type()) {
        case Json::value_t::null:
            return "found null";
        case Json::value_t::object:
            return "found an object";
        case Json::value_t::array:
            return "found an array";
        case Json::value_t::string: {
            const auto& text = value.get_ref<const std::string&>();
            return "found the text \"" + text.substr(0, 60) + (text.size() > 60 ? "...\"" : "\"");
        }
        default:
            return "found " + value.dump();
    }
}

ObjectReader::ObjectReader(const Json& node, std::string pointer, Findings& findings)
    : pointer_(std::move(pointer)), findings_(findings) {
    if (node.is_object()) {
        object_ = &node;
    } else {
        findings_.add(pointer_, found(node) + "; expected an object");
    }
}

std::string ObjectReader::pointer(std::string_view key) const {
    std::string out = pointer_ + "/";
    for (const char c : key) {
        out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return out;
}

const Json* ObjectReader::get(std::string_view key) {
    known_.emplace(key);
    if (object_ == nullptr) {
        return nullptr;
    }
    const auto hit = object_->find(std::string(key));
    return hit == object_->end() ? nullptr : &*hit;
}

bool ObjectReader::has(std::string_view key) {
    return get(key) != nullptr;
}

const Json* ObjectReader::typed(std::string_view key, bool (Json::*test)() const noexcept,
                                std::string_view expected) {
    const Json* value = get(key);
    if (value == nullptr) {
        return nullptr;
    }
    if (!(value->*test)()) {
        findings_.add(pointer(key), fmt::format("{}; expected {}", found(*value), expected));
        return nullptr;
    }
    return value;
}

void ObjectReader::number(std::string_view key, double& out, double min, double max) {
    if (const Json* value = typed(key, &Json::is_number, fmt::format("a number from {} to {}", min, max))) {
        const auto n = value->get<double>();
        if (n >= min && n <= max) {
            out = n;
        } else {
            findings_.add(pointer(key),
                          fmt::format("{}; expected a number from {} to {}", found(*value), min, max));
        }
    }
}

template <class T>
void ObjectReader::whole(std::string_view key, T& out, T min, T max) {
    const std::string expected = fmt::format("a whole number from {} to {}", min, max);
    if (const Json* value = typed(key, &Json::is_number, expected)) {
        const auto n = value->get<double>();
        if (n >= min && n <= max && n == static_cast<double>(static_cast<T>(n))) {
            out = static_cast<T>(n);
        } else {
            findings_.add(pointer(key), fmt::format("{}; expected {}", found(*value), expected));
        }
    }
}

template void ObjectReader::whole(std::string_view key, int& out, int min, int max);
template void ObjectReader::whole(std::string_view key, unsigned& out, unsigned min, unsigned max);

void ObjectReader::boolean(std::string_view key, bool& out) {
    if (const Json* value = typed(key, &Json::is_boolean, "true or false")) {
        out = value->get<bool>();
    }
}

void ObjectReader::text(std::string_view key, std::string& out, std::size_t max_bytes) {
    if (const Json* value = typed(key, &Json::is_string, "a text")) {
        const auto& t = value->get_ref<const std::string&>();
        if (t.size() > max_bytes) {
            findings_.add(pointer(key),
                          fmt::format("a text of {} bytes; expected at most {}", t.size(), max_bytes));
            return;
        }
        out = t;
    }
}

void ObjectReader::wire_text(std::string_view key, std::string& out, std::size_t max_bytes) {
    std::string utf8 = from_wire(out);
    text(key, utf8, max_bytes * 2);
    const auto bytes = to_wire(utf8);
    if (!bytes || bytes->size() > max_bytes) {
        findings_.add(pointer(key),
                      fmt::format("\"{}\" cannot go on the wire: at most {} characters, each of one byte "
                                  "(up to U+00FF)",
                                  utf8.substr(0, 60), max_bytes));
        return;
    }
    out = *bytes;
}

void ObjectReader::choice(std::string_view key, std::span<const std::string_view> names, std::size_t& out) {
    const Json* value = typed(key, &Json::is_string, fmt::format("one of {}", fmt::join(names, ", ")));
    if (value == nullptr) {
        return;
    }
    const auto& t = value->get_ref<const std::string&>();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == t) {
            out = i;
            return;
        }
    }
    findings_.add(pointer(key), fmt::format("{}; expected one of {}", found(*value), fmt::join(names, ", ")),
                  std::string(nearest(t, names)));
}

void ObjectReader::numbers(std::string_view key, std::span<double> out, double min, double max) {
    const Json* value = typed(key, &Json::is_array, fmt::format("{} numbers", out.size()));
    if (value == nullptr) {
        return;
    }
    if (value->size() != out.size()) {
        findings_.add(pointer(key),
                      fmt::format("an array of {}; expected {} numbers", value->size(), out.size()));
        return;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Json& item = (*value)[i];
        if (item.is_number() && item.get<double>() >= min && item.get<double>() <= max) {
            out[i] = item.get<double>();
        } else {
            findings_.add(pointer(key) + "/" + std::to_string(i),
                          fmt::format("{}; expected a number from {} to {}", found(item), min, max));
        }
    }
}

void ObjectReader::axes(std::string_view key, std::span<const std::string_view> names,
                        std::span<std::optional<double>> out, double min, double max) {
    const Json* value = get(key);
    if (value == nullptr) {
        return;
    }
    ObjectReader reader(*value, pointer(key), findings_);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (reader.has(names[i])) {
            double mm = 0;
            reader.number(names[i], mm, min, max);
            out[i] = mm;
        }
    }
    reader.finish();
}

void ObjectReader::required(std::string_view key) {
    if (object_ != nullptr && !has(key)) {
        findings_.add(pointer_, fmt::format("the key \"{}\" is missing", key));
    }
}

void ObjectReader::finish() {
    if (object_ == nullptr) {
        return;
    }
    for (const auto& [key, value] : object_->items()) {
        if (known_.contains(key) || key == "$schema" || key == "comment") {
            continue;
        }
        const std::vector<std::string_view> names(known_.begin(), known_.end());
        findings_.add(pointer(key), fmt::format("unknown key \"{}\"", key), std::string(nearest(key, names)));
    }
}

}  // namespace fauxboard::behaviour
