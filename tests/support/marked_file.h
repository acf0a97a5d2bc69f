#pragma once

// Made-up .pws and .photons files, written from the description of the formats, apart from the reader.

#include "tests/support/resin_file.h"

namespace fauxboard::testing {

/// Of a .pws: where things stand.
struct MadePws {
    std::string bytes;
    std::uint32_t info = 0;
    std::uint32_t preview = 0;
    std::uint32_t table = 0;
    std::vector<std::uint32_t> data_begins;
};

/// Kind, version, key, extensions and machine of the wishes do not matter. With `individual` layer n has an
/// exposure of 10 s, lifts by the wished lift plus n, at twice the wished speed.
MadePws make_pws(const ResinFile& wishes, bool individual = false);

/// Of a .photons, whose pictures have one level.
struct MadePhotons {
    std::string bytes;
    std::uint32_t layer_count = 0;  ///< where the number of layers stands
    std::vector<std::uint32_t> heads;
};
MadePhotons make_photons(const ResinFile& wishes);

/// Whether plane `p` has the pixel lit.
bool lit_in_plane(const ResinFile& wishes, std::uint32_t layer, std::uint32_t plane, std::uint32_t x,
                  std::uint32_t y);

}  // namespace fauxboard::testing
