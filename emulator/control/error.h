#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/behaviour/document.h"

namespace fauxboard::control {

using behaviour::Json;

/// Why a request was not done, for programs. Each has its row in errors().
enum class ErrorCode : std::uint8_t {
    bad_json,
    bad_request,
    unknown_op,
    unknown_field,
    unknown_action,
    unknown_frame,
    unknown_fault,
    wrong_type,
    out_of_range,
    read_only,
    bad_arguments,
    refused,
    not_here,
    too_long,
    half_line,
    too_many_clients,
    ended,
    internal,
};

struct ErrorInfo {
    ErrorCode code;
    std::string_view name;
    std::string_view help;
};

/// All of them, in the order of the reference.
std::span<const ErrorInfo> errors();
std::string_view error_name(ErrorCode code);

/// A request that cannot be done. what() is a full sentence; `nearest` the known name most like a wrong one,
/// may be empty.
class ControlError : public std::runtime_error {
  public:
    ControlError(ErrorCode why, const std::string& sentence, std::string_view nearest_name = {})
        : std::runtime_error(sentence), code(why), nearest(nearest_name) {}
    ErrorCode code;
    std::string nearest;
};

/// {"code": ..., "message": ..., "nearest": ...}
Json error_json(const ControlError& error);

/// One line of the channel: JSON in ASCII, with its line end.
std::string to_line(const Json& json);

}  // namespace fauxboard::control
