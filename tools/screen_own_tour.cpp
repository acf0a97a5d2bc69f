// `fauxboard screen tour --control PATH`: every page and every control of the screen that is part of a board.

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "emulator/screen/tour_report.h"
#include "tools/control_screen.h"
#include "tools/report.h"
#include "tools/screen_commands.h"

namespace fauxboard::tools {
namespace {

/// A box without buttons closes by itself: so long the tour waits for that, step by step.
constexpr std::string_view wait_step = "2s";
constexpr int most_waits = 900;
constexpr int work_waits = 15;
constexpr int last_waits = 100;
/// The second after all has come to rest.
constexpr int rounds = 2;
/// Of one control, at one place: it may lead on in several ways.
constexpr std::size_t most_touches = 4000;

/// What a touch led from and to.
struct Outcome {
    std::string from;
    std::string control;
    std::string to;
    std::string why;
};

/// Walks every page and every control, as a person would who tries everything.
class OwnTour {
  public:
    explicit OwnTour(ControlScreen& screen) : screen_(screen), profile_(screen.profile()) {
        for (const screen::Button& button : profile_->buttons) {
            for (const screen::Effect& effect : button.control ? button.control->touch : screen::Effects{}) {
                for (const screen::Target& target : effect.leads_to) {
                    if (target.page != screen::no_page) led_to_.insert(profile_->pages[target.page].path);
                }
            }
        }
    }

    /// The board's time stands still meanwhile, so that it is the same tour on a computer that is slow or
    /// busy.
    void run() {
        screen_.hold_time();
        for (int round = 0; round < rounds; ++round) {
            std::size_t touches = 0;
            for (Json page = settle(); touches < most_touches; ++touches) {
                const auto next = choose(page);
                if (!next) break;
                touch(page, *next);
                page = settle();
            }
            linger();
            ++confirmed_;  // a motor may be off by now
        }
    }

    /// One result for each control of each page, those never reached among them.
    std::vector<screen::TourResult> results() const {
        std::vector<screen::TourResult> out;
        for (const Outcome& one : outcomes_) {
            screen::TourResult result;
            result.button = one.from + "/" + one.control;
            result.came = {one.to};
            result.verdict = one.why.empty() ? screen::TourVerdict::met : screen::TourVerdict::not_pressed;
            result.sentence = one.why.empty() ? "leads to " + one.to : one.why;
            out.push_back(std::move(result));
        }
        for (const screen::Page& page : profile_->pages) {
            if (!seen_.contains(name_of(page))) {
                screen::TourResult result;
                result.button = page.path;
                result.sentence = page.path + (led_to_.contains(page.path)
                                                   ? ": no touch of this tour led to it"
                                                   : ": it comes by itself, and did not on this tour");
                out.push_back(std::move(result));
            }
        }
        return out;
    }
    /// Every control did what it should, and every page to which a control leads was seen. Those that come by
    /// themselves, of a fault for instance, may be missing.
    bool complete() const {
        return std::all_of(outcomes_.begin(), outcomes_.end(),
                           [](const Outcome& one) { return one.why.empty(); }) &&
               std::all_of(profile_->pages.begin(), profile_->pages.end(), [this](const screen::Page& page) {
                   return seen_.contains(name_of(page)) || !led_to_.contains(page.path);
               });
    }
    const std::string& name() const { return profile_->name; }

  private:
    static std::string name_of(const screen::Page& page) {
        return page.face.box ? page.face.box->caption.in(0).source() + page.face.box->text.in(0).source()
                             : page.path;
    }

    /// The page, once a box that closes by itself has done so.
    Json settle() {
        Json page = screen_.page();
        for (int i = 0; i < most_waits && page.at("controls").empty(); ++i) {
            note(page);
            if (!page.at("box").is_object() && i > 2) {
                screen_.touch(1, 1);  // a screensaver goes at any touch
            } else {
                screen_.pass(wait_step);
            }
            page = screen_.page();
        }
        note(page);
        return page;
    }

    void note(const Json& page) {
        seen_.insert(page.value("page", ""));
        if (!page.at("box").is_object()) return;
        // A box is known by what it says, places in its text left aside.
        for (const screen::Page& one : profile_->pages) {
            if (one.face.box && fits(one.face.box->caption, page.at("box").value("caption", "")) &&
                fits(one.face.box->text, page.at("box").value("text", ""))) {
                seen_.insert(name_of(one));
            }
        }
    }

    /// Whether the text may be that template filled in, in any language: what stands before its first place.
    static bool fits(const screen::Words& words, const std::string& text) {
        return std::any_of(words.by_language.begin(), words.by_language.end(), [&](const auto& one) {
            return text.starts_with(one.source().substr(0, one.source().find('{')));
        });
    }

    /// When a control of a place was touched: what the page read, and how many questions had been answered
    /// with yes by then. The same control may be another one where the page reads otherwise (another file,
    /// another number), or once something was done.
    using Touches = std::set<std::pair<std::size_t, unsigned>>;
    static constexpr std::ptrdiff_t most_times = 3;  ///< where the page reads the same
    static constexpr std::size_t most_touches_each = 12;
    static constexpr unsigned most_wandered = 200;

    static std::string key_of(const Json& control) {
        return control.value("name", "") + "\n" + control.value("label", "");
    }
    static std::size_t texts_of(const Json& page) {
        return std::hash<std::string>{}(page.at("texts").dump());
    }

    /// What ways lead from and to: a place with the controls that it has now. Another folder is another one.
    static std::string node_of(const Json& page) {
        std::string out = place_of(page);
        for (const Json& control : page.at("controls")) {
            if (control.value("enabled", true)) out += "\n" + key_of(control);
        }
        return out;
    }

    bool worth_touching(const std::string& place, const std::string& key, std::size_t texts) {
        const Touches& done = touched_[place][key];
        const auto same =
            std::count_if(done.begin(), done.end(), [texts](const auto& one) { return one.first == texts; });
        return done.size() < most_touches_each && same < most_times && !done.contains({texts, confirmed_});
    }

    /// The control to touch: one that was not, those that lead away last; else one on the way to some.
    std::optional<Json> choose(const Json& page) {
        const std::string place = place_of(page);
        std::vector<Json> untouched;
        std::vector<Json> enabled;
        for (const Json& control : page.at("controls")) {
            const std::string name = control.value("name", "");
            if (!control.value("enabled", true)) {
                if (dead_.insert(place + "/" + name).second) outcomes_.push_back({place, name, place, {}});
                continue;
            }
            enabled.push_back(control);
            if (worth_touching(place, key_of(control), texts_of(page))) untouched.push_back(control);
        }
        const std::string node = node_of(page);
        open_[node] = untouched.size();
        for (const bool leaving : {false, true}) {
            for (const Json& control : untouched) {
                const std::string name = control.value("name", "");
                if ((name == "Back" || name == "OK" || name == "Yes") == leaving) return control;
            }
        }
        const auto way = way_on(node, enabled);
        return way ? way : wander(place, enabled);
    }

    /// No way is known, but not all has been seen: the control that was touched least here, which may make
    /// another page of this one, say by leaving a folder.
    std::optional<Json> wander(const std::string& place, const std::vector<Json>& enabled) {
        if (wandered_ == most_wandered || enabled.empty() || complete()) {
            return std::nullopt;
        }
        ++wandered_;
        auto& used = used_[place];
        return *std::min_element(enabled.begin(), enabled.end(), [&](const Json& a, const Json& b) {
            return used[key_of(a)] < used[key_of(b)];
        });
    }

    /// The least used control that once led to a place from which there is still something to do.
    std::optional<Json> way_on(const std::string& node, const std::vector<Json>& enabled) {
        std::map<std::string, const Json*> first;  // of each node: the control here that begins the way there
        std::vector<std::string> queue;
        for (const Json& control : enabled) {
            const auto way = ways_[node].find(key_of(control));
            if (way != ways_[node].end() && way->second != node &&
                first.emplace(way->second, &control).second) {
                queue.push_back(way->second);
            }
        }
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::string here = queue[i];
            if (open_[here] > 0) return *first[here];
            for (const auto& [key, to] : ways_[here]) {
                if (to != node && first.emplace(to, first[here]).second) queue.push_back(to);
            }
        }
        return std::nullopt;
    }

    void touch(const Json& page, const Json& control) {
        const std::string from = place_of(page);
        const std::string name = control.value("name", "");
        ++used_[from][key_of(control)];
        const std::pair state{texts_of(page), confirmed_};
        Outcome outcome{from, name, {}, screen_.touch(name)};
        const Json after = screen_.page();
        outcome.to = place_of(after);
        if (page.at("box").is_object() && page.at("box").at("buttons").size() == 2 &&
            (name == "OK" || name == "Yes")) {
            ++confirmed_;
            let_it_work();
        }
        note(after);
        const std::string here = node_of(page);
        const std::string settled = node_of(settle());
        if (touched_[from][key_of(control)].insert(state).second) {
            open_[here] -= open_[here] > 0 ? 1U : 0U;
            const bool known = std::any_of(outcomes_.begin(), outcomes_.end(), [&](const Outcome& one) {
                return one.from == from && one.control == name && one.to == outcome.to;
            });
            if (!known) outcomes_.push_back(outcome);
        }
        if (settled != here) {
            ways_[here][key_of(control)] = settled;
            open_.emplace(settled, 1);  // until it has been looked at
        } else {
            ways_[here].erase(key_of(control));
        }
    }

    /// What was confirmed may take its time, homing for instance: until the page reads otherwise than when it
    /// has begun.
    void let_it_work() {
        screen_.pass(wait_step);
        const Json begun = screen_.page();
        for (int i = 0; i < work_waits && screen_.page() == begun; ++i) {
            screen_.pass(wait_step);
        }
    }
    /// Nothing is left to touch: what comes by itself comes now.
    void linger() {
        for (int i = 0; i < last_waits; ++i) {
            screen_.pass(wait_step);
            note(screen_.page());
        }
    }

    ControlScreen& screen_;
    std::shared_ptr<const screen::ScreenProfile> profile_;
    std::set<std::string> led_to_;  ///< pages to which some control leads
    std::set<std::string> dead_;    ///< controls that were seen dead
    unsigned confirmed_ = 0;
    std::set<std::string> seen_;
    std::map<std::string, std::map<std::string, Touches>> touched_;
    std::map<std::string, std::map<std::string, std::string>> ways_;
    std::map<std::string, std::map<std::string, unsigned>> used_;  ///< how often, by place and control
    unsigned wandered_ = 0;
    std::map<std::string, std::size_t> open_;  ///< controls not touched yet, by node
    std::vector<Outcome> outcomes_;
};

}  // namespace

ExitCode tour_own(const ScreenOptions& options) {
    ControlScreen screen(options.control);
    OwnTour tour(screen);
    tour.run();
    const auto results = tour.results();
    print(options.json ? screen::tour_json(tour.name(), results) : screen::tour_table(results));
    if (!options.junit.empty()) {
        std::ofstream out(options.junit, std::ios::binary);
        out << screen::tour_junit(tour.name(), results);
        out.flush();
        if (!out) {
            return complain("screen", ExitCode::bad_input, options.junit + " cannot be written");
        }
    }
    return tour.complete() ? ExitCode::ok : ExitCode::failed;
}

}  // namespace fauxboard::tools
