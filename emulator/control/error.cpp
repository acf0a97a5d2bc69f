#include "emulator/control/error.h"

#include <algorithm>
#include <array>

namespace fauxboard::control {
namespace {

using enum ErrorCode;

constexpr std::array table{
    ErrorInfo{bad_json, "bad-json", "the line is no JSON object, gives a key twice or is nested too deep"},
    ErrorInfo{bad_request, "bad-request", "no op, or a key that the op does not take"},
    ErrorInfo{unknown_op, "unknown-op", "no such op"},
    ErrorInfo{unknown_field, "unknown-field", "no field, group of fields or variable of that name"},
    ErrorInfo{unknown_action, "unknown-action", "no action or phrase of that name"},
    ErrorInfo{unknown_frame, "unknown-frame", "the profile has no frame of that name"},
    ErrorInfo{unknown_fault, "unknown-fault", "no fault of that id"},
    ErrorInfo{wrong_type, "wrong-type", "a value of another type than expected"},
    ErrorInfo{out_of_range, "out-of-range", "a value beyond its bounds, which the message names"},
    ErrorInfo{read_only, "read-only", "a field that can be read but not set"},
    ErrorInfo{bad_arguments, "bad-arguments", "an action or fault with arguments it does not take"},
    ErrorInfo{refused, "refused", "the machine did not do it; the message says why"},
    ErrorInfo{not_here, "not-here", "this run cannot do that at all"},
    ErrorInfo{too_long, "too-long", "a line longer than a request may be; the client is dropped"},
    ErrorInfo{half_line, "half-line", "the client left in the middle of a line; it was not carried out"},
    ErrorInfo{too_many_clients, "too-many-clients", "nobody else can connect; the client is turned away"},
    ErrorInfo{ended, "ended", "the run ended before the request was done"},
    ErrorInfo{internal, "internal", "a bug in fauxboard: please report it"},
};

}  // namespace

std::span<const ErrorInfo> errors() {
    return table;
}

std::string_view error_name(ErrorCode code) {
    const auto* hit =
        std::find_if(table.begin(), table.end(), [code](const ErrorInfo& row) { return row.code == code; });
    return hit == table.end() ? "internal" : hit->name;
}

Json error_json(const ControlError& error) {
    Json out{{"code", error_name(error.code)}, {"message", error.what()}};
    if (!error.nearest.empty()) {
        out["nearest"] = error.nearest;
    }
    return out;
}

std::string to_line(const Json& json) {
    return json.dump(-1, ' ', true, Json::error_handler_t::replace) + '\n';
}

}  // namespace fauxboard::control
