// Reading a file takes work that grows as the file does: counted, and not measured by a clock.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/link/helpers.h"

namespace fauxboard::calls {
namespace {

using link::test::TemporaryFolder;

constexpr std::size_t few = 400;
constexpr std::size_t many = 4 * few;
/// Of what `few` cost: three times for the others, somewhat more where things are sorted. Were each looked
/// for among all before it, fifteen times.
constexpr double most = 5;

/// A file of `n` like things.
struct Sort {
    const char* what;
    const char* name;  ///< of the file
    std::string_view head;
    std::string_view thing;  ///< {0} is its number, from 10000
    std::string_view between;
    std::string_view tail;
    std::vector<std::string> command;  ///< the file behind it
};

const std::vector<std::string> check{"check"};
const std::vector<std::string> briefly{"run", "-q", "--speed", "max", "--duration", "1s", "--profile"};

const std::array sorts{
    Sort{"frames of a profile", "a.json", R"({"name": "a", "extends": "geeetech-a30t", "frames": {)",
         R"("L14.{0}": "L14 P{0} {{heaters.nozzle.target:.1f}}")", ",\n", "}}", briefly},
    Sort{"requests of a profile", "a.json", R"({"name": "a", "extends": "geeetech-a30t", "requests": {)",
         R"("M{0}": {{"send": ["L2"]}})", ",\n", "}}", briefly},
    Sort{"wrong keys of a profile", "a.json", R"({"name": "a", "extends": "geeetech-a30t", )",
         R"("k{0}": [1, {{"a": 2}}])", ",\n", "}", briefly},
    Sort{"wrong frames", "a.json", R"({"name": "a", "extends": "geeetech-a30t", "frames": {)",
         R"("L14.{0}": "L14 {{heaters.nozzle.q{0}}}")", ",\n", "}}", check},
    Sort{"steps of a scenario", "a.json",
         R"({"name": "a", "profile": "geeetech-a30t", "steps": [{"wait": "1s"}, )",
         R"({{"request": "M{0}"}})", ",\n", "]}", check},
    Sort{"boards of a fleet",
         "a.json",
         R"({"boards": [)",
         R"({{"profile": "mks-dlp", "name": "n{0}", "x": 1}})",
         ",\n",
         "]}",
         {"fleet"}},
    Sort{"lines of a recording",
         "a.jsonl",
         "",
         R"({{"t": {0}, "from": "screen", "line": "N-0 M105*10"}})",
         "\n",
         "\n",
         {"replay"}},
    Sort{"lines to be told of", "a.log", "", "M{0} S1", "\n", "\n", {"decode"}},
};

std::string made(const Sort& sort, std::size_t n) {
    std::string text(sort.head);
    for (std::size_t i = 0; i < n; ++i) {
        text += (i == 0 ? "" : sort.between);
        text += fmt::format(fmt::runtime(sort.thing), 10000 + i);
    }
    return text + std::string(sort.tail);
}

/// What the program does with such a file, in comparisons and pieces of memory.
double work(const Sort& sort, std::size_t n) {
    const TemporaryFolder folder;
    std::ofstream(folder.file(sort.name), std::ios::binary) << made(sort, n);
    std::vector<std::string> args{FAUXBOARD_PROGRAM};
    args.insert(args.end(), sort.command.begin(), sort.command.end());
    args.push_back(folder.file(sort.name));
    const pid_t pid = ::fork();
    if (pid == 0) {
        std::vector<char*> words;
        for (std::string& arg : args) {
            words.push_back(arg.data());
        }
        words.push_back(nullptr);
        ::setenv("LD_PRELOAD", FAUXBOARD_COUNTED_WORK, 1);
        ::setenv("COUNT_FILE", folder.file("count").c_str(), 1);
        const int nowhere = ::open("/dev/null", O_RDWR);
        for (const int fd : {0, 1, 2}) {
            ::dup2(nowhere, fd);
        }
        ::execv(words[0], words.data());
        ::_exit(127);
    }
    int status = 0;
    REQUIRE(::waitpid(pid, &status, 0) == pid);
    REQUIRE(WIFEXITED(status));
    double count = 0;
    std::ifstream(folder.file("count")) >> count;
    REQUIRE(count > 0);
    return count;
}

TEST_CASE("reading a file is work that grows as the file, whatever is many in it") {
    for (const Sort& sort : sorts) {
        CAPTURE(std::string(sort.what));
        const double none = work(sort, 1);
        const double some = work(sort, few) - none;
        const double more = work(sort, many) - none - some;
        MESSAGE(std::string(sort.what)
                << ": " << some << " for " << few << ", then " << more / some << " times that");
        CHECK(some > few);  // it does look at them
        CHECK(more / some < most);
    }
}

}  // namespace
}  // namespace fauxboard::calls
