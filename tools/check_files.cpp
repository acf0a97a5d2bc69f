#include "tools/check_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"

namespace fauxboard::tools {
namespace {

namespace fs = std::filesystem;
using behaviour::Problem;
using behaviour::SourceText;

constexpr std::uintmax_t max_bytes = 4U * 1024 * 1024;
constexpr std::string_view schema_file = "profile.schema.json";

std::optional<SourceText> read(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > max_bytes) {
        return std::nullopt;
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::nullopt;
    }
    return SourceText{file.string(),
                      std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>())};
}

/// The file itself; else a profile of that name.
std::optional<SourceText> find(const std::string& file) {
    auto source = read(file);
    if (!source && file.find('/') == std::string::npos) {
        source = host::profile_finder()(file, {});
    }
    return source;
}

std::optional<nlohmann::json> load_schema() {
    for (const fs::path& folder : host::profile_folders()) {
        if (const auto source = read(folder / "schemas" / schema_file)) {
            auto schema = nlohmann::json::parse(source->text, nullptr, false);
            if (schema.is_object()) {
                return schema;
            }
        }
    }
    return std::nullopt;
}

/// What kind of file it is: its "$schema" says so; without one it is taken for a profile.
bool is_profile(const behaviour::Document& document) {
    const auto schema = document.root.find("$schema");
    return schema == document.root.end() ||
           (schema->is_string() && fs::path(schema->get_ref<const std::string&>()).filename() == schema_file);
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

void check_form(const behaviour::Document& document, const SourceText& source, CheckedFile& out) {
    const auto schema = load_schema();
    if (!schema) {
        out.remark = "not checked against the schema: there is no schemas/" + std::string(schema_file) +
                     " in the profiles' folders";
        return;
    }
    const std::vector<Problem> by_loader = out.problems;
    for (const SchemaError& error : check_schema(*schema, nlohmann::json::parse(source.text))) {
        if (!told(by_loader, source.name, error.pointer)) {
            out.problems.push_back(document.problem(error.pointer, "against the schema: " + error.message));
        }
    }
}

}  // namespace

CheckedFile check_file(const std::string& file) {
    CheckedFile out;
    out.file = file;
    const auto source = find(file);
    if (!source) {
        out.readable = false;
        return out;
    }
    try {
        const behaviour::Document document = behaviour::parse_document(*source);
        if (!is_profile(document)) {
            out.problems.push_back(document.problem(
                "/$schema", "unknown kind of file; expected the path of " + std::string(schema_file)));
            return out;
        }
        try {
            behaviour::load_profile(*source, host::profile_finder());
        } catch (const behaviour::ProfileError& error) {
            out.problems = error.problems();
        }
        check_form(document, *source, out);
    } catch (const behaviour::ProfileError& error) {
        out.problems = error.problems();  // no JSON at all
    }
    return out;
}

}  // namespace fauxboard::tools
