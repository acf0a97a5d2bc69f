// Which line of the board answers which request, and how long it took.

#include <algorithm>
#include <array>
#include <cctype>

#include "emulator/record/compare_talk.h"
#include "protocol/command.h"
#include "protocol/framing.h"

namespace fauxboard::record::detail {
namespace {

/// Before it no reply can be: the board answers on the tick after the one that executes.
constexpr double soonest_s = 0.03;
constexpr double window_s = 0.3;
/// Requests whose lines come when the motion they start is done, or in a slot of the schedule.
constexpr std::array<std::string_view, 3> answered_later{"G28", "G29", "M165"};
/// What a board also says by itself, so that it is a reply only to those who ask for it; L14 and L16 are the
/// USB host's and the power's doing.
constexpr std::array<std::string_view, 7> spontaneous{"L1", "L2", "L3", "L21", "L22", "L14", "L16"};

/// The catalogue's `answer` ("L24 P5", "L14, or L18 P26 S3 or S10") as labels. Empty: none, or none at once.
std::vector<std::string> labels_of(std::string_view answer) {
    std::vector<std::string> out;
    if (answer.starts_with("none") || answer.find(" by the document") != std::string_view::npos ||
        answer.find(" slot") != std::string_view::npos) {
        return out;
    }
    if (!answer.empty() && answer[0] != 'L') {
        out.emplace_back(answer);
        return out;
    }
    const auto digits = [&](std::size_t from) {
        std::size_t end = from;
        while (end < answer.size() && std::isdigit(static_cast<unsigned char>(answer[end])) != 0) {
            ++end;
        }
        return end;
    };
    for (std::size_t at = answer.find('L'); at != std::string_view::npos; at = answer.find('L', at + 1)) {
        std::size_t end = digits(at + 1);
        if (end == at + 1) {
            continue;
        }
        if (answer.substr(end).starts_with(" P")) {
            end = digits(end + 2);
        }
        out.emplace_back(answer.substr(at, end - at));
    }
    return out;
}

bool matches(const Said& said, const std::string& label) {
    return said.label == label || said.code == label;
}

struct Request {
    double t = 0;
    std::string body;
    std::vector<std::string> answers;
};

std::vector<Request> requests_of(const std::vector<RecordedLine>& recording) {
    std::vector<Request> out;
    for (const RecordedLine& line : recording) {
        if (line.from != RecordedLine::From::screen) {
            continue;
        }
        Request request;
        request.t = machine::to_seconds(line.t);
        request.body = std::string(protocol::unframe(line.bytes, protocol::ChecksumPolicy::ignored).body);
        const auto decoded = protocol::decode_line(line.bytes, protocol::Direction::to_board);
        const bool later = std::find(answered_later.begin(), answered_later.end(), decoded.code_text) !=
                           answered_later.end();
        if (decoded.code != nullptr && !later) {
            request.answers = labels_of(decoded.code->answer);
        }
        out.push_back(std::move(request));
    }
    return out;
}

/// The oldest line in the request's window that is nobody's reply yet and passes `is_reply`.
template <class F>
Said* find_reply(std::vector<Said>& talk, double t, F&& is_reply) {
    const auto from = std::lower_bound(talk.begin(), talk.end(), t + soonest_s,
                                       [](const Said& said, double time) { return said.t < time; });
    for (auto said = from; said != talk.end() && said->t <= t + window_s; ++said) {
        if (!said->taken && is_reply(*said)) {
            return &*said;
        }
    }
    return nullptr;
}

struct Reply {
    std::string label;
    std::optional<double> ms;
};

/// The reply to each request, if any. Requests that have an answer choose first; what is then left over, and
/// is nothing a board says by itself, is an unexpected reply to one that should have none.
std::vector<Reply> replies(const std::vector<Request>& requests, std::vector<Said>& talk) {
    std::vector<Reply> out(requests.size());
    const auto take = [&](std::size_t i, Said* said) {
        if (said != nullptr) {
            said->taken = true;
            out[i] = {said->label, (said->t - requests[i].t) * 1000};
        }
    };
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const auto& answers = requests[i].answers;
        take(i, find_reply(talk, requests[i].t, [&](const Said& said) {
                 return std::any_of(answers.begin(), answers.end(),
                                    [&](const std::string& label) { return matches(said, label); });
             }));
    }
    for (std::size_t i = 0; i < requests.size(); ++i) {
        if (requests[i].answers.empty()) {
            take(i, find_reply(talk, requests[i].t, [](const Said& said) {
                     return std::find(spontaneous.begin(), spontaneous.end(), said.code) == spontaneous.end();
                 }));
        }
    }
    return out;
}

}  // namespace

std::vector<RequestRow> compare_requests(const std::vector<RecordedLine>& recording, std::vector<Said> theirs,
                                         std::vector<Said> ours, const Tolerances& tolerances) {
    const std::vector<Request> requests = requests_of(recording);
    const std::vector<Reply> recorded = replies(requests, theirs);
    const std::vector<Reply> given = replies(requests, ours);
    std::vector<RequestRow> rows;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        RequestRow row;
        row.t = requests[i].t;
        row.request = requests[i].body;
        row.recorded = recorded[i].label;
        row.ours = given[i].label;
        row.recorded_ms = recorded[i].ms;
        row.our_ms = given[i].ms;
        row.same = row.recorded == row.ours;
        row.in_time = true;
        if (row.our_ms) {
            const bool inside =
                *row.our_ms >= tolerances.reply_min_ms && *row.our_ms <= tolerances.reply_max_ms;
            const bool beside = row.recorded_ms && std::abs(*row.our_ms - *row.recorded_ms) <=
                                                       tolerances.reply_beside_recorded_ms;
            row.in_time = inside || beside;
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace fauxboard::record::detail
