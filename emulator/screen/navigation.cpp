#include "emulator/screen/navigation.h"

#include <fmt/format.h>

#include <algorithm>

namespace fauxboard::screen {
namespace {

constexpr double most_rows = 1e6;
constexpr unsigned send_cost = 20;  ///< a way that sends nothing is taken, even if it is longer

/// One edge of the map of pages.
struct Edge {
    Step step;
    std::size_t to = no_page;
    unsigned cost = 1;
};

/// The edges from `page`; with `anyway` also those that are not open now.
std::vector<Edge> edges_from(const Standpoint& at, std::size_t page, bool anyway) {
    std::vector<Edge> out;
    Standpoint here{at.profile, at.values, page, page == at.page ? at.before : no_page};
    for (const std::size_t id : at.profile.pages[page].buttons) {
        const Button& button = at.profile.buttons[id];
        const auto row = here.visible(button);
        if (!row && !anyway) {
            continue;
        }
        const Scope scope = here.scope(button, row.value_or(1));
        std::vector<std::size_t> ends;
        if (const auto to = here.destination(button.leads_to, scope)) {
            ends.push_back(*to);
        }
        if (anyway) {
            for (const Target& target : button.leads_to) {
                if (target.page != no_page) ends.push_back(target.page);
            }
        }
        for (const std::size_t to : ends) {
            if (to != no_page && to != page && (anyway || here.shut(to).empty())) {
                const bool talks = !button.send.empty() || !at.profile.pages[to].send.empty();
                out.push_back({{id, row.value_or(1)}, to, talks ? send_cost : 1});
            }
        }
    }
    return out;
}

bool has_button(const ScreenProfile& profile, std::size_t page, std::size_t button) {
    const auto& buttons = profile.pages[page].buttons;
    return std::find(buttons.begin(), buttons.end(), button) != buttons.end();
}

/// Dijkstra over the pages; there are few, so the nearest is looked for by hand.
template <class IsGoal>
std::optional<std::vector<Step>> walk(const Standpoint& from, IsGoal&& is_goal, bool anyway) {
    struct Node {
        unsigned cost = ~0U;
        std::size_t came_from = no_page;
        Step by;
        bool done = false;
    };
    std::vector<Node> nodes(from.profile.pages.size());
    nodes[from.page].cost = 0;
    for (;;) {
        std::size_t best = no_page;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (!nodes[i].done && nodes[i].cost != ~0U &&
                (best == no_page || nodes[i].cost < nodes[best].cost)) {
                best = i;
            }
        }
        if (best == no_page) {
            return std::nullopt;
        }
        if (is_goal(best)) {
            std::vector<Step> steps;
            for (std::size_t at = best; at != from.page; at = nodes[at].came_from) {
                steps.insert(steps.begin(), nodes[at].by);
            }
            return steps;
        }
        nodes[best].done = true;
        for (const Edge& edge : edges_from(from, best, anyway)) {
            const unsigned cost = nodes[best].cost + edge.cost;
            if (cost < nodes[edge.to].cost) {
                nodes[edge.to] = {cost, best, edge.step, false};
            }
        }
    }
}

}  // namespace

Scope Standpoint::scope(const Button& button, std::size_t row, double input) const {
    Scope out{values, row, {}, input};
    if (button.rows && row != 0 && row <= values[*button.rows].list.size()) {
        const Shown& list = values[*button.rows];
        out.row_text = list.list[row - 1];
        if (row <= list.cells.size()) {
            out.row_cells = list.cells[row - 1];
        }
    }
    return out;
}

std::size_t Standpoint::first_row(const Button& button) const {
    const double before_it = button.control ? button.control->first.evaluate({values, 0, {}, 0}) : 0;
    return before_it > 0 && before_it < most_rows ? static_cast<std::size_t>(before_it) + 1 : 1;
}

std::optional<std::size_t> Standpoint::visible(const Button& button, std::size_t row) const {
    if (!button.rows) {
        return all_hold(button.when, scope(button, 1)) ? std::optional<std::size_t>(1) : std::nullopt;
    }
    if (button.control && button.control->slots != 0) {
        const std::size_t first = first_row(button);
        const std::size_t wanted = row == 0 ? first : row;
        return wanted >= first && wanted < first + button.control->slots &&
                       all_hold(button.when, scope(button, wanted))
                   ? std::optional(wanted)
                   : std::nullopt;
    }
    const std::size_t last = values[*button.rows].list.size();
    for (std::size_t i = row == 0 ? 1 : row; i <= (row == 0 ? last : std::min(row, last)); ++i) {
        if (!values[*button.rows].list[i - 1].empty() && all_hold(button.when, scope(button, i))) {
            return i;
        }
    }
    return std::nullopt;
}

std::optional<std::size_t> Standpoint::destination(const std::vector<Target>& targets,
                                                   const Scope& scope) const {
    for (const Target& target : targets) {
        if (all_hold(target.when, scope)) {
            return target.where == Target::Where::back   ? profile.pages[page].parent
                   : target.where == Target::Where::page ? target.page
                                                         : before;
        }
    }
    return std::nullopt;
}

std::string Standpoint::shut(std::size_t page_id) const {
    const Scope scope{values, 0, {}, 0};
    for (const Condition& condition : profile.pages[page_id].open_when) {
        if (!condition.holds(scope)) {
            return fmt::format("{} stays shut now; it opens when {}, and it is {}",
                               profile.pages[page_id].path, condition.words(scope), condition.now(scope));
        }
    }
    return {};
}

std::string Standpoint::hidden(const Button& button, std::size_t row) const {
    if (visible(button, row)) {
        return {};
    }
    if (button.rows) {
        return fmt::format("\"{}\" is not there: no such entry in the list shown", button.path);
    }
    const Scope here = scope(button, 1);
    for (const Condition& condition : button.when) {
        if (!condition.holds(here)) {
            return fmt::format("\"{}\" is not there now; it is when {}, and it is {}", button.path,
                               condition.words(here), condition.now(here));
        }
    }
    return {};
}

std::optional<std::vector<Step>> find_route(const Standpoint& from, std::size_t button, std::size_t row) {
    const Button& wanted = from.profile.buttons[button];
    // Rows are known only once their page is open, so they are looked at there.
    if (!wanted.rows && !from.visible(wanted, row)) {
        return std::nullopt;
    }
    return walk(
        from, [&](std::size_t page) { return has_button(from.profile, page, button); }, false);
}

std::optional<std::vector<Step>> find_route_to_page(const Standpoint& from, std::size_t page) {
    return walk(
        from, [page](std::size_t here) { return here == page; }, false);
}

Obstacle find_obstacle(const Standpoint& from, std::size_t button, std::size_t row) {
    const Button& wanted = from.profile.buttons[button];
    if (!wanted.rows) {
        if (std::string why = from.hidden(wanted, row); !why.empty()) {
            return {why, true};
        }
    }
    std::size_t page = from.page;
    const auto way = walk(
        from, [&](std::size_t id) { return has_button(from.profile, id, button); }, true);
    for (const Step& step : way.value_or(std::vector<Step>{})) {
        const Standpoint here{from.profile, from.values, page, from.before};
        const Button& next = from.profile.buttons[step.button];
        if (std::string why = here.hidden(next, 0); !why.empty()) {
            return {fmt::format("\"{}\" cannot be reached: {}", wanted.path, why), true};
        }
        page = here.destination(next.leads_to, here.scope(next, 1)).value_or(page);
        if (std::string why = here.shut(page); !why.empty()) {
            return {fmt::format("\"{}\" cannot be reached: {}", wanted.path, why), false};
        }
    }
    const Page& own = from.profile.pages[wanted.page == no_page ? from.page : wanted.page];
    std::string why = fmt::format("\"{}\" cannot be reached by touch now", wanted.path);
    if (!own.opened_by.empty()) {
        why += fmt::format(": its page opens by itself, on \"{}\"", own.opened_by.front());
    }
    return {why, false};
}

}  // namespace fauxboard::screen
