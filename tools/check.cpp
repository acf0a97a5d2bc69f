// `fauxboard check`: are these profiles, screens and scenarios right?

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/check_files.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const CheckedFile& checked) {
    Json problems = Json::array();
    for (const behaviour::Problem& problem : checked.problems) {
        Json row{{"file", problem.file},
                 {"line", problem.line},
                 {"pointer", problem.pointer},
                 {"message", problem.message}};
        row["nearest"] = problem.nearest.empty() ? Json(nullptr) : Json(problem.nearest);
        problems.push_back(std::move(row));
    }
    return {{"file", checked.file},
            {"readable", checked.readable},
            {"ok", checked.readable && checked.problems.empty()},
            {"problems", std::move(problems)}};
}

std::string text_of(const CheckedFile& checked) {
    if (!checked.readable && checked.problems.empty()) {
        return fmt::format("{}: there is no such file\n", checked.file);
    }
    std::string text;
    for (const behaviour::Problem& problem : checked.problems) {
        text += problem.sentence() + "\n";
    }
    return text.empty() ? checked.file + ": ok\n" : text;
}

ExitCode check(const std::vector<std::string>& files, bool as_json) {
    ExitCode exit = ExitCode::ok;
    Json list = Json::array();
    for (const std::string& file : files) {
        const CheckedFile checked = check_file(file);
        if (!checked.readable) {
            exit = ExitCode::bad_input;
        } else if (!checked.problems.empty() && exit == ExitCode::ok) {
            exit = ExitCode::failed;
        }
        if (as_json) {
            list.push_back(json_of(checked));
        } else {
            print(text_of(checked));
        }
        if (!checked.remark.empty()) {
            complain("check", exit, checked.file + ": " + checked.remark);
        }
    }
    if (as_json) {
        print(list.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n");
    }
    return exit;
}

}  // namespace

void add_check(CLI::App& app, ExitCode& exit) {
    CLI::App* command =
        app.add_subcommand("check", "Check profiles, screens and scenarios: their meaning, then their form");
    const auto files = std::make_shared<std::vector<std::string>>();
    const auto as_json = std::make_shared<bool>(false);
    command->add_option("file", *files, "Files, or names of profiles, screens and scenarios")->required();
    command->add_flag("--json", *as_json, "As a JSON array");
    command->callback([files, as_json, &exit] { exit = check(*files, *as_json); });
}

}  // namespace fauxboard::tools
