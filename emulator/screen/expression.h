#pragma once

// The little language of a screen profile: what a button sends, a page shows and a rule asks may depend on
// the values the screen shows. Everything is compiled when the profile loads; a wrong name, kind or bracket
// is an error then, with the nearest known name (behaviour::ExpressionError).

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/source.h"
#include "emulator/screen/values.h"

namespace fauxboard::screen {

/// Which names beyond the declared values an expression may use.
struct Allowed {
    bool row = false;                                   ///< `row`, `row.text`
    bool input = false;                                 ///< `input`
    const std::vector<std::string>* columns = nullptr;  ///< of the row's list: `row.date`
};

/// Words of one language for those of another.
using Dictionary = std::map<std::string, std::string, std::less<>>;

/// Arithmetic on numbers: literals, value names, `row`, `input`, + - * / ( ), min(a, b), max(a, b), mod(a,
/// b), round(a), floor(a), float(a) (as 32 bits hold it), days(month, year). A list is its length. Division
/// by zero gives 0, so that a result is never a trap; it may be nan or infinite when a frame said so.
class Expression {
  public:
    Expression() = default;
    /// Throws behaviour::ExpressionError.
    Expression(std::string_view source, ValueTable& table, Allowed allowed);
    static Expression constant(double value);

    double evaluate(const Scope& scope) const;
    /// The values it looks at.
    std::vector<std::size_t> values() const;

  private:
    friend class ExpressionParser;
    enum class Op : std::uint8_t {
        constant,
        value,
        length,
        row,
        input,
        negate,
        add,
        subtract,
        multiply,
        divide,
        minimum,
        maximum,
        modulo,
        days,
        round,
        floor,
        narrow
    };
    struct Step {
        Op op = Op::constant;
        double number = 0;
        std::size_t value = 0;
    };
    std::vector<Step> steps_;  ///< in reverse Polish order
};

/// A text with places: "M104 S{nozzle.target+1:.1f}". Behind a colon stands `.Nf` (N decimals, at most 6),
/// `d` (cut to a whole number), `0Nd` (the same with N digits at least), `hms` or `hm` (seconds as HH:MM:SS,
/// HH:MM, cut) or `name` (the value's word for it); without one a number is written as short as it goes. A
/// text value, `row.text` included, stands alone between its braces; behind its colon may stand `A+N` (N
/// bytes from the A-th on, 0 is the first), `stem` or `ending` (of a file's name). `{{` and `}}` are braces.
class Template {
  public:
    Template() = default;
    /// `words` translates what `name` writes. Throws behaviour::ExpressionError.
    Template(std::string_view source, ValueTable& table, Allowed allowed, const Dictionary* words = nullptr);

    std::string render(const Scope& scope) const { return render(scope, false); }
    /// The same as UTF-8 for a terminal: texts from the wire are made printable, the literals are UTF-8.
    std::string render_for_people(const Scope& scope) const { return render(scope, true); }
    /// The source, for people.
    const std::string& source() const { return source_; }
    bool empty() const { return source_.empty(); }
    /// The values it looks at, each once.
    const std::vector<std::size_t>& values() const { return values_; }

  private:
    enum class Style : std::uint8_t { literal, fixed, whole, shortest, clock, named, text, row_text, cell };
    enum class Piece : std::uint8_t { all, slice, stem, ending };
    struct Part {
        Style style = Style::literal;
        Piece piece = Piece::all;
        int decimals = 0;       ///< fixed; digits at least of whole; parts of clock
        std::size_t value = 0;  ///< text and named; column of a cell
        std::size_t from = 0;   ///< slice
        std::size_t size = 0;
        std::string literal;
        Expression expression;
        std::map<std::int64_t, std::string> names;
    };
    std::string render(const Scope& scope, bool for_people) const;
    static std::string_view text_of(const Part& part, const Scope& scope);
    static std::string number_of(const Part& part, const Scope& scope);
    static bool text_format(std::string_view format, Part& part);
    static bool number_format(std::string_view format, Part& part);
    void add_place(std::string_view inside, ValueTable& table, Allowed allowed, const Dictionary* words);

    std::string source_;
    std::vector<Part> parts_;
    std::vector<std::size_t> values_;
};

/// One test of a `when` or a `where`.
class Condition {
  public:
    enum class Test : std::uint8_t {
        equal,
        not_equal,
        one_of,
        range,
        ends_with,
        starts_with,
        ends_not_with,
        starts_not_with
    };

    /// `left` is an expression, or the name of a text value; `right` a number, a text, or an object with one
    /// of not, in, min and max, ends_with, starts_with, ends_not_with, starts_not_with. Numbers may be
    /// expressions in a text for numeric tests. Throws behaviour::ExpressionError.
    Condition(std::string_view left, const behaviour::Json& right, ValueTable& table, Allowed allowed);

    /// Numbers are equal within 0.0005: what the wire's three decimals tell apart.
    bool holds(const Scope& scope) const;
    /// The same with its right side evaluated now.
    Condition frozen(const Scope& scope) const;
    /// What its left side is now: "1".
    std::string now(const Scope& scope) const;
    /// "nozzle.target is 201", "job.status is one of 0, 3".
    std::string words(const Scope& scope) const;

  private:
    void set_right(const behaviour::Json& right, ValueTable& table, Allowed allowed);
    void set_range(const behaviour::Json& right, ValueTable& table, Allowed allowed);
    void add_operand(const behaviour::Json& value, ValueTable& table, Allowed allowed);
    bool holds_number(const Scope& scope) const;
    bool holds_text(std::string_view text) const;

    std::string source_;
    std::string_view text(const Scope& scope) const;
    bool is_text_ = false;
    std::ptrdiff_t value_ = 0;  ///< of a text; below 0: of the row
    Expression left_;
    Test test_ = Test::equal;
    std::vector<Expression> numbers_;
    std::vector<std::string> texts_;
    bool has_min_ = false;
    bool has_max_ = false;
};

bool all_hold(const std::vector<Condition>& conditions, const Scope& scope);

/// A value and what it becomes.
struct Assign {
    std::size_t value = 0;
    Template text;          ///< of a text value
    Expression expression;  ///< of a number
};

/// Sets `values` as `assigns` say, each from what `scope` shows, which may be the same values: all from what
/// they were before, so that the order does not matter.
void assign(const std::vector<Assign>& assigns, const ValueTable& table, const Scope& scope,
            std::span<Shown> values);

}  // namespace fauxboard::screen
