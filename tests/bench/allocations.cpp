#include "tests/bench/allocations.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

namespace fauxboard::bench {
namespace {

Allocations counted;  // the benchmarks have one thread

void* take(std::size_t size) {
    void* const memory = std::malloc(size);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    ++counted.calls;
    counted.bytes += size;
    counted.live_bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
    return memory;
}

void give_back(void* memory) {
    if (memory != nullptr) {
        counted.live_bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
        std::free(memory);
    }
}

}  // namespace

const Allocations& allocations() {
    return counted;
}

}  // namespace fauxboard::bench

void* operator new(std::size_t size) {
    return fauxboard::bench::take(size);
}
void* operator new[](std::size_t size) {
    return fauxboard::bench::take(size);
}
void operator delete(void* memory) noexcept {
    fauxboard::bench::give_back(memory);
}
void operator delete[](void* memory) noexcept {
    fauxboard::bench::give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    fauxboard::bench::give_back(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    fauxboard::bench::give_back(memory);
}
