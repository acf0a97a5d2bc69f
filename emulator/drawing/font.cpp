#include "emulator/drawing/font.h"

#include <cmath>
#include <stdexcept>

// DejaVu Sans as Debian has it (free, of Bitstream Vera's kind of licence), put into the program as it is: a
// picture looks the same wherever the program runs.
extern "C" {
extern const unsigned char fauxboard_font_begin[];
extern const unsigned char fauxboard_font_end[];
}
asm(".pushsection .rodata\n"
    ".balign 16\n"
    ".globl fauxboard_font_begin\n"
    "fauxboard_font_begin:\n"
    ".incbin \"" FAUXBOARD_FONT
    "\"\n"
    ".globl fauxboard_font_end\n"
    "fauxboard_font_end:\n"
    ".byte 0\n"
    ".popsection\n");

namespace fauxboard::drawing {
namespace {

/// Of the height of a line: the font's own ascent and descent are 1.164 of it.
constexpr double em_of_line = 1 / 1.164;
constexpr double fixed_point = 65536;
constexpr char32_t no_character = 0xFFFD;

}  // namespace

Font::Font() {
    const auto size = fauxboard_font_end - fauxboard_font_begin;
    if (FT_Init_FreeType(&library_) != 0 ||
        FT_New_Memory_Face(library_, fauxboard_font_begin, size, 0, &face_) != 0) {
        throw std::runtime_error("FreeType cannot open the font within the program");
    }
}

Font::~Font() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
}

Font& Font::get() {
    static thread_local Font font;
    return font;
}

void Font::set(double size, double squeeze) {
    FT_Set_Char_Size(face_, 0, std::lround(size * em_of_line * 64), 72, 72);
    FT_Matrix matrix{std::lround(squeeze * fixed_point), 0, 0, std::lround(fixed_point)};
    FT_Set_Transform(face_, &matrix, nullptr);
}

char32_t take_character(std::string_view& utf8) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(utf8[i]); };
    const unsigned char first = byte(0);
    const std::size_t more = first < 0x80 ? 0 : first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
    if (first < 0x20 || (first >= 0x80 && first < 0xC2) || first > 0xF4 || utf8.size() <= more) {
        utf8.remove_prefix(1);
        return no_character;
    }
    char32_t out = more == 0 ? first : first & (0x3FU >> more);
    for (std::size_t i = 1; i <= more; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) {
            utf8.remove_prefix(1);
            return no_character;
        }
        out = out << 6U | (byte(i) & 0x3FU);
    }
    utf8.remove_prefix(more + 1);
    return out;
}

}  // namespace fauxboard::drawing
