#pragma once

// Private to this folder: the font, and FreeType.

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <string_view>

namespace fauxboard::drawing {

/// The font within the program, opened once in each thread.
class Font {
  public:
    static Font& get();

    FT_Library freetype() const { return library_; }
    FT_Face face() const { return face_; }
    /// Makes glyphs of this size from line to line, squeezed to so much of their width.
    void set(double size, double squeeze);

    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

  private:
    Font();
    ~Font();
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

/// The first character of `utf8`, which loses it; U+FFFD for bytes that are none.
char32_t take_character(std::string_view& utf8);

}  // namespace fauxboard::drawing
