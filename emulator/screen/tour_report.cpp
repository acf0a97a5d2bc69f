#include "emulator/screen/tour_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/junit.h"
#include "emulator/screen/screen_json.h"

namespace fauxboard::screen {

using behaviour::Json;

namespace {

std::size_t count(std::span<const TourResult> results, TourVerdict verdict) {
    return static_cast<std::size_t>(std::count_if(
        results.begin(), results.end(), [&](const TourResult& result) { return result.verdict == verdict; }));
}

std::string joined(const std::vector<std::string>& lines, std::size_t most) {
    std::string out = printable(fmt::format("{}", fmt::join(lines, " | ")));
    if (out.empty()) {
        return "-";
    }
    std::size_t columns = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool starts = (static_cast<unsigned char>(out[i]) & 0xC0U) != 0x80U;
        if (starts && ++columns > most) {
            return out.substr(0, i) + "...";
        }
    }
    return out;
}

/// What can go wrong with the talk of a screen that sends one command at a time, and how often it did.
struct Mishap {
    const char* key;
    const char* words;
    std::uint64_t count;
};
std::array<Mishap, 5> mishaps(const ScreenCounters& counters) {
    const auto judged = [&](Verdict verdict) { return counters.verdicts[static_cast<std::size_t>(verdict)]; };
    return {{{"timeouts", "time-outs", counters.timeouts},
             {"desynchronised", "desynchronised", judged(Verdict::runs_ahead)},
             {"stalls", "stalls", judged(Verdict::stalls)},
             {"jams", "jams", judged(Verdict::jams)},
             {"crashes", "crashes", counters.crashes}}};
}

std::string class_name(std::string_view screen, std::string_view button) {
    const std::size_t slash = button.rfind('/');
    return fmt::format("{}.{}", screen, slash == std::string_view::npos ? "Main" : button.substr(0, slash));
}

}  // namespace

std::string tour_table(std::span<const TourResult> results) {
    std::size_t widest = 6;
    for (const TourResult& result : results) {
        widest = std::max(widest, result.button.size());
    }
    std::string out = fmt::format("{:<{}}  {:<11}  {:>8}  {:<36}  {}\n", "Button", widest, "Verdict", "Took",
                                  "Sent", "Came");
    for (const TourResult& result : results) {
        out += fmt::format("{:<{}}  {:<11}  {:>6.2f} s  {:<36}  {}\n", result.button, widest,
                           tour_verdict_words(result.verdict), machine::to_seconds(result.took),
                           joined(result.sent, 33), joined(result.came, 60));
    }
    out += fmt::format("\n{} buttons: {} met, {} not met, {} not pressed\n", results.size(),
                       count(results, TourVerdict::met), count(results, TourVerdict::not_met),
                       count(results, TourVerdict::not_pressed));
    for (const TourResult& result : results) {
        if (result.verdict != TourVerdict::met) {
            out += result.sentence + '\n';
        }
    }
    return out;
}

std::string tour_json(std::string_view screen, std::span<const TourResult> results,
                      std::span<const Finding> findings, const ScreenCounters* talk) {
    Json root;
    root["screen"] = screen;
    root["passed"] = count(results, TourVerdict::met) == results.size();
    root["buttons"] = results.size();
    for (const TourVerdict verdict : {TourVerdict::met, TourVerdict::not_met, TourVerdict::not_pressed}) {
        std::string key(tour_verdict_words(verdict));
        std::replace(key.begin(), key.end(), ' ', '_');
        root[key] = count(results, verdict);
    }
    root["results"] = Json::array();
    for (const TourResult& result : results) {
        root["results"].push_back(to_json(result));
    }
    root["findings"] = Json::array();
    for (const Finding& finding : findings) {
        root["findings"].push_back(to_json(finding));
    }
    if (talk != nullptr) {
        for (const Mishap& one : mishaps(*talk)) {
            root[one.key] = one.count;
        }
    }
    return root.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string talk_text(const ScreenCounters& counters) {
    std::vector<std::string> parts;
    for (const Mishap& one : mishaps(counters)) {
        parts.push_back(fmt::format("{} {}", one.count, one.words));
    }
    return fmt::format("{}\n", fmt::join(parts, ", "));
}

std::string tour_junit(std::string_view screen, std::span<const TourResult> results) {
    std::vector<behaviour::JUnitCase> cases;
    for (const TourResult& result : results) {
        behaviour::JUnitCase one{class_name(screen, result.button),
                                 result.button,
                                 machine::to_seconds(result.took),
                                 "",
                                 "",
                                 false};
        if (result.verdict != TourVerdict::met) {
            one.failure = tour_verdict_words(result.verdict);
            one.message = result.sentence;
        }
        cases.push_back(std::move(one));
    }
    return behaviour::junit_text(fmt::format("tour of {}", screen), cases);
}

std::string findings_text(std::span<const Finding> findings) {
    std::string out;
    for (const Finding& finding : findings) {
        out += fmt::format("{} x  {}\n", finding.times, finding.first.sentence());
    }
    return out;
}

}  // namespace fauxboard::screen
