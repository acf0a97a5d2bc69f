#include "tools/png_file.h"

#include <png.h>

#include <csetjmp>
#include <new>
#include <vector>

#include "emulator/link/output_file.h"

namespace fauxboard::tools {
namespace {

/// libpng's two structures, freed together.
struct Png {
    png_structp out = nullptr;
    png_infop info = nullptr;
    Png() = default;
    Png(const Png&) = delete;
    Png& operator=(const Png&) = delete;
    ~Png() { png_destroy_write_struct(&out, &info); }
};

[[noreturn]] void quiet_error(png_structp png, png_const_charp) {
    png_longjmp(png, 1);
}
void quiet_warning(png_structp, png_const_charp) {}

// libpng reports errors by longjmp(): the three steps below hold nothing that would need destroying.

void add_bytes(png_structp png, png_bytep bytes, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), size);
}
void flush_nothing(png_structp) {}

bool begin(const Png& png, std::string& out, const PngPicture& picture) {
    if (setjmp(png_jmpbuf(png.out)) != 0) {
        return false;
    }
    png_set_write_fn(png.out, &out, add_bytes, flush_nothing);
    if (picture.bits) {  // many of them are written while a print waits
        png_set_compression_level(png.out, 1);
        png_set_filter(png.out, 0, PNG_FILTER_NONE);
    }
    png_set_IHDR(png.out, png.info, picture.width, picture.height, picture.bits ? 1 : 8,
                 picture.colour ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png.out, png.info);
    return true;
}

bool put_row(const Png& png, const unsigned char* row) {
    if (setjmp(png_jmpbuf(png.out)) != 0) {
        return false;
    }
    png_write_row(png.out, row);
    return true;
}

bool end(const Png& png) {
    if (setjmp(png_jmpbuf(png.out)) != 0) {
        return false;
    }
    png_write_end(png.out, nullptr);
    return true;
}

}  // namespace

bool write_png(const std::string& path, const PngPicture& picture) {
    std::string bytes;
    Png png;
    png.out = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, quiet_error, quiet_warning);
    png.info = png.out != nullptr ? png_create_info_struct(png.out) : nullptr;
    if (png.info == nullptr) {
        throw std::bad_alloc();
    }
    const std::size_t width = picture.width;
    std::vector<unsigned char> row(picture.bits ? (width + 7) / 8 : width * (picture.colour ? 3 : 1));
    bool good = begin(png, bytes, picture);
    for (std::uint32_t y = 0; good && y < picture.height; ++y) {
        if (!picture.next_row(row)) {
            return false;
        }
        good = put_row(png, row.data());
    }
    if (!good || !end(png)) {
        throw std::bad_alloc();  // nothing else can be in the way of bytes in memory
    }
    link::write_output(path, path, bytes);
    return true;
}

}  // namespace fauxboard::tools
