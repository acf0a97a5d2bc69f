#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "emulator/behaviour/document.h"
#include "emulator/control/target.h"

namespace fauxboard::control {

class Hub;
class Session;

/// What a parameter of a request may be.
enum class ParamType : std::uint8_t {
    any,
    text,
    names,  ///< a text, or a list of texts
    object,
    number,
    time,  ///< "200ms", "10s", "5min", "2h", or a number of seconds
};
std::string_view type_name(ParamType type);

struct Param {
    std::string_view name;
    ParamType type;
    bool required;
    std::string_view help;
};

/// A request while it is carried out: its keys are known and of the right types.
struct Call {
    Session& session;
    Hub& hub;
    Target& target;
    board::Board& board;
    SimTime now;
    const behaviour::Document& document;  ///< the request, with its places

    /// The value of a parameter, or null when it is not given.
    const Json* find(std::string_view name) const;
    /// A required one.
    const Json& at(std::string_view name) const { return *find(name); }
    /// A `names` parameter as a list; `fallback` when it is not given.
    std::vector<std::string> names(std::string_view name, std::vector<std::string> fallback) const;
    /// A `time` parameter. Throws ControlError when it is none, or out of bounds.
    SimTime time(std::string_view name, SimTime min, SimTime max) const;
};

/// Something a client can ask for. One row here is the whole declaration: requests are checked and carried
/// out by it, and the reference is made from it.
struct Op {
    std::string_view name;
    std::string_view help;
    std::span<const Param> params;
    /// The members of the answer; nothing when it comes later (see Session::answer_at). Throws ControlError.
    std::optional<Json> (*run)(const Call& call);
    /// It does something that nothing else tells of: whoever keeps a log wants to know of it.
    bool acts = false;
};

/// All, in the order of the reference.
std::span<const Op> ops();

/// What clients can be told unasked.
enum class TopicId : std::uint8_t {
    state,
    traffic,
    notices,
    link,
    spoiled,
    judged,
    screen,
    scenario,
    drawing
};

constexpr std::uint32_t bit(TopicId topic) {
    return std::uint32_t{1} << static_cast<unsigned>(topic);
}

/// In the order of TopicId.
struct Topic {
    TopicId id;
    std::string_view name;
    std::string_view help;
    std::string_view example;  ///< one line of it
};
std::span<const Topic> topics();

/// The op that the request names, its parameters checked. Throws ControlError.
const Op& check_request(const behaviour::Document& document);

/// The reference: {"ops": [...], "topics": [...], "errors": [...]}.
Json describe_control();

}  // namespace fauxboard::control
