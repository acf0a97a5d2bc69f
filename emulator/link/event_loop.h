#pragma once

// The part of Asio that this project runs on, in one place: Asio's headers, once inlined, raise a false
// -Wnull-dereference in GCC 12 which "system header" does not silence. Include this before any other Asio
// header. A header of the standard library comes first, since Asio looks at what the library has and must see
// the same in every file.

#include <cstddef>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnull-dereference"
#endif

#include <asio/error_code.hpp>
#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/post.hpp>
#include <asio/steady_timer.hpp>

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
