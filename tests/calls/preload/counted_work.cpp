// Preloaded into the real program: how often bytes are compared and memory is asked for, which is where the
// work of reading a file goes. The sum stands in the file COUNT_FILE at the end.

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<unsigned long> work{0};

int compare(const void* a, const void* b, std::size_t size) {
    ++work;
    const auto* left = static_cast<const unsigned char*>(a);
    const auto* right = static_cast<const unsigned char*>(b);
    for (std::size_t i = 0; i < size; ++i) {
        if (left[i] != right[i]) {
            return left[i] < right[i] ? -1 : 1;
        }
    }
    return 0;
}

struct AtTheEnd {
    AtTheEnd() = default;
    AtTheEnd(const AtTheEnd&) = delete;
    AtTheEnd& operator=(const AtTheEnd&) = delete;
    ~AtTheEnd() {
        const char* const file = std::getenv("COUNT_FILE");
        const int fd = file == nullptr ? -1 : ::open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (fd >= 0) {
            ::dprintf(fd, "%lu\n", work.load());
            ::close(fd);
        }
    }
} at_the_end;

}  // namespace

extern "C" int memcmp(const void* a, const void* b, std::size_t size) {
    return compare(a, b, size);
}

extern "C" int bcmp(const void* a, const void* b, std::size_t size) {
    return compare(a, b, size);
}

extern "C" void* malloc(std::size_t size) {
    static const auto real = reinterpret_cast<void* (*)(std::size_t)>(::dlsym(RTLD_NEXT, "malloc"));
    ++work;
    return real(size);
}
