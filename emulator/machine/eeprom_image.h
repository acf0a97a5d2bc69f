#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fauxboard::machine {

/// What the EEPROM holds: a text, and notes of whoever writes it, so that saving what is saved already is
/// cheap.
class EepromImage {
  public:
    /// Another text; what was noted of the one before is forgotten.
    EepromImage& operator=(std::string text) {
        text_ = std::move(text);
        notes_.clear();
        return *this;
    }
    const std::string& text() const { return text_; }
    operator const std::string&() const {
        return text_;
    }                                                    // NOLINT(google-explicit-constructor): it is a text
    operator std::string_view() const { return text_; }  // NOLINT(google-explicit-constructor)
    bool empty() const { return text_.empty(); }
    std::size_t size() const { return text_.size(); }

    /// The writer's notes on the text as it is now, empty when there are none.
    std::vector<std::uint64_t>& notes() { return notes_; }
    /// Room to put the next text together in, and how that becomes the text; the notes stay. Nothing is
    /// allocated once both have grown to what is needed.
    std::string& draft() { return draft_; }
    void take_draft() { text_.swap(draft_); }

  private:
    std::string text_;
    std::string draft_;
    std::vector<std::uint64_t> notes_;
};

}  // namespace fauxboard::machine
