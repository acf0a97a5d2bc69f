#include "emulator/drawing/png.h"

#include <png.h>

#include <stdexcept>

namespace fauxboard::drawing {

std::string png_bytes(const Picture& picture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    std::string rgb;
    for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
        rgb.append(reinterpret_cast<const char*>(&picture.rgba[i]), 3);
    }
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string out(size, '\0');
    if (png_image_write_to_memory(&image, out.data(), &size, 0, rgb.data(), 0, nullptr) == 0) {
        throw std::runtime_error(std::string("no picture can be made: ") + image.message);
    }
    out.resize(size);
    return out;
}

}  // namespace fauxboard::drawing
