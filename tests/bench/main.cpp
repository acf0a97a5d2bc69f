// fauxboard_bench: what the board costs, against floors built here.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/figure.h"

namespace fauxboard::bench {

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

namespace {

void print_row(const Figure& figure) {
    if (!figure.skipped.empty()) {
        std::printf("%-42s skipped: %s\n", figure.name.c_str(), figure.skipped.c_str());
        return;
    }
    const std::string floor = figure.floor ? CLI::detail::to_string(*figure.floor) : "-";
    std::printf("%-42s %12.3f %12.12s %-12s %8.3f %8g  %s\n", figure.name.c_str(), figure.measured,
                floor.c_str(), figure.unit.c_str(), figure.value(), figure.limit,
                figure.holds() ? "ok" : "BEYOND THE LIMIT");
}

nlohmann::ordered_json to_json(const Figure& figure) {
    nlohmann::ordered_json out{{"name", figure.name}, {"unit", figure.unit}};
    if (!figure.skipped.empty()) {
        out["skipped"] = figure.skipped;
        return out;
    }
    out["measured"] = figure.measured;
    out["floor"] = figure.floor ? nlohmann::ordered_json(*figure.floor) : nlohmann::ordered_json(nullptr);
    out["value"] = figure.value();
    out["limit"] = figure.limit;
    out["holds"] = figure.holds();
    return out;
}

}  // namespace
}  // namespace fauxboard::bench

int main(int argc, char** argv) {
    using namespace fauxboard::bench;
    std::vector<Benchmark> all = in_process_benchmarks();
    for (const auto& more : {print_benchmarks(), pty_benchmarks(), tap_benchmarks(), resin_benchmarks(),
                             dlp_benchmarks(), panel_benchmarks(), marlin_benchmarks()}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    Settings settings;
    settings.program = FAUXBOARD_PROGRAM;
    bool check = false;
    bool json = false;
    std::vector<std::string> only;
    CLI::App app("Measures the board against floors built in the same program and run.");
    app.add_flag("--check", check, "exit with 1 if a figure is beyond its limit");
    app.add_flag("--json", json, "print the figures as JSON");
    app.add_flag("--smoke", settings.smoke, "run each as briefly as possible; the numbers mean nothing");
    app.add_option("--program", settings.program, "the fauxboard to measure")->capture_default_str();
    app.add_option("NAME", only, "which benchmarks; all if left out");
    std::string names = "Benchmarks:\n";
    for (const Benchmark& benchmark : all) {
        names.append("  ").append(benchmark.name).append(": ").append(benchmark.help).append("\n");
    }
    app.footer(names);
    CLI11_PARSE(app, argc, argv);

    bool holds = true;
    nlohmann::ordered_json results = nlohmann::ordered_json::array();
    if (!json) {
        std::printf("%-42s %12s %12s %-12s %8s %8s\n", "", "measured", "floor", "unit", "value", "limit");
    }
    for (const Benchmark& benchmark : all) {
        if (!only.empty() && std::find(only.begin(), only.end(), benchmark.name) == only.end()) {
            continue;
        }
        for (const Figure& figure : benchmark.run(settings)) {
            holds = holds && figure.holds();
            json ? results.push_back(to_json(figure)) : print_row(figure);
            std::fflush(stdout);
        }
    }
    if (json) {
        std::printf("%s\n", results.dump(2).c_str());
    }
    return check && !holds ? 1 : 0;
}
