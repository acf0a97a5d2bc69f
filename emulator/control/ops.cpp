#include "emulator/control/ops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/reader.h"
#include "emulator/control/op_rows.h"
#include "emulator/fault/quantity.h"

namespace fauxboard::control {
namespace {

constexpr std::size_t shown_bytes = 60;

std::string shown(std::string_view name) {
    return fmt::format("\"{}\"", name.substr(0, shown_bytes));
}

bool fits(ParamType type, const Json& value) {
    switch (type) {
        case ParamType::any:
            return true;
        case ParamType::text:
            return value.is_string();
        case ParamType::names:
            return value.is_string() ||
                   (value.is_array() && std::all_of(value.begin(), value.end(),
                                                    [](const Json& item) { return item.is_string(); }));
        case ParamType::object:
            return value.is_object();
        case ParamType::number:
            return value.is_number();
        case ParamType::time:
            return value.is_string() || value.is_number();
    }
    return false;
}

const Op& find_op(const std::string& name) {
    std::vector<std::string_view> names;
    for (const Op& op : ops()) {
        if (op.name == name) {
            return op;
        }
        names.push_back(op.name);
    }
    throw ControlError(ErrorCode::unknown_op,
                       fmt::format("There is no op {}; known: {}.", shown(name), fmt::join(names, ", ")),
                       behaviour::nearest(name, names));
}

void check_params(const Op& op, const Json& request) {
    std::vector<std::string_view> names{"id", "op"};
    for (const Param& param : op.params) {
        names.push_back(param.name);
        const auto hit = request.find(param.name);
        if (hit == request.end()) {
            if (param.required) {
                throw ControlError(ErrorCode::bad_request,
                                   fmt::format("{} needs \"{}\": {}.", op.name, param.name, param.help));
            }
        } else if (!fits(param.type, *hit)) {
            throw ControlError(ErrorCode::wrong_type,
                               fmt::format("{}: \"{}\": {}; expected {}.", op.name, param.name,
                                           behaviour::found(*hit), type_name(param.type)));
        }
    }
    for (const auto& [key, value] : request.items()) {
        if (std::find(names.begin(), names.end(), key) == names.end()) {
            throw ControlError(
                ErrorCode::bad_request,
                fmt::format("{} takes no {}; it takes: {}.", op.name, shown(key), fmt::join(names, ", ")),
                behaviour::nearest(key, names));
        }
    }
}

}  // namespace

std::string_view type_name(ParamType type) {
    switch (type) {
        case ParamType::any:
            return "anything";
        case ParamType::text:
            return "a text";
        case ParamType::names:
            return "a text or a list of texts";
        case ParamType::object:
            return "an object";
        case ParamType::number:
            return "a number";
        case ParamType::time:
            return "a time such as \"200ms\", or a number of seconds";
    }
    return "";
}

const Json* Call::find(std::string_view name) const {
    const auto hit = document.root.find(name);
    return hit == document.root.end() ? nullptr : &*hit;
}

std::vector<std::string> Call::names(std::string_view name, std::vector<std::string> fallback) const {
    const Json* value = find(name);
    if (value == nullptr) {
        return fallback;
    }
    if (value->is_string()) {
        return {value->get<std::string>()};
    }
    return value->get<std::vector<std::string>>();
}

SimTime Call::time(std::string_view name, SimTime min, SimTime max) const {
    const Json& value = at(name);
    const std::optional<double> us =
        value.is_number() ? std::optional{value.get<double>() * 1e6}
                          : fault::parse_quantity(value.get_ref<const std::string&>(), fault::time_units());
    if (!us || !std::isfinite(*us)) {
        throw ControlError(ErrorCode::wrong_type,
                           fmt::format("\"{}\": {}; expected {}.", name, behaviour::found(value),
                                       type_name(ParamType::time)));
    }
    if (*us < static_cast<double>(min.count()) || *us > static_cast<double>(max.count())) {
        throw ControlError(ErrorCode::out_of_range,
                           fmt::format("\"{}\": {} is out of bounds; expected {} to {}.", name, value.dump(),
                                       fault::time_text(min), fault::time_text(max)));
    }
    return SimTime{std::llround(*us)};
}

std::span<const Op> ops() {
    static const std::vector<Op> table = [] {
        std::vector<Op> all;
        for (const auto part : {rows::value_ops(), rows::machine_ops(), rows::fault_ops(), rows::view_ops(),
                                rows::display_ops(), rows::session_ops()}) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }();
    return table;
}

const Op& check_request(const behaviour::Document& document) {
    const Json& request = document.root;  // parse_document() gives objects only
    const auto op = request.find("op");
    if (op == request.end() || !op->is_string()) {
        throw ControlError(ErrorCode::bad_request,
                           "The request has no \"op\" that is a text; {\"op\": \"describe\"} lists them.");
    }
    const Op& row = find_op(op->get_ref<const std::string&>());
    check_params(row, request);
    return row;
}

Json describe_control() {
    Json list = Json::array();
    for (const Op& op : ops()) {
        Json params = Json::array();
        for (const Param& param : op.params) {
            params.push_back({{"name", param.name},
                              {"type", type_name(param.type)},
                              {"required", param.required},
                              {"help", param.help}});
        }
        list.push_back({{"name", op.name}, {"help", op.help}, {"params", std::move(params)}});
    }
    Json unasked = Json::array();
    for (const Topic& topic : topics()) {
        unasked.push_back({{"name", topic.name}, {"help", topic.help}, {"example", topic.example}});
    }
    Json codes = Json::array();
    for (const ErrorInfo& error : errors()) {
        codes.push_back({{"code", error.name}, {"help", error.help}});
    }
    return {{"ops", std::move(list)}, {"topics", std::move(unasked)}, {"errors", std::move(codes)}};
}

}  // namespace fauxboard::control
