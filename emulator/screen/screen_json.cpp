#include "emulator/screen/screen_json.h"

#include <algorithm>
#include <cmath>

#include "emulator/behaviour/wire_text.h"

namespace fauxboard::screen {

using behaviour::Json;

namespace {

Json utf8(const std::vector<std::string>& lines) {
    Json out = Json::array();
    for (const std::string& line : lines) {
        out.push_back(behaviour::from_wire(line));
    }
    return out;
}

std::string dump(const Json& node, int indent) {
    return node.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json value_json(const ValueInfo& info, const Shown& value) {
    Json out;
    switch (info.kind) {
        case ValueKind::number:
            out["value"] = std::isfinite(value.number) ? Json(value.number) : Json(nullptr);
            if (std::abs(value.number) < 1e15) {  // and so no infinity, and a number at all
                const auto word = info.names.find(static_cast<std::int64_t>(value.number));
                if (word != info.names.end()) out["name"] = word->second;
            }
            break;
        case ValueKind::text:
            out["value"] = behaviour::from_wire(value.text);
            break;
        case ValueKind::list:
            out["value"] = utf8(value.list);
            break;
    }
    if (!info.unit.empty()) {
        out["unit"] = info.unit;
    }
    return out;
}

Json button_json(const ScreenProfile& profile, const ButtonView& view) {
    Json out;
    out["path"] = profile.buttons[view.button].path;
    out["label"] = view.label;
    if (profile.buttons[view.button].rows) {
        out["row"] = view.row;
    }
    if (!view.shut.empty()) {
        out["shut"] = view.shut;
    }
    if (view.input) {
        out["input"] = Json{{"min", view.input->min}, {"max", view.input->max}};
    }
    return out;
}

}  // namespace

Json to_json(const Judgement& judgement) {
    Json out;
    out["line"] = behaviour::from_wire(judgement.line);
    out["frame"] = behaviour::from_wire(judgement.frame);
    out["verdict"] = verdict_words(judgement.verdict);
    out["why"] = judgement.why;
    return out;
}

Json face_json(const Standpoint& at) {
    const PageView view = view_page(at);
    Json out{{"screen", at.profile.name},
             {"page", view.path},
             {"title", view.title},
             {"lines", view.lines},
             {"buttons", Json::array()}};
    for (const ButtonView& button : view.buttons) {
        Json one = button_json(at.profile, button);
        one["everywhere"] = button.everywhere;
        if (button.input) {
            one["input"]["normally"] = button.input->normally;
        }
        out["buttons"].push_back(std::move(one));
    }
    return out;
}

Json to_json(const TourResult& result) {
    Json one;
    one["button"] = result.button;
    one["verdict"] = tour_verdict_words(result.verdict);
    one["sent"] = utf8(result.sent);
    one["expected"] = result.expected;
    one["came"] = utf8(result.came);
    one["at_s"] = machine::to_seconds(result.at);
    one["took_s"] = machine::to_seconds(result.took);
    one["sentence"] = result.sentence;
    return one;
}

Json to_json(const Finding& finding) {
    Json out = to_json(finding.first);
    out["times"] = finding.times;
    return out;
}

std::string result_json(const TourResult& result) {
    return dump(to_json(result), -1);
}

std::string judgement_json(const Judgement& judgement, SimTime at) {
    Json out;
    out["t"] = machine::to_seconds(at);
    out["lint"] = to_json(judgement);
    return dump(out, -1);
}

std::string page_json(const Standpoint& at, const std::vector<std::size_t>& missing,
                      std::span<const Finding> findings) {
    const PageView view = view_page(at);
    Json root;
    root["screen"] = at.profile.name;
    root["page"] = view.path;
    root["title"] = view.title;
    root["lines"] = view.lines;
    root["values"] = Json::object();
    for (const std::size_t id : shown_values(at.profile, at.page)) {
        const ValueInfo& info = at.profile.values.at(id);
        Json value = value_json(info, at.values[id]);
        if (const std::string from = at.profile.sources(id); !from.empty()) {
            value["from"] = from;
            value["told"] = std::find(missing.begin(), missing.end(), id) == missing.end();
        }
        root["values"][info.name] = std::move(value);
    }
    root["buttons"] = Json::array();
    for (const ButtonView& button : view.buttons) {
        root["buttons"].push_back(button_json(at.profile, button));
    }
    root["findings"] = Json::array();
    for (const Finding& finding : findings) {
        root["findings"].push_back(to_json(finding));
    }
    return dump(root, 2);
}

}  // namespace fauxboard::screen
