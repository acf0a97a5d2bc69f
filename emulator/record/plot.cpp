#include "emulator/record/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "emulator/filament/thermal_fold.h"
#include "emulator/record/compare_talk.h"

namespace fauxboard::record {
namespace {

constexpr double width = 960;
constexpr double height = 260;
constexpr double left = 64;
constexpr double right = 190;
constexpr double top = 24;
constexpr double bottom = 34;
constexpr std::size_t most_points = 1200;  ///< of a curve: more than pixels are not seen
constexpr std::size_t most_curves = 8;     ///< of a chart
constexpr std::size_t least_points = 3;

constexpr std::array<std::string_view, most_curves> colours{"#c8102e", "#e08a9b", "#1766b5", "#86b5e0",
                                                            "#1a7467", "#8a5a00", "#6d3fb2", "#4d5c58"};
constexpr std::array<std::string_view, 3> units{"°C", "mm", "%"};

struct Point {
    double t = 0;
    double value = 0;
};
using Curve = std::vector<Point>;
/// Of one unit: what it is called, and its curve in each of the sets.
using Chart = std::map<std::string, std::vector<Curve>, std::less<>>;

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool plain =
            static_cast<unsigned char>(c) >= 0x20 && c != '<' && c != '>' && c != '&' && c != '"';
        out += plain ? std::string(1, c)
                     : fmt::format("&#{};", static_cast<unsigned char>(c) < 0x20 ? 0xFFFD : c);
    }
    return out;
}

/// Everything of one set that has the unit, by the name of the quantity.
void collect(const std::vector<detail::Said>& talk, std::string_view unit, bool folded, std::size_t set,
             std::size_t sets, Chart& chart) {
    for (const detail::Said& said : talk) {
        std::string before;  // what a field in brackets is about
        for (const protocol::DecodedField& field : said.decoded.fields) {
            if (field.info == nullptr || field.info->unit != unit || !field.number) {
                continue;
            }
            const bool bracketed = field.info->form == protocol::FieldForm::bracketed;
            const std::string own(field.info->name);
            const std::string name = bracketed ? before + ", " + own : own;
            if (!bracketed) {
                before = own;
            }
            const bool fold = folded && unit == units[0] && !bracketed;
            auto& curves = chart[name];
            curves.resize(sets);
            curves[set].push_back(
                {said.t, fold ? filament::unfold_temperature(*field.number) : *field.number});
        }
    }
}

/// Curves that say nothing are left out, and of the others those that say least.
void choose(Chart& chart) {
    for (auto it = chart.begin(); it != chart.end();) {
        bool moves = false;
        for (const Curve& curve : it->second) {
            moves = moves || (curve.size() >= least_points &&
                              std::any_of(curve.begin(), curve.end(),
                                          [&](const Point& p) { return p.value != curve.front().value; }));
        }
        it = moves && std::distance(chart.begin(), it) < static_cast<std::ptrdiff_t>(most_curves)
                 ? std::next(it)
                 : chart.erase(it);
    }
}

struct Bounds {
    double t0 = 0, t1 = 1, low = 0, high = 1;
};

Bounds bounds_of(const Chart& chart) {
    Bounds out{1e300, -1e300, 1e300, -1e300};
    for (const auto& [name, curves] : chart) {
        for (const Curve& curve : curves) {
            for (const Point& point : curve) {
                out.t0 = std::min(out.t0, point.t);
                out.t1 = std::max(out.t1, point.t);
                out.low = std::min(out.low, point.value);
                out.high = std::max(out.high, point.value);
            }
        }
    }
    out.t1 = std::max(out.t1, out.t0 + 1e-3);
    out.high = std::max(out.high, out.low + 1e-3);
    return out;
}

/// A round distance between marks, so that there are some five of them.
double step_of(double span) {
    const double rough = span / 5;
    const double decade = std::pow(10, std::floor(std::log10(rough)));
    for (const double nice : {1.0, 2.0, 5.0}) {
        if (nice * decade >= rough) {
            return nice * decade;
        }
    }
    return 10 * decade;
}

class Drawing {
  public:
    Drawing(const Bounds& bounds, double y) : bounds_(bounds), y_(y) {}

    double x(double t) const {
        return left + (t - bounds_.t0) / (bounds_.t1 - bounds_.t0) * (width - left - right);
    }
    double y(double value) const {
        return y_ + height - bottom -
               (value - bounds_.low) / (bounds_.high - bounds_.low) * (height - top - bottom);
    }

    std::string axes(std::string_view unit) const {
        std::string out =
            fmt::format("<text x=\"12\" y=\"{:.0f}\" class=\"unit\">{}</text>\n", y_ + top, unit);
        const double rise = step_of(bounds_.high - bounds_.low);
        for (double mark = std::ceil(bounds_.low / rise) * rise; mark <= bounds_.high; mark += rise) {
            out += fmt::format(
                "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.0f}\" y=\"{:.1f}\" "
                "class=\"end\">{:g}</text>\n",
                left, y(mark), width - right, left - 6, y(mark) + 4, std::abs(mark) < rise / 1e6 ? 0 : mark);
        }
        const double pace = step_of(bounds_.t1 - bounds_.t0);
        for (double mark = std::ceil(bounds_.t0 / pace) * pace; mark <= bounds_.t1; mark += pace) {
            out += fmt::format(
                "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
                "class=\"mid\">{4:g} s</text>\n",
                x(mark), y_ + top, y_ + height - bottom, y_ + height - bottom + 16, mark);
        }
        return out;
    }

    std::string curve(const Curve& points, std::string_view colour, bool pale) const {
        if (points.empty()) {
            return {};
        }
        std::string d;
        const std::size_t stride = std::max<std::size_t>(1, points.size() / most_points);
        for (std::size_t i = 0; i < points.size(); i += stride) {
            d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? 'M' : 'L', x(points[i].t), y(points[i].value));
        }
        return fmt::format("<path class=\"{}\" stroke=\"{}\" d=\"{}\"/>\n", pale ? "wide" : "thin", colour,
                           d);
    }

  private:
    Bounds bounds_;
    double y_;
};

std::string draw(const Chart& chart, std::string_view unit, double y) {
    const Drawing drawing(bounds_of(chart), y);
    std::string out = drawing.axes(unit);
    std::size_t number = 0;
    for (const auto& [name, curves] : chart) {
        const std::string_view colour = colours[number];
        for (std::size_t set = 0; set < curves.size(); ++set) {
            out += drawing.curve(curves[set], colour, set == 0 && curves.size() > 1);
        }
        out += fmt::format(
            "<path class=\"thin\" stroke=\"{}\" d=\"M{:.0f} {:.0f}h18\"/><text x=\"{:.0f}\" "
            "y=\"{:.0f}\">{}</text>\n",
            colour, width - right + 10, y + top + 4 + 18 * static_cast<double>(number), width - right + 34,
            y + top + 8 + 18 * static_cast<double>(number), escaped(name));
        ++number;
    }
    return out;
}

std::string legend(const std::vector<PlotLines>& sets, double y) {
    std::string out;
    for (std::size_t set = 0; set < sets.size() && sets.size() > 1; ++set) {
        const double at = left + 160 * static_cast<double>(set);
        out += fmt::format(
            "<path class=\"{}\" stroke=\"#555\" d=\"M{:.0f} {:.0f}h26\"/><text x=\"{:.0f}\" "
            "y=\"{:.0f}\">{}</text>\n",
            set == 0 ? "wide" : "thin", at, y, at + 32, y + 4, escaped(sets[set].name));
    }
    return out;
}

}  // namespace

std::string plot_svg(const std::vector<PlotLines>& sets, bool folded) {
    std::vector<std::vector<detail::Said>> talks;
    for (const PlotLines& set : sets) {
        talks.push_back(detail::board_talk(set.lines));
    }
    std::string body;
    double y = 12;
    for (const std::string_view unit : units) {
        Chart chart;
        for (std::size_t set = 0; set < talks.size(); ++set) {
            collect(talks[set], unit, folded, set, talks.size(), chart);
        }
        choose(chart);
        if (!chart.empty()) {
            body += draw(chart, unit, y);
            y += height;
        }
    }
    if (body.empty()) {
        body = "<text x=\"24\" y=\"40\">Nothing in this recording draws a curve.</text>\n";
        y += 60;
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<style>path{{fill:none;stroke-linejoin:round}}.grid{{stroke:#e2e6e4}}.thin{{stroke-width:1.6}}"
        ".wide{{stroke-width:5;opacity:.35}}.end{{text-anchor:end}}.mid{{text-anchor:middle}}"
        ".unit{{font-weight:bold}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}{3}</svg>\n",
        width, y + 30, body, legend(sets, y + 10));
}

}  // namespace fauxboard::record
