#pragma once

#include <cstdint>
#include <span>

namespace fauxboard::sliced {

/// What .ctb lays over the pictures: each word XORed with a row of numbers made from the file's key and the
/// layer. The same way in and out; apply() goes on where it stopped.
class Cipher {
  public:
    Cipher() = default;  ///< key 0: leaves all as it is
    Cipher(std::uint32_t key, std::uint32_t layer)
        : on_(key != 0),
          step_(key * 0x2D83'CDAC + 0xD8A8'3423),
          word_((layer * 0x1E15'30CD + 0xEC3D'47CD) * step_) {}

    void apply(std::span<char> bytes) {
        for (char& byte : bytes) {
            if (!on_) {
                return;
            }
            byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (word_ >> (8 * phase_) & 0xFF));
            phase_ = (phase_ + 1) % 4;
            if (phase_ == 0) word_ += step_;
        }
    }

  private:
    bool on_ = false;
    std::uint32_t step_ = 0;
    std::uint32_t word_ = 0;
    std::uint32_t phase_ = 0;  ///< bytes of word_ that are used up
};

}  // namespace fauxboard::sliced
