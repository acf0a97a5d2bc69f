#include "emulator/touch/touch_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emulator/behaviour/nearest.h"
#include "emulator/touch/machine_link.h"

namespace fauxboard::touch {

using behaviour::ActionContext;
using screen::Effect;
using screen::Effects;
using screen::PageFace;
using screen::Scope;
using screen::Target;

namespace {

/// Pages that open pages while they open, and so on.
constexpr int most_openings = 8;
constexpr SimTime longest_touch = std::chrono::hours(1);

/// The nearest of so many pixels, whatever the number is.
int pixel(double where, int of) {
    return where > 0 ? static_cast<int>(std::lround(std::min(where, of - 1.0))) : 0;
}

}  // namespace

TouchScreen::TouchScreen(std::shared_ptr<const screen::ScreenProfile> profile)
    : profile_(std::move(profile)), values_(profile_->values.power_on()), finger_(profile_->display->finger) {
    layers_.page = before_ = profile_->main_page;
}

// Time
// -----------------------------------------------------------------------------------------------

void TouchScreen::power_on(SimTime now, ActionContext& context) {
    values_ = profile_->values.power_on();
    layers_ = {};
    layers_.page = before_ = profile_->main_page;
    swallowed_ = finger_.contact(now).has_value();
    entry_ = {};
    finger_.power_on(now);
    touched_ = idle_not_before_ = now;
    on_ = true;
    if (const auto contact = finger_.contact(now)) {
        keep_place(*contact);
    }
    refresh(context.machine);
    run(display().power_on, {}, context);
}

void TouchScreen::on_event(SimTime now, machine::EventId event, ActionContext& context) {
    const auto effects = display().events.find(event);
    if (!on_ || effects == display().events.end()) {
        return;
    }
    refresh(context.machine);
    static_cast<void>(now);
    run(effects->second, {}, context);
}

SimTime TouchScreen::idle_due(const machine::Machine& machine) const {
    if (!on_ || layers_.cover || display().idle.empty()) {
        return machine::never;
    }
    for (const std::size_t id : display().idle_values) {
        read_machine(profile_->values.at(id), machine, values_[id]);
    }
    const double ms = display().idle_ms.evaluate({values_, 0, {}, 0});
    return ms > 0 && ms < 1e12
               ? std::max(touched_ + SimTime{static_cast<SimTime::rep>(ms * 1000)}, idle_not_before_)
               : machine::never;
}

SimTime TouchScreen::next_due(const machine::Machine& machine) const {
    return on_ ? std::min(finger_.next_due(), idle_due(machine)) : machine::never;
}

void TouchScreen::advance(SimTime now, ActionContext& context) {
    while (finger_.next_due() <= now) {
        switch (finger_.advance(now)) {
            case Finger::Felt::press:
                touched_ = now;
                press(context);
                break;
            case Finger::Felt::held:
                hold(now, context);
                break;
            case Finger::Felt::release:
                release(context);
                break;
            case Finger::Felt::nothing:
                break;
        }
    }
    if (idle_due(context.machine) <= now) {
        fall_idle(now, context);
    }
}

void TouchScreen::fall_idle(SimTime now, ActionContext& context) {
    touched_ = now;
    refresh(context.machine);
    run(display().idle, {}, context);
}

// Fingers
// -----------------------------------------------------------------------------------------------

TouchScreen::Touched TouchScreen::touch(SimTime now, int x, int y, SimTime how_long) {
    if (x < 0 || y < 0 || x >= display().width || y >= display().height) {
        return {fmt::format("{}, {} is not on the screen, which has {} x {} pixels.", x, y, display().width,
                            display().height),
                now};
    }
    if (how_long <= SimTime{0} || how_long > longest_touch) {
        return {"A touch lasts from a moment to an hour.", now};
    }
    const auto done = finger_.touch(now, x, y, how_long);
    return done ? Touched{{}, *done} : Touched{"Too many touches wait for this one.", now};
}

TouchScreen::Touched TouchScreen::touch(SimTime now, const machine::Machine& machine, std::string_view name,
                                        SimTime how_long) {
    const screen::Scene here = scene(machine);
    const screen::SceneControl* control = here.find(name);
    if (control == nullptr) {
        std::vector<std::string_view> names;
        for (const screen::SceneControl& one : here.controls) {
            names.push_back(one.name);
        }
        const std::string_view near = behaviour::nearest(name, names);
        return {fmt::format("There is no control \"{}\" on {}{}; it has {}.", name.substr(0, 60),
                            here.box ? "the box \"" + here.box->caption + "\"" : "the page " + here.page,
                            near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near),
                            !names.empty()  ? fmt::format("{}", fmt::join(names, ", "))
                            : layers_.cover ? "none: a touch anywhere lifts it"
                                            : "none"),
                now};
    }
    int x = control->at.x + control->at.width / 2;
    int y = control->at.y + control->at.height / 2;
    if (here.rotated) {
        x = here.width - 1 - x;
        y = here.height - 1 - y;
    }
    return touch(now, x, y, how_long);
}

void TouchScreen::keep_place(const Contact& contact) {
    if (display().touch_x) values_[*display().touch_x].number = contact.x;
    if (display().touch_y) values_[*display().touch_y].number = contact.y;
}

std::pair<int, int> TouchScreen::felt(const screen::Scene& here) const {
    int x = finger_.felt().x;
    int y = finger_.felt().y;
    if (!display().felt.empty()) {
        const Scope scope{values_, 0, {}, 0};
        x = pixel(display().felt[0].evaluate(scope), here.width);
        y = pixel(display().felt[1].evaluate(scope), here.height);
    }
    return here.rotated ? std::pair{here.width - 1 - x, here.height - 1 - y} : std::pair{x, y};
}

void TouchScreen::press(ActionContext& context) {
    layers_.pressed.reset();
    swallowed_ = layers_.cover.has_value();
    if (swallowed_) {
        uncover(context);
        return;
    }
    keep_place(finger_.felt());
    const screen::Scene here = scene(context.machine);
    const auto [x, y] = felt(here);
    const screen::SceneControl* hit = here.hit(x, y);
    if (hit == nullptr || !hit->enabled) {
        return;
    }
    layers_.pressed = hit->button;
    layers_.pressed_row = hit->row;
    run(display().press, {}, context);
}

void TouchScreen::hold(SimTime now, ActionContext& context) {
    if (swallowed_ || !layers_.pressed) {
        return;
    }
    const screen::Control& control = *profile_->buttons[*layers_.pressed].control;
    if (!control.hold.empty() && finger_.lasted(now) >= control.hold_after) {
        swallowed_ = true;
        refresh(context.machine);
        run(display().press, {}, context);
        run(control.hold, {}, context);
    }
}

void TouchScreen::release(ActionContext& context) {
    const auto pressed = layers_.pressed;
    layers_.pressed.reset();
    if (swallowed_ || !pressed || finger_.long_press()) {
        swallowed_ = false;
        return;
    }
    refresh(context.machine);
    const screen::Button& button = profile_->buttons[*pressed];
    if (button.control->key) {
        type(*button.control);
        return;
    }
    const Scope scope = standpoint(context.machine).scope(button, layers_.pressed_row);
    const Row row{scope.row, std::string(scope.row_text), {scope.row_cells.begin(), scope.row_cells.end()}};
    if (layers_.box && button.page == *layers_.box) {
        go({{}, Target::Where::close, screen::no_page}, context);
    }
    run(button.control->touch, row, context);
}

void TouchScreen::type(const screen::Control& control) {
    const auto& entry = profile_->pages[layers_.page].face.entry;
    if (entry) {
        entry_.press(*control.key, control.digit);
        show_entry(*entry);
    }
}

void TouchScreen::start_entry(const screen::Entry& entry) {
    const Scope scope{values_, 0, {}, 0};
    const double decimals = std::clamp(entry.decimals.evaluate(scope), 0.0, 6.0);
    entry_.start(entry.start.evaluate(scope), static_cast<int>(decimals), entry.most);
    show_entry(entry);
}

void TouchScreen::show_entry(const screen::Entry& entry) {
    values_[entry.text].text = entry_.text;
    values_[entry.number].number = entry_.number();
}

// Effects
// -----------------------------------------------------------------------------------------------

bool TouchScreen::run(const Effects& effects, const Row& row, ActionContext& context) {
    const Scope scope{values_, row.number, row.text, 0, row.cells};
    const auto hit = std::find_if(effects.begin(), effects.end(),
                                  [&](const Effect& one) { return all_hold(one.when, scope); });
    if (hit == effects.end()) {
        return false;
    }
    run(*hit, row, context);
    return true;
}

void TouchScreen::run(const Effect& effect, const Row& row, ActionContext& context) {
    const Scope scope{values_, row.number, row.text, 0, row.cells};
    const auto target = std::find_if(effect.leads_to.begin(), effect.leads_to.end(),
                                     [&](const Target& one) { return all_hold(one.when, scope); });
    assume(effect.assume, scope);
    for (const screen::Deed& deed : effect.deeds) {
        carry_out(deed, scope, context);
        refresh(context.machine);
    }
    if (effect.uncovers && layers_.cover) {
        uncover(context);
    }
    if (effect.idle_at_least > SimTime{0}) {
        touched_ = context.machine.now();
        idle_not_before_ = std::max(idle_not_before_, touched_ + effect.idle_at_least);
    }
    if (target != effect.leads_to.end()) {
        go(*target, context);
    }
}

void TouchScreen::assume(const std::vector<screen::Assign>& assigns, const Scope& scope) {
    // All from the values as they were, so that the order does not matter.
    std::vector<screen::Shown> fresh(assigns.size());
    for (std::size_t i = 0; i < assigns.size(); ++i) {
        const bool text = profile_->values.at(assigns[i].value).kind == screen::ValueKind::text;
        fresh[i].number = text ? 0 : assigns[i].expression.evaluate(scope);
        fresh[i].text = text ? assigns[i].text.render(scope) : std::string{};
    }
    for (std::size_t i = 0; i < assigns.size(); ++i) {
        values_[assigns[i].value] = std::move(fresh[i]);
    }
}

void TouchScreen::go(const Target& target, ActionContext& context) {
    switch (target.where) {
        case Target::Where::close:
            if (layers_.box) {
                const std::size_t box = *layers_.box;
                layers_.box.reset();
                run(profile_->pages[box].face.on_close, {}, context);
            }
            break;
        case Target::Where::back:
            open_page(profile_->pages[layers_.page].parent, context);
            break;
        case Target::Where::before:
            open_page(before_, context);
            break;
        case Target::Where::page:
            open_page(target.page, context);
            break;
    }
}

void TouchScreen::open_page(std::size_t page, ActionContext& context) {
    if (depth_ >= most_openings) {
        return;
    }
    ++depth_;
    const PageFace& face = profile_->pages[page].face;
    layers_.pressed.reset();
    if (face.kind == PageFace::Kind::cover) {
        layers_.cover = page;
    } else {
        go({{}, Target::Where::close, screen::no_page}, context);
        if (face.kind == PageFace::Kind::box) {
            layers_.box = page;
        } else {
            const std::size_t left = layers_.page;
            layers_.page = page;
            before_ = left == page ? before_ : left;
            run(profile_->pages[left].face.on_close, {}, context);
        }
    }
    run(face.on_open, {}, context);
    if (face.entry) {
        start_entry(*face.entry);
    }
    --depth_;
}

void TouchScreen::uncover(ActionContext& context) {
    const std::size_t cover = *layers_.cover;
    layers_.cover.reset();
    refresh(context.machine);
    run(profile_->pages[cover].face.on_close, {}, context);
}

// Looking
// -----------------------------------------------------------------------------------------------

void TouchScreen::refresh(const machine::Machine& machine) const {
    read_machine(profile_->values, machine, values_);
}

screen::Scene TouchScreen::scene(const machine::Machine& machine) const {
    refresh(machine);
    return screen::scene_of(*profile_, values_, layers_);
}

screen::Standpoint TouchScreen::standpoint(const machine::Machine& machine) const {
    refresh(machine);
    return {*profile_, values_, on_top(), layers_.box || layers_.cover ? layers_.page : before_};
}

}  // namespace fauxboard::touch
