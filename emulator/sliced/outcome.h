#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace fauxboard::sliced {

/// A value, or a sentence that says why there is none: files come from outside, so a wrong one is no
/// exception.
template <class T>
class Outcome {
  public:
    Outcome(T value) : value_(std::move(value)) {}
    static Outcome failure(std::string_view problem) {
        Outcome outcome;
        outcome.problem_ = problem;
        return outcome;
    }

    explicit operator bool() const { return value_.has_value(); }
    const T& operator*() const { return *value_; }
    T& operator*() { return *value_; }
    const T* operator->() const { return &*value_; }
    T* operator->() { return &*value_; }
    /// A full sentence; empty when there is a value.
    const std::string& problem() const { return problem_; }

  private:
    Outcome() = default;
    std::optional<T> value_;
    std::string problem_;
};

}  // namespace fauxboard::sliced
