#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "emulator/behaviour/nearest.h"
#include "emulator/screen/navigation.h"

namespace fauxboard::screen {
namespace {

constexpr std::size_t most_named = 8;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same(std::string_view a, std::string_view b, bool any_case) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) {
               return any_case ? lower(x) == lower(y) : x == y;
           });
}

/// `path` is `full`, or its end from behind a slash.
bool ends_so(std::string_view full, std::string_view path, bool any_case) {
    if (path.size() > full.size() || path.empty()) {
        return false;
    }
    const std::size_t from = full.size() - path.size();
    return (from == 0 || full[from - 1] == '/') && same(full.substr(from), path, any_case);
}

struct Candidate {
    std::size_t button;
    std::size_t row;
};

/// "File 2": the row behind the name of a button with rows.
std::optional<std::size_t> row_behind(const Button& button, std::string_view path, bool any_case) {
    const std::size_t blank = path.rfind(' ');
    if (blank == std::string_view::npos || !ends_so(button.path, path.substr(0, blank), any_case)) {
        return std::nullopt;
    }
    std::size_t row = 0;
    const char* end = path.data() + path.size();
    const auto read = std::from_chars(path.data() + blank + 1, end, row);
    return read.ec == std::errc{} && read.ptr == end && row != 0 ? std::optional(row) : std::nullopt;
}

/// The row whose entry is the last part of the path.
std::optional<std::size_t> row_named(const Standpoint& at, const Button& button, std::string_view path,
                                     bool any_case) {
    if (!button.rows || at.values.empty()) {
        return std::nullopt;
    }
    const auto& list = at.values[*button.rows].list;
    const std::string_view above =
        std::string_view(button.path).substr(0, button.path.size() - button.name.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (!list[i].empty() && ends_so(std::string(above) + list[i], path, any_case) &&
            at.visible(button, i + 1)) {
            return i + 1;
        }
    }
    return std::nullopt;
}

std::vector<Candidate> candidates(const Standpoint& at, std::string_view path, bool any_case) {
    std::vector<Candidate> out;
    for (std::size_t id = 0; id < at.profile.buttons.size(); ++id) {
        const Button& button = at.profile.buttons[id];
        if (same(button.path, path, any_case)) {
            return {{id, 0}};
        }
        if (ends_so(button.path, path, any_case)) {
            out.push_back({id, 0});
        } else if (button.rows) {
            if (const auto row = row_behind(button, path, any_case)) {
                out.push_back({id, *row});
            } else if (const auto named = row_named(at, button, path, any_case)) {
                out.push_back({id, *named});
            }
        }
    }
    return out;
}

std::string nearest_sentence(const ScreenProfile& profile, std::string_view path) {
    const bool whole = path.find('/') != std::string_view::npos;
    std::vector<const Button*> left;
    for (const Button& button : profile.buttons) {
        left.push_back(&button);
    }
    std::vector<std::string> near;
    while (near.size() < 3 && !path.empty()) {
        std::vector<std::string_view> names;
        for (const Button* button : left) {
            names.emplace_back(whole ? button->path : button->name);
        }
        const std::string_view hit = behaviour::nearest(path, names);
        if (hit.empty()) break;
        const auto index =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), hit) - names.begin());
        near.push_back('"' + left[index]->path + '"');
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(index));
    }
    std::string out = fmt::format("there is no button \"{}\"", printable(path.substr(0, 100)));
    return near.empty() ? out : out + fmt::format("; did you mean {}?", fmt::join(near, ", or "));
}

/// Leaves only the candidates on the page, if there are any.
void prefer_page(const Standpoint& at, std::vector<Candidate>& found) {
    if (at.page == no_page || found.size() < 2) {
        return;
    }
    const auto& here = at.profile.pages[at.page].buttons;
    std::vector<Candidate> on_page;
    std::copy_if(found.begin(), found.end(), std::back_inserter(on_page), [&](const Candidate& one) {
        return std::find(here.begin(), here.end(), one.button) != here.end() &&
               at.visible(at.profile.buttons[one.button], one.row);
    });
    if (!on_page.empty()) {
        found = std::move(on_page);
    }
}

/// Takes "=5" off the path of a button that a number is typed into.
std::optional<double> split_input(std::string_view& path) {
    const std::size_t sign = path.rfind('=');
    double number = 0;
    if (sign == std::string_view::npos) {
        return std::nullopt;
    }
    const char* end = path.data() + path.size();
    const auto read = std::from_chars(path.data() + sign + 1, end, number);
    if (read.ec != std::errc{} || read.ptr != end) {
        return std::nullopt;
    }
    path = path.substr(0, sign);
    return number;
}

/// "Password=abc": what is behind the sign of a button that takes a number is none.
std::optional<std::string> wrong_number(const Standpoint& at, std::string_view path) {
    const std::size_t sign = path.rfind('=');
    if (sign == std::string_view::npos) {
        return std::nullopt;
    }
    const auto found = candidates(at, path.substr(0, sign), true);
    const Button* button = found.size() == 1 ? &at.profile.buttons[found[0].button] : nullptr;
    if (button == nullptr || !button->input) {
        return std::nullopt;
    }
    return fmt::format("\"{}\" takes a number from {} to {}; found \"{}\"", button->path,
                       short_text(button->input->min), short_text(button->input->max),
                       printable(path.substr(sign + 1, 100)));
}

std::string check_input(const Button& button, std::optional<double> typed) {
    if (!typed) {
        return {};
    }
    if (!button.input) {
        return fmt::format("\"{}\" takes no number", button.path);
    }
    const bool fits = *typed >= button.input->min && *typed <= button.input->max;
    return fits ? std::string{}
                : fmt::format("\"{}\" takes a number from {} to {}; found {}", button.path,
                              short_text(button.input->min), short_text(button.input->max),
                              short_text(*typed));
}

/// By its whole path, or by the end of it when that is all that was given.
std::string nearest_page(const ScreenProfile& profile, std::string_view path) {
    const bool whole = path.find('/') != std::string_view::npos;
    std::vector<std::string_view> names;
    for (const Page& page : profile.pages) {
        const std::size_t slash = whole ? std::string::npos : page.path.rfind('/');
        names.push_back(std::string_view(page.path).substr(slash == std::string::npos ? 0 : slash + 1));
    }
    const auto hit = std::find(names.begin(), names.end(), behaviour::nearest(path, names));
    return hit == names.end() ? "" : profile.pages[static_cast<std::size_t>(hit - names.begin())].path;
}

}  // namespace

std::vector<std::string> also_ending(const ScreenProfile& profile, std::size_t button,
                                     std::string_view word) {
    std::vector<std::string> out;
    for (std::size_t id = 0; id < profile.buttons.size(); ++id) {
        const Button& other = profile.buttons[id];
        if (id != button && other.name.size() > word.size() && other.name.ends_with(word) &&
            other.name[other.name.size() - word.size() - 1] == ' ') {
            out.push_back('"' + other.path + '"');
        }
    }
    return out;
}

Resolved resolve(const ScreenProfile& profile, std::span<const Shown> values, std::size_t page,
                 std::string_view path) {
    Resolved out;
    const std::string_view given = path;
    const auto typed = split_input(path);
    const Standpoint at{profile, values, page, page};
    std::vector<Candidate> found = candidates(at, path, false);
    if (found.empty()) {
        found = candidates(at, path, true);
    }
    prefer_page(at, found);
    if (found.empty()) {
        out.sentence = wrong_number(at, path).value_or(nearest_sentence(profile, path));
        return out;
    }
    if (found.size() > 1) {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < std::min(found.size(), most_named); ++i) {
            names.push_back('"' + profile.buttons[found[i].button].path + '"');
        }
        out.sentence = fmt::format("\"{}\" may be {}{}; write more of its path", printable(given),
                                   fmt::join(names, ", "), found.size() > most_named ? ", ..." : "");
        return out;
    }
    out.sentence = check_input(profile.buttons[found[0].button], typed);
    if (out.sentence.empty()) {
        out.button = found[0].button;
        out.row = found[0].row;
        out.input = typed;
    }
    return out;
}

ResolvedPage resolve_page(const ScreenProfile& profile, std::string_view path) {
    ResolvedPage out;
    std::vector<std::string> found;
    for (std::size_t id = 0; id < profile.pages.size(); ++id) {
        const std::string& full = profile.pages[id].path;
        if (same(full, path, true)) {
            return {id, {}};
        }
        if (ends_so(full, path, true)) {
            out.page = id;
            found.push_back('"' + full + '"');
        }
    }
    if (found.size() > 1) {
        out.page.reset();
        out.sentence =
            fmt::format("\"{}\" may be {}; write more of its path", printable(path), fmt::join(found, ", "));
    } else if (found.empty()) {
        const std::string near = nearest_page(profile, path);
        out.sentence = fmt::format("there is no page \"{}\"{}", printable(path.substr(0, 100)),
                                   near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
    }
    return out;
}

}  // namespace fauxboard::screen
