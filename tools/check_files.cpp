#include "tools/check_files.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/parse_json.h"
#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/host/script_files.h"
#include "emulator/screen/screen_profile.h"
#include "tools/fleet_file.h"

namespace fauxboard::tools {
namespace {

namespace fs = std::filesystem;
using behaviour::Problem;
using behaviour::SourceText;

/// What a screen says first is a line of its own, or its first request is lost.
std::string hello_remark(const screen::ScreenProfile& screen) {
    const std::string& hello = screen.line.hello;
    const bool ends =
        hello.empty() ||
        hello.find('\n', hello.size() - std::min<std::size_t>(hello.size(), 2)) != std::string::npos;
    return ends ? "" : "line.hello has no line end: the first request would be glued to it, and lost";
}

/// A kind of file: what its "$schema" names, keys that no other kind has, and who knows its meaning.
struct Kind {
    std::string_view schema;
    std::array<std::string_view, 4> marks;
    std::string (*load)(const SourceText& source);  ///< gives a remark; throws behaviour::ProfileError
};
constexpr Kind kinds[] = {
    {"profile.schema.json",
     {"protocol", "machine", "requests", "boot"},
     [](const SourceText& source) {
         return overrun_remark(*behaviour::load_profile(source, host::profile_finder()));
     }},
    {"screen.schema.json",
     {"pages", "everywhere", "values", "tour"},
     [](const SourceText& source) {
         return hello_remark(*screen::load_screen(source, host::screen_finder()));
     }},
    {"scenario.schema.json",
     {"steps", "parameters", "limits", "screen"},
     [](const SourceText& source) {
         host::check_script(source);
         return std::string();
     }},
    {"fleet.schema.json",
     {"boards"},
     [](const SourceText& source) {
         std::set<std::string> profiles;
         for (const FleetBoard& board : read_fleet(source).boards) {
             if (profiles.insert(board.options.profile).second) {
                 host::load_profile_by_name(board.options.profile);
             }
         }
         return std::string();
     }},
};

/// The file itself; else a profile, a screen or a scenario of that name.
std::optional<SourceText> find(const std::string& file) {
    auto source = host::read_source(file);
    if (!source && file.find('/') == std::string::npos) {
        source = host::profile_finder()(file, {});
        for (const fs::path& folder : host::profile_folders()) {
            for (const char* kind : {"screens", "scenarios"}) {
                if (!source) source = host::read_source(folder / kind / (file + ".json"));
            }
        }
    }
    return source;
}

std::optional<nlohmann::json> load_schema(std::string_view schema_file) {
    for (const fs::path& folder : host::profile_folders()) {
        if (const auto source = host::read_source(folder / "schemas" / schema_file)) {
            nlohmann::json schema = behaviour::parse_json(source->text);
            if (schema.is_object()) {
                return schema;
            }
        }
    }
    return std::nullopt;
}

/// What kind of file it is: its "$schema" says so, else the first key that only one kind has; what has
/// neither is taken for a profile. Null: no known one.
const Kind* kind_of(const behaviour::Document& document) {
    const auto schema = document.root.find("$schema");
    if (schema == document.root.end()) {
        const auto* const hit = std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& kind) {
            return std::any_of(kind.marks.begin(), kind.marks.end(),
                               [&](std::string_view mark) { return document.root.contains(mark); });
        });
        return hit == std::end(kinds) ? &kinds[0] : hit;
    }
    const std::string name =
        schema->is_string() ? fs::path(schema->get_ref<const std::string&>()).filename().string() : "";
    const auto* const hit = std::find_if(std::begin(kinds), std::end(kinds),
                                         [&](const Kind& kind) { return kind.schema == name; });
    return hit == std::end(kinds) ? nullptr : hit;
}

std::string known_schemas() {
    std::string out;
    for (const Kind& kind : kinds) {
        out += (out.empty() ? "" : " or ") + std::string(kind.schema);
    }
    return out;
}

/// Whether the loader has something to say about this place, what is in it, or what it is in.
bool told(const std::vector<Problem>& problems, const std::string& file, const std::string& pointer) {
    const auto inside = [](const std::string& inner, const std::string& outer) {
        return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
    };
    return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
        return problem.file == file && (inside(problem.pointer, pointer) || inside(pointer, problem.pointer));
    });
}

void check_form(const behaviour::Document& document, const SourceText& source, const Kind& kind,
                CheckedFile& out) {
    const auto schema = load_schema(kind.schema);
    if (!schema) {
        out.remark = "not checked against the schema: there is no schemas/" + std::string(kind.schema) +
                     " in the profiles' folders";
        return;
    }
    const std::vector<Problem> by_loader = out.problems;
    for (const SchemaError& error : check_schema(*schema, document.root)) {
        if (!told(by_loader, source.name, error.pointer)) {
            out.problems.push_back(document.problem(error.pointer, "against the schema: " + error.message));
        }
    }
}

/// For editors only; a copied file's path leads nowhere.
std::string schema_remark(const behaviour::Document& document, const SourceText& source, const Kind& kind) {
    const auto schema = document.root.find("$schema");
    if (schema == document.root.end() || !schema->is_string()) {
        return {};
    }
    const std::string& path = schema->get_ref<const std::string&>();
    std::error_code error;
    if (path.find("://") != std::string::npos ||
        fs::exists(fs::path(source.name).parent_path() / path, error)) {
        return {};
    }
    for (const fs::path& folder : host::profile_folders()) {
        const fs::path there = fs::absolute(folder / "schemas" / kind.schema, error).lexically_normal();
        if (fs::exists(there, error)) {
            return "\"$schema\": \"" + path + "\" leads nowhere from here; for editors write \"" +
                   there.string() + "\"";
        }
    }
    return {};
}

/// The profile, screen or scenario whose name is most like this one, with its kind; empty when `file` is a
/// path.
std::string nearest_name(const std::string& file) {
    if (file.find('/') != std::string::npos || file.ends_with(".json")) {
        return {};
    }
    std::vector<std::pair<std::string, std::string>> known;  // name, kind
    const auto add = [&known](const char* kind, const std::vector<host::ProfileEntry>& entries) {
        for (const host::ProfileEntry& entry : entries) {
            known.emplace_back(entry.name, kind);
        }
    };
    add("profile", host::list_profiles());
    add("screen", host::list_screens());
    add("scenario", host::list_scripts());
    std::vector<std::string_view> names;
    for (const auto& [name, kind] : known) {
        names.emplace_back(name);
    }
    const std::string_view hit = behaviour::nearest(file, names);
    const auto row =
        std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == hit; });
    return row == known.end() ? std::string() : "the " + row->second + " " + row->first;
}

}  // namespace

CheckedFile check_file(const std::string& file) {
    CheckedFile out;
    out.file = file;
    std::optional<SourceText> source;
    try {
        source = find(file);
    } catch (const behaviour::ProfileError& error) {
        out.problems = error.problems();  // there, and it cannot be read
    }
    if (!source) {
        out.readable = false;
        out.nearest = nearest_name(file);
        return out;
    }
    try {
        const behaviour::Document document = behaviour::parse_document(*source);
        const Kind* const kind = kind_of(document);
        if (kind == nullptr) {
            out.problems.push_back(document.problem(
                "/$schema", "unknown kind of file; expected the path of " + known_schemas()));
            return out;
        }
        try {
            out.remark = kind->load(*source);
        } catch (const behaviour::ProfileError& error) {
            out.problems = error.problems();
        }
        check_form(document, *source, *kind, out);
        if (out.remark.empty()) {
            out.remark = schema_remark(document, *source, *kind);
        }
    } catch (const behaviour::ProfileError& error) {
        out.problems = error.problems();  // no JSON at all
    }
    return out;
}

}  // namespace fauxboard::tools
