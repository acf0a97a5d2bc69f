// `fauxboard check`: are these profiles, screens, scenarios and settings files right?

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/check_acfg.h"
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
        const bool path = checked.file.find('/') != std::string::npos || checked.file.ends_with(".json");
        return path ? checked.file + ": there is no such file\n"
                    : fmt::format("{}: there is no file, profile, screen or scenario of this name{}\n",
                                  checked.file,
                                  checked.nearest.empty() ? "" : "; did you mean " + checked.nearest + "?");
    }
    std::string text;
    for (const behaviour::Problem& problem : checked.problems) {
        text += problem.sentence() + "\n";
    }
    return text.empty() ? checked.file + ": ok\n" : text;
}

/// A file that was checked, as it is to be told.
struct Told {
    Json json;
    std::string text;
    ExitCode exit = ExitCode::ok;
};

Told tell(const std::string& file) {
    const CheckedFile checked = check_file(file);
    const ExitCode exit = !checked.readable          ? ExitCode::bad_input
                          : checked.problems.empty() ? ExitCode::ok
                                                     : ExitCode::failed;
    if (!checked.remark.empty()) {
        complain("check", exit, checked.file + ": " + checked.remark);
    }
    return {json_of(checked), text_of(checked), exit};
}

Told tell_acfg(const std::string& file) {
    std::string trouble;
    if (const auto checked = check_acfg(file, trouble)) {
        const bool ok = checked->report.result == dlp::AcfgResult::ok;
        return {acfg_json(*checked), acfg_text(*checked), ok ? ExitCode::ok : ExitCode::failed};
    }
    return {{{"file", file}, {"result", "not_opened"}, {"line", nullptr}, {"saved", false}},
            file + ": " + trouble + "\n",
            ExitCode::bad_input};
}

ExitCode check(const std::vector<std::string>& files, bool as_json) {
    ExitCode exit = ExitCode::ok;
    Json list = Json::array();
    for (const std::string& file : files) {
        Told told = is_acfg(file) ? tell_acfg(file) : tell(file);
        exit = std::max(exit, told.exit);
        if (as_json) {
            list.push_back(std::move(told.json));
        } else {
            print(told.text);
        }
    }
    if (as_json) {
        // A settings file alone is told as such, not as a list of one.
        const bool alone = files.size() == 1 && is_acfg(files.front());
        print((alone ? list.front() : list).dump(2, ' ', true, nlohmann::json::error_handler_t::replace) +
              "\n");
    }
    return exit;
}

}  // namespace

void add_check(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand(
        "check",
        "Check profiles, screens and scenarios: their meaning, then their form; and settings "
        "files of the MKS DLP board (.acfg)");
    const auto files = std::make_shared<std::vector<std::string>>();
    const auto as_json = std::make_shared<bool>(false);
    command->add_option("FILE", *files, "Files, or names of profiles, screens and scenarios")
        ->type_name("NAME|FILE")
        ->required();
    command->add_flag("--json", *as_json, "As a JSON array; a single .acfg as an object");
    command->callback([files, as_json, &exit] { exit = check(*files, *as_json); });
}

}  // namespace fauxboard::tools
