#include "emulator/screen/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/operand.h"

namespace fauxboard::screen {

using behaviour::ExpressionError;

namespace {

constexpr std::size_t max_steps = 64;
constexpr int max_depth = 16;

bool name_char(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

/// Of a month, 1 to 12, of a year in which every fourth is a leap year.
double days_of(double month, double year) {
    if (month == 2) {
        return std::fmod(year, 4) == 0 ? 29 : 28;
    }
    return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

}  // namespace

/// Recursive descent; its depth and length are bounded.
class ExpressionParser {
  public:
    ExpressionParser(std::string_view source, ValueTable& table, Allowed allowed)
        : source_(source), rest_(source), table_(table), allowed_(allowed) {}

    std::vector<Expression::Step> parse() {
        sum(0);
        skip();
        if (!rest_.empty()) {
            fail(fmt::format("\"{}\" was not expected", rest_.substr(0, 20)));
        }
        return std::move(steps_);
    }

  private:
    using Op = Expression::Op;

    [[noreturn]] void fail(const std::string& why, std::string nearest = {}) const {
        throw ExpressionError(fmt::format("in \"{}\": {}", source_, why), std::move(nearest));
    }
    void skip() {
        while (rest_.starts_with(' ')) {
            rest_.remove_prefix(1);
        }
    }
    bool take(char c) {
        skip();
        if (!rest_.starts_with(c)) {
            return false;
        }
        rest_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!take(c)) {
            fail(fmt::format(
                "expected '{}' {}", c,
                rest_.empty() ? "at the end" : fmt::format("before \"{}\"", rest_.substr(0, 20))));
        }
    }
    void push(Op op, double number = 0, std::size_t value = 0) {
        if (steps_.size() == max_steps) {
            fail("more than 64 steps");
        }
        steps_.push_back({op, number, value});
    }

    void sum(int depth) {
        product(depth);
        for (;;) {
            if (take('+')) {
                product(depth);
                push(Op::add);
            } else if (take('-')) {
                product(depth);
                push(Op::subtract);
            } else {
                return;
            }
        }
    }
    void product(int depth) {
        factor(depth);
        for (;;) {
            if (take('*')) {
                factor(depth);
                push(Op::multiply);
            } else if (take('/')) {
                factor(depth);
                push(Op::divide);
            } else {
                return;
            }
        }
    }
    void factor(int depth) {
        if (depth > max_depth) {
            fail("nested deeper than 16");
        }
        if (take('-')) {
            factor(depth + 1);
            push(Op::negate);
        } else if (take('(')) {
            sum(depth + 1);
            expect(')');
        } else {
            skip();
            atom(depth);
        }
    }
    void atom(int depth) {
        double number = 0;
        if (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9') {
            const auto read =
                std::from_chars(rest_.data(), rest_.data() + rest_.size(), number, std::chars_format::fixed);
            if (read.ec != std::errc{}) {
                fail("a number beyond all bounds");
            }
            rest_.remove_prefix(static_cast<std::size_t>(read.ptr - rest_.data()));
            push(Op::constant, number);
            return;
        }
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), name_char);
        const std::string_view name = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
        if (name.empty()) {
            fail(rest_.empty()
                     ? "a number or a name is missing at the end"
                     : fmt::format("expected a number or a name before \"{}\"", rest_.substr(0, 20)));
        }
        rest_.remove_prefix(name.size());
        take('(') ? call(name, depth) : look_up(name);
    }

    void call(std::string_view name, int depth) {
        struct Function {
            std::string_view name;
            Op op;
            int arguments;
        };
        static constexpr std::array<Function, 7> functions{{{"min", Op::minimum, 2},
                                                            {"max", Op::maximum, 2},
                                                            {"mod", Op::modulo, 2},
                                                            {"days", Op::days, 2},
                                                            {"round", Op::round, 1},
                                                            {"floor", Op::floor, 1},
                                                            {"float", Op::narrow, 1}}};
        const auto* hit = std::find_if(functions.begin(), functions.end(),
                                       [&](const Function& f) { return f.name == name; });
        if (hit == functions.end()) {
            std::vector<std::string_view> names;
            for (const Function& function : functions) {
                names.push_back(function.name);
            }
            fail(fmt::format("there is no function \"{}\"; known: {}", name, fmt::join(names, ", ")),
                 std::string(behaviour::nearest(name, names)));
        }
        for (int i = 0; i < hit->arguments; ++i) {
            if (i != 0) {
                expect(',');
            }
            sum(depth + 1);
        }
        expect(')');
        push(hit->op);
    }

    void look_up(std::string_view name) {
        if (name == "row" && allowed_.row) {
            push(Op::row);
        } else if (name == "input" && allowed_.input) {
            push(Op::input);
        } else if (const auto id = table_.want(name)) {
            if (table_.at(*id).kind == ValueKind::text) {
                fail(fmt::format("\"{}\" is a text; expected a number", name));
            }
            push(table_.at(*id).kind == ValueKind::list ? Op::length : Op::value, 0, *id);
        } else if (name == "input" || name == "row" || name == "row.text") {
            fail(fmt::format("\"{}\" is known only to a button with \"{}\"", name,
                             name == "input" ? "input" : "rows"));
        } else {
            fail(fmt::format("unknown value \"{}\"", name), table_.nearest(name));
        }
    }

    std::string_view source_;
    std::string_view rest_;
    ValueTable& table_;
    Allowed allowed_;
    std::vector<Expression::Step> steps_;
};

Expression::Expression(std::string_view source, ValueTable& table, Allowed allowed)
    : steps_(ExpressionParser(source, table, allowed).parse()) {}

Expression Expression::constant(double value) {
    Expression out;
    out.steps_.push_back({Op::constant, value, 0});
    return out;
}

std::vector<std::size_t> Expression::values() const {
    std::vector<std::size_t> out;
    for (const Step& step : steps_) {
        if (step.op == Op::value || step.op == Op::length) out.push_back(step.value);
    }
    return out;
}

double Expression::evaluate(const Scope& scope) const {
    std::array<double, max_steps + 2> stack{};  // one slot of slack below the bottom
    std::size_t top = 1;
    for (const Step& step : steps_) {
        double& a = stack[top - 1];  // the operand of one, the left of two after the pop below
        const bool two = step.op >= Op::add && step.op <= Op::days;
        double& left = two ? stack[top - 2] : a;
        const double b = a;
        switch (step.op) {
            case Op::constant:
                stack[top++] = step.number;
                continue;
            case Op::value:
                stack[top++] = scope.values[step.value].number;
                continue;
            case Op::length:
                stack[top++] = static_cast<double>(scope.values[step.value].list.size());
                continue;
            case Op::row:
                stack[top++] = static_cast<double>(scope.row);
                continue;
            case Op::input:
                stack[top++] = scope.input;
                continue;
            case Op::negate:
                left = -b;
                break;
            case Op::round:
                left = std::round(b);
                break;
            case Op::floor:
                left = std::floor(b);
                break;
            case Op::narrow:
                left = static_cast<double>(static_cast<float>(b));
                break;
            case Op::days:
                left = days_of(left, b);
                break;
            case Op::add:
                left += b;
                break;
            case Op::subtract:
                left -= b;
                break;
            case Op::multiply:
                left *= b;
                break;
            case Op::divide:
                left = b == 0 ? 0 : left / b;
                break;
            case Op::minimum:
                left = std::min(left, b);
                break;
            case Op::maximum:
                left = std::max(left, b);
                break;
            case Op::modulo:
                left = b == 0 ? 0 : left - b * std::floor(left / b);
                break;
        }
        top -= two ? 1U : 0U;
    }
    return stack[top - 1];
}

}  // namespace fauxboard::screen
