#include "emulator/link/output_file.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "emulator/link/host_error.h"
#include "emulator/link/waiting_file.h"
#include "helpers.h"

using namespace fauxboard::link;
using namespace fauxboard::link::test;

namespace {

std::string content(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// As long as it lives no file is longer than that.
class Limit {
  public:
    explicit Limit(rlim_t bytes) : old_(std::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &before_) == 0);
        const rlimit small{bytes, before_.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    }
    ~Limit() {
        (void)::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, old_);
    }
    Limit(const Limit&) = delete;
    Limit& operator=(const Limit&) = delete;

  private:
    rlimit before_{};
    sighandler_t old_;
};

}  // namespace

TEST_CASE("output: a file is emptied, and grows by whole pieces") {
    const TemporaryFolder folder;
    const std::string file = folder.file("out");
    write_output(file, file, "what was there before");
    OutputFile out(file, file);
    CHECK(out.append("one\n").empty());
    CHECK(content(file) == "one\n");
    const Limit limit(6);
    CHECK(contains(out.append("two\n"), "File too large"));
    CHECK(content(file) == "one\n");  // no half piece
    CHECK(out.over());
    CHECK(out.append("three\n").empty());  // told once
    CHECK(out.pieces() == 1);
}

TEST_CASE("output: of a whole file for which there is no room nothing is left") {
    const TemporaryFolder folder;
    const std::string file = folder.file("report");
    const Limit limit(10);
    CHECK_THROWS_WITH_AS(write_output(file, "The report", "more than ten bytes"),
                         doctest::Contains("The report cannot be written (File too large)"), HostError);
    CHECK(std::filesystem::is_empty(folder.file("")));
}

TEST_CASE("output: a whole file has its name when it is whole; what had it before stays until then") {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const std::string file = folder.file("report");
    write_output(file, "The report", "before");
    fs::create_symlink("report", folder.file("link"));
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    {
        const Limit limit(10);
        CHECK_THROWS_AS(write_output(file, "The report", "more than ten bytes"), HostError);
    }
    CHECK(content(file) == "before");
    write_output(folder.file("link"), "The report", "after");
    CHECK(content(file) == "after");
    CHECK(fs::is_symlink(folder.file("link")));
    CHECK((fs::status(file).permissions() & fs::perms::others_all) == fs::perms::none);
    CHECK_THROWS_WITH_AS(write_output(folder.file("none/report"), "It", "x"),
                         doctest::Contains("No such file"), HostError);
    const OutputFile other(folder.file("taken"), "It");
    CHECK_THROWS_WITH_AS(write_output(folder.file("taken"), "It", "x"),
                         doctest::Contains("is being written by another"), HostError);
    CHECK(std::distance(fs::directory_iterator(folder.file("")), {}) == 3);
}

TEST_CASE("output: two do not write one file, but into one device") {
    const TemporaryFolder folder;
    const std::string file = folder.file("out");
    {
        const OutputFile first(file, file);
        CHECK_THROWS_WITH_AS(OutputFile(file, "It"), doctest::Contains("It is being written by another"),
                             HostError);
    }
    CHECK_NOTHROW(OutputFile(file, "It"));
    OutputFile one("/dev/null", "It");
    OutputFile two("/dev/null", "It");
    CHECK(one.append("x").empty());
    CHECK(two.append("x").empty());
    CHECK_THROWS_AS(OutputFile(folder.file("none/out"), "It"), HostError);
    CHECK_THROWS_AS(OutputFile(folder.file(""), "It"), HostError);
}

TEST_CASE("output: the reader of a pipe gets all of it, in order, when it comes to it") {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("pipe");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK_THROWS_WITH_AS(OutputFile(pipe, "It"), doctest::Contains("a pipe that nobody reads"), HostError);
    const UniqueFd reader(::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    OutputFile out(pipe, "It");
    std::string said;
    std::string came;
    for (int i = 0; i < 30'000; ++i) {
        const std::string piece = std::to_string(i) + "\n";
        said += piece;
        REQUIRE(out.append(piece).empty());
        came += i % 9'000 == 0 ? take(reader.get()) : std::string();
    }
    for (std::string more; !(more = take(reader.get())).empty() || came.size() < said.size();) {
        came += more;
        REQUIRE(out.append("").empty());
    }
    CHECK(came == said);
    CHECK(out.finish().empty());
}

TEST_CASE("a file that has its end is never waited for") {
    const TemporaryFolder folder;
    std::ofstream(folder.file("empty")).close();
    REQUIRE(::mkfifo(folder.file("pipe").c_str(), 0600) == 0);
    for (const std::string& file : {folder.file("empty"), folder.file("pipe"), folder.file("none"),
                                    std::string("/proc/self/status"), std::string("/dev/zero")}) {
        CAPTURE(file);
        CHECK_FALSE(must_be_waited_for(file));
    }
}
