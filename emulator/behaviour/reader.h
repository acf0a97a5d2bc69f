#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/document.h"

namespace fauxboard::behaviour {

/// Problems found so far, and the document they are in.
struct Findings {
    const Document& document;
    std::vector<Problem> problems;

    void add(std::string_view pointer, std::string message, std::string nearest = {}) {
        problems.push_back(document.problem(pointer, std::move(message), std::move(nearest)));
    }
};

/// Reads one JSON object of a profile key by key: every key asked for is known from then on, and finish()
/// reports the others with the nearest known name. A wrong value is reported and the default stays.
class ObjectReader {
  public:
    /// `node` may be anything; if it is no object that is reported and every key is absent.
    ObjectReader(const Json& node, std::string pointer, Findings& findings);

    bool has(std::string_view key);
    /// The value of `key`, or null when it is absent.
    const Json* get(std::string_view key);
    std::string pointer(std::string_view key) const;

    // Each leaves `out` as it is when the key is absent or its value wrong.
    void number(std::string_view key, double& out, double min, double max);
    void integer(std::string_view key, int& out, int min, int max) { whole(key, out, min, max); }
    void unsigned_integer(std::string_view key, unsigned& out, unsigned min, unsigned max) {
        whole(key, out, min, max);
    }
    void boolean(std::string_view key, bool& out);
    void text(std::string_view key, std::string& out, std::size_t max_bytes = 4096);
    /// A text for the wire: its characters become single bytes (see to_wire).
    void wire_text(std::string_view key, std::string& out, std::size_t max_bytes = 4096);
    /// One of `names`; out is its index.
    void choice(std::string_view key, std::span<const std::string_view> names, std::size_t& out);
    /// Exactly `out.size()` numbers.
    void numbers(std::string_view key, std::span<double> out, double min, double max);
    /// {"x": 1, "y": 2, ...}: one optional number per name, in order.
    void axes(std::string_view key, std::span<const std::string_view> names,
              std::span<std::optional<double>> out, double min, double max);

    void required(std::string_view key);
    /// Reports the keys nobody asked for. "$schema" and "comment" are always welcome.
    void finish();

  private:
    const Json* typed(std::string_view key, bool (Json::*test)() const noexcept, std::string_view expected);
    template <class T>
    void whole(std::string_view key, T& out, T min, T max);

    const Json* object_ = nullptr;
    std::string pointer_;
    Findings& findings_;
    std::set<std::string, std::less<>> known_;
};

/// "found the text \"abc\"", "found an array": for messages.
std::string found(const Json& value);

}  // namespace fauxboard::behaviour
