// Runs a fuzz target without a fuzzer: every file given, then seeded random changes of them. The same every
// time.
//
// Usage: fuzz_TARGET [--runs N] [--seed N] [--keep FILE] FILE|FOLDER...
// FILE has the last input: after a broken rule, the one that broke it.

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/support.h"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> read_all(const std::vector<fs::path>& paths) {
    std::vector<fs::path> files;
    for (const fs::path& path : paths) {
        if (fs::is_directory(path)) {
            std::copy(fs::directory_iterator(path), fs::directory_iterator(), std::back_inserter(files));
        } else {
            files.push_back(path);
        }
    }
    std::sort(files.begin(), files.end());  // a folder has no order of its own
    std::vector<std::string> inputs;
    std::transform(files.begin(), files.end(), std::back_inserter(inputs), read);
    return inputs;
}

/// Small changes of known inputs: bytes set, taken out, put in, doubled; the end of another input in place of
/// its own.
class Mutator {
  public:
    Mutator(const std::vector<std::string>& inputs, std::uint64_t seed) : inputs_(inputs), random_(seed) {}

    std::string next() {
        std::string bytes = inputs_[below(inputs_.size())];
        for (std::size_t n = 1 + below(4); n != 0; --n) {
            change(bytes);
        }
        return bytes;
    }

  private:
    // Not std::uniform_int_distribution: its numbers differ from library to library.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

    void change(std::string& bytes) {
        const std::size_t at = below(bytes.size() + 1);
        const std::size_t length = std::min(1 + below(16), bytes.size() - at);
        switch (below(5)) {
            case 0:
                if (at < bytes.size()) {
                    bytes[at] = static_cast<char>(below(256));
                }
                break;
            case 1:
                bytes.erase(at, length);
                break;
            case 2:
                bytes.insert(at, 1, static_cast<char>(below(256)));
                break;
            case 3:
                bytes.insert(at, bytes.substr(at, length));
                break;
            default: {
                const std::string& other = inputs_[below(inputs_.size())];
                bytes = bytes.substr(0, at) + other.substr(below(other.size() + 1));
            }
        }
    }

    const std::vector<std::string>& inputs_;
    std::mt19937_64 random_;
};

void run(const std::string& input, const fs::path& keep) {
    if (!keep.empty()) {
        std::ofstream(keep, std::ios::binary) << input;
    }
    // A copy of the exact size on the heap, so that a sanitizer sees a read beyond its end.
    const std::vector<std::uint8_t> bytes(input.begin(), input.end());
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t runs = 0;
    std::uint64_t seed = 1;
    std::vector<fs::path> paths;
    fs::path keep;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        std::uint64_t* const number = word == "--runs" ? &runs : word == "--seed" ? &seed : nullptr;
        if (word == "--keep" && i + 1 < argc) {
            keep = argv[++i];
        } else if (number == nullptr) {
            paths.emplace_back(word);
        } else if (++i < argc) {
            const std::string_view text = argv[i];
            std::from_chars(text.data(), text.data() + text.size(), *number);
        }
    }
    const std::vector<std::string> inputs = read_all(paths);
    if (inputs.empty()) {
        std::fprintf(stderr, "usage: %s [--runs N] [--seed N] [--keep FILE] FILE|FOLDER...\n", argv[0]);
        return 2;
    }
    for (const std::string& input : inputs) {
        run(input, keep);
    }
    Mutator mutator(inputs, seed);
    for (std::uint64_t i = 0; i < runs; ++i) {
        run(mutator.next(), keep);
    }
    std::printf("%zu inputs and %llu changes of them (seed %llu): no rule broken\n", inputs.size(),
                static_cast<unsigned long long>(runs), static_cast<unsigned long long>(seed));
    return 0;
}
