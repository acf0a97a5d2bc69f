#pragma once

#include <cstddef>

namespace fauxboard::behaviour {

/// What was written somewhere. The checksum of a frame is made while its parts are written: to read bytes
/// again just after they were stored one by one keeps a processor waiting longer than all the rest of it
/// takes.
struct Written {
    std::size_t size = 0;  ///< bytes
    unsigned sum = 0;      ///< their XOR

    Written& operator+=(const Written& more) {
        size += more.size;
        sum ^= more.sum;
        return *this;
    }
};

}  // namespace fauxboard::behaviour
