#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::bench {

/// One measured number and what it may be.
struct Figure {
    std::string name;
    std::string unit;  ///< of `measured` and `floor`
    double measured = 0;
    std::optional<double> floor;  ///< the same for the floor built in the same program and run
    double limit = 0;             ///< of the ratio to the floor; without a floor, of `measured`
    std::string skipped{};        ///< why there is no number, if so

    double value() const { return floor ? measured / *floor : measured; }
    bool holds() const { return !skipped.empty() || value() <= limit; }
};

struct Settings {
    bool smoke = false;     ///< as short as possible: it runs, the numbers mean nothing
    std::string program{};  ///< the `fauxboard` to measure
};

/// One benchmark: gives one figure or several that come from the same run.
struct Benchmark {
    std::string_view name;
    std::string_view help;
    std::vector<Figure> (*run)(const Settings&);
};

std::vector<Benchmark> in_process_benchmarks();
std::vector<Benchmark> print_benchmarks();
std::vector<Benchmark> pty_benchmarks();
std::vector<Benchmark> tap_benchmarks();
std::vector<Benchmark> resin_benchmarks();
std::vector<Benchmark> dlp_benchmarks();
std::vector<Benchmark> panel_benchmarks();
std::vector<Benchmark> marlin_benchmarks();

double median(std::vector<double> values);

}  // namespace fauxboard::bench
