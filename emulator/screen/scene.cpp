// The scene of a board's own screen, from its profile and its values.

#include "emulator/screen/scene.h"

#include <algorithm>
#include <cmath>

namespace fauxboard::screen {
namespace {

// Message boxes, as the firmware makes them.
constexpr int box_least_width = 260;
constexpr int box_least_height = 130;
constexpr int box_most_height = 300;
constexpr int box_caption_height = 26;
constexpr int box_margin = 20;
constexpr int box_buttons_height = 46;
constexpr int box_button_bottom = 10;
constexpr int most_coordinate = 10'000;

int pixel(double value) {
    return std::isfinite(value)
               ? static_cast<int>(std::clamp<double>(value, -most_coordinate, most_coordinate))
               : 0;
}

Color paint(const Paints& paints, const Scope& scope, Color otherwise) {
    for (const Paint& one : paints) {
        if (all_hold(one.when, scope)) return one.color;
    }
    return otherwise;
}

std::vector<std::string> split_lines(std::string_view text) {
    std::vector<std::string> out;
    for (;;) {
        const std::size_t end = text.find('\n');
        out.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) return out;
        text.remove_prefix(end + 1);
    }
}

class SceneMaker {
  public:
    SceneMaker(const ScreenProfile& profile, std::span<const Shown> values, const Layers& layers)
        : profile_(profile), display_(*profile.display), values_(values), layers_(layers) {
        const double language = display_.language.evaluate(plain());
        language_ = language >= 0 && language < 64 ? static_cast<std::size_t>(language) : 0;
    }

    Scene make() {
        const std::size_t bottom = layers_.cover.value_or(layers_.page);
        const Page& page = profile_.pages[bottom];
        scene_.page = page.path;
        scene_.width = display_.width;
        scene_.height = display_.height;
        scene_.rotated = display_.rotated.evaluate(plain()) != 0;
        scene_.background = page.face.background.value_or(display_.background);
        scene_.title = text(page.face.title, plain());
        if (!page.face.bare) {
            draw(display_.draw, plain(), {}, 0);
            Figure title = display_.title;
            item(title, plain(), {}, 0, scene_.title);
        }
        draw(page.face.draw, plain(), {}, 0);
        const bool dead = layers_.box && !layers_.cover;
        controls(bottom, dead);
        if (dead) {
            scene_.controls.clear();
            box(*layers_.box);
        }
        return std::move(scene_);
    }

  private:
    Scope plain() const { return {values_, 0, {}, 0}; }
    std::string text(const Words& words, const Scope& scope) const {
        return words.empty() ? std::string{} : words.in(language_).render(scope);
    }
    Standpoint standpoint(std::size_t page) const { return {profile_, values_, page, layers_.page}; }

    /// Where it goes: beneath the box or above it.
    std::vector<SceneItem>& items() { return scene_.box ? scene_.above : scene_.items; }

    void item(const Figure& figure, const Scope& scope, Rect corner, Color otherwise,
              const std::string& words) {
        SceneItem out;
        out.kind = figure.kind;
        out.at = figure.at.evaluate(scope);
        out.at.x += corner.x;
        out.at.y += corner.y;
        out.color = paint(figure.paints, scope, otherwise);
        out.text = words;
        out.size = figure.size;
        out.align = figure.align;
        out.lines = figure.lines;
        out.cut = figure.cut;
        out.icon = figure.kind == Figure::Kind::icon ? &display_.icons[figure.icon] : nullptr;
        out.picture = figure.picture;
        if (figure.kind == Figure::Kind::picture) {
            out.index = static_cast<std::size_t>(std::max(0, pixel(figure.index.evaluate(scope))));
        }
        out.whole = figure.whole;
        out.step = figure.step;
        out.turned = figure.turned;
        out.painted = figure.kind == Figure::Kind::picture && !figure.paints.empty();
        items().push_back(std::move(out));
    }

    void draw(const std::vector<Figure>& figures, const Scope& scope, Rect corner, Color otherwise) {
        for (const Figure& figure : figures) {
            if (!all_hold(figure.when, scope)) continue;
            const std::string words = text(figure.text, scope);
            item(figure, scope, corner, otherwise, words);
            if (!words.empty()) scene_.texts.push_back(words);
        }
    }

    void controls(std::size_t page, bool dead) {
        const Standpoint at = standpoint(page);
        for (const std::size_t id : profile_.pages[page].buttons) {
            const Button& button = profile_.buttons[id];
            const std::size_t first = button.rows ? at.first_row(button) : 1;
            const std::size_t places = button.rows ? std::max(1U, button.control->slots) : 1;
            for (std::size_t i = 0; i < places; ++i) {
                if (at.visible(button, first + i)) control(at, id, first + i, i, dead);
            }
        }
    }

    void control(const Standpoint& at, std::size_t id, std::size_t row, std::size_t slot, bool dead) {
        const Button& button = profile_.buttons[id];
        const Control& control = *button.control;
        const Scope scope = at.scope(button, row);
        SceneControl out;
        out.button = id;
        out.row = row;
        out.name = button.rows ? button.name + " " + std::to_string(slot + 1) : button.name;
        out.label = text(control.label, scope);
        out.at = control.at.evaluate(scope);
        out.enabled = all_hold(control.enabled, scope);
        out.input = button.input;
        const bool pressed = !dead && layers_.pressed == id && layers_.pressed_row == row;
        face(control, out, scope, pressed);
        if (!out.label.empty()) {
            scene_.texts.push_back(out.label);
        } else {
            out.label = scope.row_text;  // drawn by its figures, and what a person calls it
        }
        scene_.controls.push_back(std::move(out));
    }

    void face(const Control& control, const SceneControl& it, const Scope& scope, bool pressed) {
        const ControlStyle& look = display_.looks[control.look];
        if (!it.enabled && look.vanishes) {
            return;
        }
        const Color ink = !it.enabled ? look.disabled_text : pressed ? look.pressed_text : look.text;
        const auto fill = pressed && look.pressed_fill ? look.pressed_fill : look.fill;
        for (const auto& [kind, color] :
             {std::pair{Figure::Kind::fill, fill}, std::pair{Figure::Kind::frame, look.frame}}) {
            if (!color) continue;
            SceneItem out;
            out.kind = kind;
            out.at = it.at;
            out.color = *color;
            out.radius = look.radius;
            items().push_back(std::move(out));
        }
        draw(control.draw, scope, it.at, ink);
        int left = look.margin;
        if (control.icon) {
            left = icon(control, it, scope, ink);
        }
        if (!it.label.empty()) {
            SceneItem out;
            out.kind = Figure::Kind::text;
            out.at = {it.at.x + left, it.at.y, it.at.width - left - look.margin, it.at.height};
            out.color = ink;
            out.text = it.label;
            out.size = look.size;
            out.align = look.align;
            out.lines = look.lines;
            items().push_back(std::move(out));
        }
    }

    /// An icon stands in the middle of a control without a label, else at its left. Returns where the label
    /// begins.
    int icon(const Control& control, const SceneControl& it, const Scope& scope, Color ink) {
        const Icon& icon = display_.icons[*control.icon];
        SceneItem out;
        out.kind = Figure::Kind::icon;
        out.icon = &icon;
        out.color = paint(control.icon_paints, scope, ink);
        const int width = pixel(icon.width);
        const int height = pixel(icon.height);
        const int margin = display_.looks[control.look].margin;
        out.at = {it.label.empty() ? it.at.x + (it.at.width - width) / 2 : it.at.x + 2 * margin,
                  it.at.y + (it.at.height - height) / 2, width, height};
        items().push_back(std::move(out));
        return 2 * margin + width;
    }

    void box(std::size_t page) {
        const BoxFace& face = *profile_.pages[page].face.box;
        SceneBox out;
        out.caption = text(face.caption, plain());
        out.lines = split_lines(text(face.text, plain()));
        out.look = display_.box;
        out.caption_look = display_.caption;
        out.caption_height = box_caption_height;
        const bool buttons = !profile_.pages[page].buttons.empty();
        const int text_height = pixel(display_.box.size * static_cast<double>(out.lines.size()));
        const int height =
            std::clamp(text_height + box_caption_height + box_margin + (buttons ? box_buttons_height : 0),
                       box_least_height, box_most_height);
        out.at = {(display_.width - box_least_width) / 2, (display_.height - height) / 2, box_least_width,
                  height};
        scene_.box = std::move(out);
        for (const std::size_t id : profile_.pages[page].buttons) {
            const Button& button = profile_.buttons[id];
            const Control& control = *button.control;
            SceneControl it;
            it.button = id;
            it.name = button.name;
            it.label = text(control.label, plain());
            it.at = control.at.evaluate(plain());
            it.at.y = scene_.box->at.y + height - box_button_bottom - it.at.height;
            scene_.box->buttons.push_back(it.label);
            face_of_box_button(control, it);
            scene_.controls.push_back(std::move(it));
        }
    }

    void face_of_box_button(const Control& control, const SceneControl& it) {
        face(control, it, plain(), layers_.pressed == it.button);
    }

    const ScreenProfile& profile_;
    const Display& display_;
    std::span<const Shown> values_;
    const Layers& layers_;
    std::size_t language_ = 0;
    Scene scene_;
};

}  // namespace

Rect Place::evaluate(const Scope& scope) const {
    return {pixel(parts[0].evaluate(scope)), pixel(parts[1].evaluate(scope)), pixel(parts[2].evaluate(scope)),
            pixel(parts[3].evaluate(scope))};
}

const SceneControl* Scene::hit(int x, int y) const {
    const auto found = std::find_if(controls.rbegin(), controls.rend(),
                                    [&](const SceneControl& one) { return one.at.contains(x, y); });
    return found == controls.rend() ? nullptr : &*found;
}

const SceneControl* Scene::find(std::string_view name) const {
    if (name.empty()) {
        return nullptr;
    }
    for (const auto what : {&SceneControl::name, &SceneControl::label}) {
        const auto found = std::find_if(controls.begin(), controls.end(),
                                        [&](const SceneControl& one) { return one.*what == name; });
        if (found != controls.end()) return &*found;
    }
    return nullptr;
}

Scene scene_of(const ScreenProfile& profile, std::span<const Shown> values, const Layers& layers) {
    return SceneMaker(profile, values, layers).make();
}

behaviour::Json page_json(const Scene& scene) {
    using behaviour::Json;
    Json out;
    out["page"] = scene.page;
    out["title"] = scene.title;
    out["texts"] = scene.texts;
    out["box"] = nullptr;
    if (scene.box) {
        std::string text;
        for (const std::string& line : scene.box->lines) {
            text += (text.empty() ? "" : "\n") + line;
        }
        out["box"] = {{"caption", scene.box->caption}, {"text", text}, {"buttons", scene.box->buttons}};
    }
    out["controls"] = Json::array();
    for (const SceneControl& control : scene.controls) {
        Rect at = control.at;
        if (scene.rotated) {
            at.x = scene.width - at.x - at.width;
            at.y = scene.height - at.y - at.height;
        }
        Json one{{"name", control.name},
                 {"x", at.x},
                 {"y", at.y},
                 {"w", at.width},
                 {"h", at.height},
                 {"label", control.label},
                 {"enabled", control.enabled}};
        if (control.input) {
            one["input"] = Json{{"min", control.input->min}, {"max", control.input->max}};
        }
        out["controls"].push_back(std::move(one));
    }
    return out;
}

}  // namespace fauxboard::screen
