#include "emulator/control/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "emulator/behaviour/document.h"
#include "emulator/control/hub.h"
#include "emulator/control/ops.h"
#include "protocol/secrets.h"

namespace fauxboard::control {
namespace {

constexpr std::size_t most_told = 200;  // of a parameter, to a log

behaviour::Document parse(std::string_view line) {
    try {
        return behaviour::parse_document({"request", std::string(line)});
    } catch (const behaviour::ProfileError& error) {
        const behaviour::Problem& problem = error.problems().front();
        throw ControlError(ErrorCode::bad_json,
                           (problem.pointer.empty() ? "" : problem.pointer + ": ") + problem.message);
    }
}

Json failure(Json answer, const ControlError& error) {
    answer["ok"] = false;
    answer["error"] = error_json(error);
    return answer;
}

/// "a client: advance by=10.0".
std::string did(const Op& op, const Json& request) {
    std::string text = fmt::format("a client: {}", op.name);
    for (const Param& param : op.params) {
        if (const auto value = request.find(param.name); value != request.end()) {
            const std::string words = value->is_string()
                                          ? value->get<std::string>()
                                          : value->dump(-1, ' ', true, Json::error_handler_t::replace);
            text += fmt::format(" {}={}", param.name, protocol::mask_secrets(words.substr(0, most_told)));
        }
    }
    return text;
}

}  // namespace

Session::Session(Hub& hub, std::function<void()> wake) : hub_(hub), wake_(std::move(wake)) {
    hub_.add(*this);
}

Session::~Session() {
    hub_.remove(*this);
}

void Session::wake() {
    if (!std::exchange(woken_, true)) {
        wake_();
    }
}

// Requests.
// -----------------------------------------------------------------------------------------------

void Session::receive(std::string_view bytes) {
    if (!over_ && !finished_) {
        input_.append(bytes);
        proceed();
    }
}

void Session::finish() {
    finished_ = true;
    proceed();
}

void Session::proceed() {
    std::size_t at = 0;
    while (!over_ && !busy()) {
        const std::size_t end = input_.find('\n', at);
        if (std::min(end, input_.size()) - at > most_line) {
            close_with(ErrorCode::too_long,
                       fmt::format("A request is one line of at most {} bytes; this one is longer. Goodbye.",
                                   most_line));
        } else if (end == std::string::npos) {
            if (finished_ && at != input_.size()) {
                close_with(ErrorCode::half_line,
                           "The last line had no line end, so it may be half a request and was not carried "
                           "out; end each request with a line feed.");
            }
            break;
        } else {
            carry_out(std::string_view(input_).substr(at, end - at));
            at = end + 1;
        }
    }
    input_.erase(0, over_ ? input_.size() : at);
}

void Session::carry_out(std::string_view line) {
    if (line.ends_with('\r')) {
        line.remove_suffix(1);
    }
    if (line.find_first_not_of(" \t") == std::string_view::npos) {
        return;
    }
    bool later = false;
    Json json = answer_to(line, later);
    if (later) {
        later_ = std::move(json);
    } else {
        answer(json);
    }
}

/// The whole answer; `later` when it has to wait for its time.
Json Session::answer_to(std::string_view line, bool& later) {
    Json out = Json::object();
    try {
        const behaviour::Document document = parse(line);
        if (document.root.is_object() && document.root.contains("id")) {
            out["id"] = document.root["id"];
        }
        const Op& op = check_request(document);
        std::optional<Json> members;
        hub_.target().visit([&](board::Board& board, SimTime now) {
            members = op.run({*this, hub_, hub_.target(), board, now, document});
            if (op.acts) {
                hub_.target().tell(now, did(op, document.root));
            }
        });
        later = !members.has_value();
        out["ok"] = true;
        if (members) {
            out.update(*members);
        }
        return out;
    } catch (const ControlError& error) {
        return failure(std::move(out), error);
    } catch (const std::exception& error) {
        return failure(std::move(out),
                       ControlError(ErrorCode::internal, std::string("A bug in fauxboard: ") + error.what()));
    }
}

void Session::answer(const Json& json) {
    output_ += to_line(json);
    wake();
}

void Session::close_with(ErrorCode code, const std::string& sentence) {
    answer(failure(Json::object(), ControlError(code, sentence)));
    over_ = true;
}

bool Session::over() const {
    return over_ || (finished_ && !busy() && input_.empty());
}

std::string Session::take_output() {
    woken_ = false;
    if (lost_ != 0) {
        output_ += to_line({{"event", "lost"}, {"count", std::exchange(lost_, 0)}});
    }
    return std::exchange(output_, {});
}

// Events.
// -----------------------------------------------------------------------------------------------

void Session::tell(const Json& event) {
    if (over_) {
        return;
    }
    if (output_.size() < most_waiting) {
        output_ += to_line(event);
    } else {
        if (++lost_ >= most_lost) {
            over_ = dropped_ = true;
            woken_ = false;  // whatever it was told before, this it must hear
        }
    }
    wake();
}

SimTime Session::on_moved(const board::Board& board, SimTime now) {
    SimTime next = machine::never;
    if (until_ && *until_ <= now) {
        until_.reset();
        later_["t"] = machine::to_seconds(now);
        answer(std::exchange(later_, Json{}));
    } else if (until_) {
        next = *until_;
    }
    if (wants(TopicId::state) && !over_) {
        if (subscriptions.due <= now) {
            sample(board, now);
            subscriptions.due = now + subscriptions.every;
        }
        next = std::min(next, subscriptions.due);
    }
    return next;
}

void Session::sample(const board::Board& board, SimTime now) {
    Json changed = Json::object();
    for (std::size_t i = 0; i < subscriptions.places.size(); ++i) {
        const Place& place = subscriptions.places[i];
        Json value = value_of(board, place);
        if (value != subscriptions.last[i]) {
            changed[place.name] = value;
            subscriptions.last[i] = std::move(value);
        }
    }
    if (!changed.empty()) {
        tell({{"event", "state"}, {"t", machine::to_seconds(now)}, {"fields", std::move(changed)}});
    }
}

void Session::on_reload(const board::Board& board) {
    const std::vector<Place> known = all_places(board);
    std::vector<Place> places;
    std::vector<Json> last;
    for (std::size_t i = 0; i < subscriptions.places.size(); ++i) {
        const auto hit = std::find_if(known.begin(), known.end(), [&](const Place& each) {
            return each.name == subscriptions.places[i].name;
        });
        if (hit != known.end()) {
            places.push_back(*hit);
            last.push_back(std::move(subscriptions.last[i]));
        }
    }
    subscriptions.places = std::move(places);
    subscriptions.last = std::move(last);
}

void Session::on_end() {
    if (until_) {
        until_.reset();
        answer(failure(std::exchange(later_, Json{}),
                       ControlError(ErrorCode::ended, "The run ended before this was done.")));
    }
    over_ = true;
}

}  // namespace fauxboard::control
