// The bodies of Asio's functions, compiled once for the whole program (ASIO_SEPARATE_COMPILATION) instead of
// in every file that includes Asio.

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wnull-dereference"
#endif

// Before it: Asio looks at what the standard library has, which only one of its headers can tell, and must
// see the same in every file.
#include <cstddef>
//
#include <asio/impl/src.hpp>
