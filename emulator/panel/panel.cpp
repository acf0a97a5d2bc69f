#include "emulator/panel/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "emulator/panel/assets.h"
#include "emulator/panel/shelf.h"

namespace fauxboard::panel {
namespace {

using control::Json;

constexpr std::string_view json_type = "application/json";

/// Lines of JSON as server-sent events.
std::string as_events(std::string_view lines) {
    std::string out;
    out.reserve(lines.size() + lines.size() / 8);
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size() - 1);
        out += "data: ";
        out += lines.substr(0, end + 1);
        out += '\n';
        lines.remove_prefix(end + 1);
    }
    return out;
}

Reply refuse(unsigned status, std::string_view why) {
    return {status, Reply{}.type, std::string(why) + "\n", {}};
}

}  // namespace

/// A client of the control channel whose bytes come by POST and go by a stream.
class Panel::Session final : public Stream {
  public:
    Session(Panel& panel, std::size_t board)
        : panel_(panel),
          board_(board),
          number_(++panel.last_session_),
          hello_(fmt::format("{{\"session\": {}}}\n", number_)),
          session_(panel.boards_[board].target.hub(), [&panel] { panel.server_->nudge(); }) {
        panel_.sessions_.push_back(this);
        tell("came to");
    }
    ~Session() override {
        std::erase(panel_.sessions_, this);
        tell("left");
    }

    bool is(std::size_t board, std::uint64_t number) const { return board_ == board && number_ == number; }
    bool wants_turn() const override { return !hello_.empty() || session_.has_output() || session_.over(); }
    std::optional<std::string> take() override {
        if (!hello_.empty()) {
            return as_events(std::exchange(hello_, {}));
        }
        std::string output = session_.take_output();
        session_.proceed();
        if (!held_.empty() && session_.wants_input()) {
            session_.receive(std::exchange(held_, {}));
        }
        if (output.empty() && (session_.over() || session_.dropped())) {
            return std::nullopt;
        }
        return as_events(output);
    }
    Reply receive(std::string_view body) {
        if (held_.size() + body.size() > most_held) {
            return refuse(503, "The page does not keep up with what it asked for; try again in a moment.");
        }
        if (!held_.empty() || !session_.wants_input()) {
            held_ += body;  // an answer that takes its time is under way, or nobody reads
        } else {
            session_.receive(body);
        }
        return {204, Reply{}.type, {}, {}};
    }

  private:
    void tell(std::string_view what) const {
        if (const Shown& shown = panel_.boards_[board_]; shown.tell) {
            const auto pages = std::count_if(panel_.sessions_.begin(), panel_.sessions_.end(),
                                             [this](const Session* each) { return each->board_ == board_; });
            shown.tell(fmt::format("a page {} the board; pages in browsers: {}", what, pages));
        }
    }

    Panel& panel_;
    std::size_t board_;
    std::uint64_t number_;
    static constexpr std::size_t most_held = 64UL * 1024;
    std::string hello_;
    std::string held_;  ///< requests that wait for their turn
    control::Session session_;
};

/// The overview of all boards.
class Panel::Shelf final : public Stream {
  public:
    explicit Shelf(Panel& panel)
        : panel_(panel), cards_(panel.boards_.size()), timer_(panel.loop_, [this] { tick(); }) {
        ++panel_.shelves_;
    }
    ~Shelf() override { --panel_.shelves_; }

    bool wants_turn() const override { return due_; }
    std::optional<std::string> take() override {
        if (!std::exchange(due_, false)) {
            return std::string();
        }
        timer_.after(shelf_pause);
        Json changed = Json::array();
        for (std::size_t n = 0; n < cards_.size(); ++n) {
            if (Json now = cards_[n].changes(panel_.boards_[n].target); !now.empty()) {
                now["n"] = n;
                changed.push_back(std::move(now));
            }
        }
        return changed.empty() ? std::string() : as_events(control::to_line(changed));
    }

  private:
    void tick() {
        due_ = true;
        panel_.server_->nudge();
    }

    Panel& panel_;
    std::vector<ShelfCard> cards_;
    link::Timer timer_;
    bool due_ = true;
};

Panel::Panel(link::EventLoop& loop, const std::string& where, std::vector<Shown> boards)
    : loop_(loop), boards_(std::move(boards)), server_(new HttpServer(loop, where, *this)) {}

Panel::~Panel() = default;

std::string Panel::list() const {
    Json out = Json::array();
    for (const Shown& shown : boards_) {
        const behaviour::Profile& profile = shown.target.board().profile();
        out.push_back({{"name", shown.name}, {"profile", profile.name}, {"title", profile.title}});
    }
    return control::to_line(out);
}

Reply Panel::get(const Route& route) {
    if (route.count == 1 && route.parts[0] == "boards") {
        return {200, json_type, list(), {}};
    }
    const Asset* asset =
        route.count <= 1 ? find_asset(route.count == 0 ? "index.html" : route.parts[0]) : nullptr;
    return asset == nullptr ? refuse(404, "Nothing is here.") : Reply{200, asset->type, {}, asset->bytes};
}

Reply Panel::post(const Route& route, std::string_view body) {
    const auto board = parse_number(route.parts[1]);
    const auto number = parse_number(route.parts[2]);
    if (route.count != 3 || route.parts[0] != "live" || !board || !number) {
        return refuse(404, "Nothing is here.");
    }
    const auto session = std::find_if(sessions_.begin(), sessions_.end(),
                                      [&](const Session* each) { return each->is(*board, *number); });
    return session == sessions_.end() ? refuse(410, "This session is over.") : (*session)->receive(body);
}

std::unique_ptr<Stream> Panel::stream(const Route& route) {
    if (route.count == 1 && route.parts[0] == "shelf" && shelves_ < most_shelves) {
        return std::make_unique<Shelf>(*this);
    }
    if (route.count == 2 && route.parts[0] == "live" && sessions_.size() < most_sessions) {
        if (const auto board = parse_number(route.parts[1]); board && *board < boards_.size()) {
            return std::make_unique<Session>(*this, *board);
        }
    }
    return nullptr;
}

}  // namespace fauxboard::panel
