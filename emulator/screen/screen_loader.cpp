#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/wire_text.h"
#include "emulator/screen/navigation.h"
#include "emulator/screen/screen_compiler.h"

namespace fauxboard::screen {

using behaviour::Document;
using behaviour::Findings;
using behaviour::Json;
using behaviour::ObjectReader;

namespace {

constexpr std::size_t max_pages = 256;
constexpr std::size_t max_buttons = 2048;
constexpr double bits_per_byte = 10;  // 8N1

void read_line_rules(Compiler& compiler, const Json& node, LineRules& out) {
    ObjectReader reader(node, "/line", compiler.findings);
    reader.boolean("framed_in", out.framed_in);
    reader.boolean("framed_out", out.framed_out);
    unsigned number = static_cast<unsigned>(out.buffer_bytes);
    reader.unsigned_integer("buffer_bytes", number, 16, 65536);
    out.buffer_bytes = number;
    number = static_cast<unsigned>(out.code_within);
    reader.unsigned_integer("code_within", number, 1, 256);
    out.code_within = number;
    number = 0;
    reader.unsigned_integer("baud", number, 300, 4'000'000);
    if (number != 0) {
        out.byte_time = machine::from_seconds(bits_per_byte / number);
    }
    compiler.time(reader, "tick_ms", out.tick, 1, 1000);
    compiler.time(reader, "answer_after_ms", out.answer_after, 0, 1000);
    compiler.time(reader, "deaf_ms", out.deaf, 0, 60'000);
    reader.wire_text("hello", out.hello, 256);
    reader.boolean("lf_only", out.lf_only);
    reader.boolean("skips_blanks", out.skips_blanks);
    number = 0;
    reader.unsigned_integer("jams_at", number, 16, 65536);
    out.jams_at = number;
    reader.finish();
}

/// The pages' paths, and for each the nearest page above it.
void read_page_paths(Compiler& compiler, const Json& node, const Json& boxes) {
    ScreenProfile& profile = compiler.profile;
    const ObjectReader pages(node, "/pages", compiler.findings);
    if (!node.is_object()) {
        return;
    }
    const auto add = [&](const Json& all, PageFace::Kind kind) {
        for (const auto& [path, page] : all.items()) {
            if (profile.pages.size() == max_pages) {
                compiler.findings.add("/pages", "more than 256 pages");
                break;
            }
            Page one;
            one.path = path;
            one.title = path;
            one.face.kind = kind;
            profile.pages.push_back(std::move(one));
        }
    };
    add(node, PageFace::Kind::page);
    if (boxes.is_object()) {
        add(boxes, PageFace::Kind::box);
    }
    for (const Page& page : profile.pages) {
        compiler.page_paths.emplace_back(page.path);
    }
    const auto main = profile.find_page("Main");
    if (!main) {
        compiler.findings.add("/pages", "there is no page \"Main\"");
        return;
    }
    profile.main_page = *main;
    for (Page& page : profile.pages) {
        page.parent = *main;
        std::size_t longest = 0;
        for (std::size_t other = 0; other < profile.pages.size(); ++other) {
            const std::string& above = profile.pages[other].path;
            if (page.path.starts_with(above + "/") && above.size() > longest) {
                longest = above.size();
                page.parent = other;
            }
        }
    }
}

/// Puts the buttons that stand everywhere on each page that does not leave them out.
void spread_buttons(Compiler& compiler, const Json& pages) {
    ScreenProfile& profile = compiler.profile;
    std::vector<std::string_view> names;
    for (const Button& button : profile.buttons) {
        if (button.page == no_page) names.emplace_back(button.name);
    }
    for (Page& page : profile.pages) {
        if (page.face.kind != PageFace::Kind::page) continue;
        std::vector<std::string> without;
        if (const auto list = pages[page.path].find("without"); list != pages[page.path].end()) {
            for_each_item(
                *list, "/pages/" + page.path + "/without", [&](const Json& item, const std::string& where) {
                    without.push_back(item.get<std::string>());
                    if (std::find(names.begin(), names.end(), without.back()) == names.end()) {
                        compiler.findings.add(
                            where, fmt::format("no button \"{}\" stands everywhere", without.back()),
                            std::string(behaviour::nearest(without.back(), names)));
                    }
                });
        }
        for (std::size_t id = 0; id < profile.buttons.size(); ++id) {
            const Button& button = profile.buttons[id];
            if (button.page == no_page &&
                std::find(without.begin(), without.end(), button.name) == without.end()) {
                page.buttons.push_back(id);
            }
        }
    }
}

std::string pointer_to(const Page& page) {
    std::string out = "/pages/";
    for (const char c : page.path) {
        out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return out;
}

/// Those of a board's own screen that no button has.
template <class Take>
void for_each_effect(const ScreenProfile& profile, Take&& take) {
    if (!profile.display) {
        return;
    }
    const Display& display = *profile.display;
    for (const Effects* effects : {&display.power_on, &display.press, &display.idle}) {
        std::for_each(effects->begin(), effects->end(), take);
    }
    for (const auto& [event, effects] : display.events) {
        std::for_each(effects.begin(), effects.end(), take);
    }
    for (const Page& page : profile.pages) {
        std::for_each(page.face.on_open.begin(), page.face.on_open.end(), take);
        std::for_each(page.face.on_close.begin(), page.face.on_close.end(), take);
    }
    for (const Button& button : profile.buttons) {
        if (button.control) std::for_each(button.control->hold.begin(), button.control->hold.end(), take);
    }
}

/// Every page is led to by something, every path a preparation presses exists.
void check_links(Compiler& compiler) {
    const ScreenProfile& profile = compiler.profile;
    std::vector<bool> reached(profile.pages.size(), false);
    const auto mark = [&](const std::vector<Target>& targets) {
        for (const Target& target : targets) {
            if (target.page != no_page) reached[target.page] = true;
        }
    };
    reached[profile.main_page] = true;
    mark(profile.idle_target);
    for_each_effect(profile, [&](const Effect& effect) { mark(effect.leads_to); });
    const auto mark_rule = [&](const FrameRule& rule) {
        for (const FrameCase& one : rule.cases) {
            mark(one.opens);
        }
    };
    for (const auto& [code, rule] : profile.codes) {
        mark_rule(rule);
    }
    std::for_each(profile.words.begin(), profile.words.end(), mark_rule);
    for (const Button& button : profile.buttons) {
        mark(button.leads_to);
    }
    for (std::size_t id = 0; id < reached.size(); ++id) {
        if (!reached[id]) {
            compiler.findings.add(pointer_to(profile.pages[id]),
                                  "no button leads to this page, and no frame opens it");
        }
    }
    for (const Button& button : profile.buttons) {
        for (const Prepare& step : button.prepare) {
            if (step.kind != Prepare::Kind::press) continue;
            const Resolved found = resolve(profile, {}, no_page, step.text);
            if (!found.button) {
                compiler.findings.add(
                    button.page == no_page ? "/everywhere" : pointer_to(profile.pages[button.page]),
                    fmt::format("\"{}\" is prepared by pressing \"{}\": {}", button.path, step.text,
                                found.sentence));
            }
        }
    }
}

void read_tour(Compiler& compiler, const Json& node) {
    ObjectReader reader(node, "/tour", compiler.findings);
    compiler.time(reader, "silence_ms", compiler.profile.silence, 10, 60'000);
    compiler.profile.unasked = compiler.texts(reader, "unasked");
    compiler.profile.tour_first = compiler.preparations(reader, "first", {});
    reader.finish();
}

void read_idle(Compiler& compiler, const Json& node) {
    ObjectReader reader(node, "/idle", compiler.findings);
    compiler.time(reader, "after_ms", compiler.profile.idle, 100, 3'600'000);
    compiler.profile.idle_target = compiler.targets(reader, "leads_to", {});
    reader.finish();
}

void read_assumed(Compiler& compiler, const Json& node) {
    ObjectReader reader(node, "/assumed", compiler.findings);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [key, sentence] : node.items()) {
        std::string text;
        reader.text(key, text);
        compiler.profile.assumed.push_back(std::move(text));
    }
}

/// A board's own screen: instead of a line and its frames it has a display.
template <class Part>
void read_own(Compiler& compiler, Part&& part) {
    compiler.display_start(part("display"));
    compiler.translations(part("translations"));
    compiler.looks_and_icons(part("looks"), part("icons"));
    compiler.values(part("values"));
    read_page_paths(compiler, part("pages"), part("boxes"));
    compiler.display_rest(part("display"));
    compiler.machine_events(part("events"));
    compiler.display_idle(part("idle"));
}

void read_all(Compiler& compiler, const Json& root) {
    static const Json empty = Json::object();
    ObjectReader reader(root, "", compiler.findings);
    ScreenProfile& profile = compiler.profile;
    const bool own = reader.has("display");
    for (const char* key : {"name", "values", "pages"}) {
        reader.required(key);
    }
    if (!own) {
        reader.required("frames");
    }
    reader.text("name", profile.name, 100);
    reader.text("title", profile.title, 200);
    reader.has("extends");
    const auto part = [&](const char* key) -> const Json& {
        const Json* node = reader.get(key);
        return node == nullptr ? empty : *node;
    };
    read_assumed(compiler, part("assumed"));
    if (own) {
        read_own(compiler, part);
    } else {
        read_line_rules(compiler, part("line"), profile.line);
        compiler.values(part("values"));
        read_page_paths(compiler, part("pages"), empty);
        compiler.frames(part("frames"));
        compiler.talk(part("talk"));
        read_idle(compiler, part("idle"));
    }
    read_tour(compiler, part("tour"));
    if (!profile.pages.empty()) {
        compiler.pages(part("pages"));
        compiler.everywhere(part("everywhere"));
        if (own) {
            compiler.boxes(part("boxes"));
            compiler.check_translations();
        }
        if (profile.buttons.size() > max_buttons) {
            compiler.findings.add("/pages", "more than 2048 buttons");
        }
    } else {
        reader.has("everywhere");
    }
    reader.finish();
}

}  // namespace

std::optional<std::size_t> ScreenProfile::find_page(std::string_view path) const {
    const auto hit =
        std::find_if(pages.begin(), pages.end(), [&](const Page& page) { return page.path == path; });
    return hit == pages.end() ? std::nullopt : std::optional(static_cast<std::size_t>(hit - pages.begin()));
}

namespace {
bool sets(const std::vector<Read>& reads, std::size_t value) {
    return std::any_of(reads.begin(), reads.end(),
                       [&](const Read& read) { return read.into == value || sets(read.then, value); });
}
}  // namespace

std::string ScreenProfile::sources(std::size_t value) const {
    std::string out;
    for (const auto& [code, rule] : codes) {
        if (std::any_of(rule.cases.begin(), rule.cases.end(),
                        [&](const FrameCase& one) { return sets(one.read, value); })) {
            out += (out.empty() ? "" : ", ") + rule.name;
        }
    }
    return out;
}

std::shared_ptr<const ScreenProfile> load_screen(const behaviour::SourceText& source,
                                                 const behaviour::SourceFinder& find) {
    const Document document = behaviour::load_document(source, find);
    Findings findings{document, {}};
    auto profile = std::make_shared<ScreenProfile>();
    profile->files = document.files;
    Compiler compiler{findings, *profile, {}};
    read_all(compiler, document.root);
    if (findings.problems.empty()) {
        spread_buttons(compiler, document.root["pages"]);
        check_links(compiler);
    }
    if (!findings.problems.empty()) {
        throw behaviour::ProfileError(std::move(findings.problems));
    }
    return profile;
}

}  // namespace fauxboard::screen
