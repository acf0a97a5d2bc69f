#include <array>

#include "emulator/fault/kind_rows.h"

namespace fauxboard::fault::rows {
namespace {

enum : std::size_t { bits, bytes };

constexpr std::array<Attribute, 2> attributes{{
    {"bits", AttributeType::integer, 0, 0, 64, "bits flipped; one, if neither bits nor bytes are given"},
    {"bytes", AttributeType::integer, 0, 0, 64, "bytes replaced by others"},
}};

/// Calls act(place) for `wanted` of `places` places, each at most once, in order.
template <class F>
void choose(std::size_t wanted, std::size_t places, Dice& dice, F&& act) {
    for (std::size_t place = 0; place < places && wanted != 0; ++place) {
        if (dice.below(places - place) < wanted) {
            --wanted;
            act(place);
        }
    }
}

void edit(LineEdit& line, const Values& values, Dice& dice) {
    if (!line.first) {
        return;
    }
    const auto spoil = [&line](std::size_t at, std::uint64_t by) {
        line.bytes[at] = static_cast<char>(static_cast<unsigned char>(line.bytes[at]) ^ by);
    };
    // Measured once: what is spoiled may look like a line end.
    const std::size_t size = line.text_size();
    choose(values.count(bytes), size, dice, [&](std::size_t at) { spoil(at, 1 + dice.below(255)); });
    const std::size_t flips = values.count(bits) + values.count(bytes) == 0 ? 1 : values.count(bits);
    choose(flips, size * 8, dice, [&](std::size_t at) { spoil(at / 8, 1U << (at % 8)); });
}

}  // namespace

constinit const Kind garble{.name = "garble",
                            .help = "bits or bytes of the line are changed; its line end stays",
                            .attributes = attributes,
                            .edit = edit};

}  // namespace fauxboard::fault::rows
