#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include "protocol/framing.h"

using namespace fauxboard::protocol;
using namespace std::string_literals;

namespace {

using Lines = std::vector<std::string>;

Lines feed(LineSplitter& splitter, std::string_view bytes) {
    Lines lines;
    splitter.feed(bytes, [&](std::string_view line) { lines.emplace_back(line); });
    return lines;
}

/// What the splitter must do, the slow and plain way.
Lines by_the_book(std::string_view bytes, std::uint64_t& too_long, std::uint64_t& nuls) {
    Lines lines;
    std::string line;
    const auto over = [&] { return line.size() > max_line_bytes; };
    for (const char byte : bytes) {
        if (byte == '\0') {
            ++nuls;
        } else if (byte == '\r' || byte == '\n') {
            if (over()) {
                ++too_long;
            } else if (!line.empty()) {
                lines.push_back(line);
            }
            line.clear();
        } else {
            line += byte;
        }
    }
    if (over()) ++too_long;
    return lines;
}

}  // namespace

TEST_CASE("CR, LF and CR LF end a line, empty lines are skipped") {
    LineSplitter splitter;
    CHECK(feed(splitter, "a\rb\nc\r\n\r\n\n\rd\n") == Lines{"a", "b", "c", "d"});
    CHECK_FALSE(splitter.in_line());
    CHECK(feed(splitter, "half").empty());
    CHECK(splitter.in_line());
    CHECK(feed(splitter, " a line\n") == Lines{"half a line"});
    CHECK_FALSE(splitter.in_line());
}

TEST_CASE("a whole line is passed as a view, without a copy") {
    LineSplitter splitter;
    const std::string bytes = "N-0 G28*62\r\nN-0 M105*10\r\n";
    std::size_t inside = 0;
    splitter.feed(bytes, [&](std::string_view line) {
        if (line.data() >= bytes.data() && line.data() < bytes.data() + bytes.size()) ++inside;
    });
    CHECK(inside == 2);
}

TEST_CASE("NULs are counted and dropped wherever they stand") {
    LineSplitter splitter;
    CHECK(feed(splitter, "log A30 LCD OK\r\n\0M1\0"s) == Lines{"log A30 LCD OK"});
    CHECK(feed(splitter, "0\0005\0\r\n\0\0\n"s) == Lines{"M105"});
    CHECK(splitter.nuls() == 6);
    CHECK_FALSE(splitter.in_line());
}

TEST_CASE("bytes above 126 pass") {
    LineSplitter splitter;
    CHECK(feed(splitter, "SN:\xFF\xFF\x80\x7F;\r\n") == Lines{"SN:\xFF\xFF\x80\x7F;"});
}

TEST_CASE("the longest line is taken, one byte more drops it whole") {
    LineSplitter splitter;
    const std::string longest(max_line_bytes, 'x');
    CHECK(feed(splitter, longest + "\n") == Lines{longest});
    CHECK(feed(splitter, longest).empty());
    CHECK(feed(splitter, "\n") == Lines{longest});
    CHECK(splitter.too_long() == 0);
    CHECK(feed(splitter, longest + "y\nafter\n") == Lines{"after"});
    CHECK(splitter.too_long() == 1);
    CHECK(feed(splitter, longest).empty());
    CHECK(feed(splitter, "y").empty());
    CHECK(splitter.too_long() == 2);
    CHECK(splitter.in_line());
    CHECK(feed(splitter, "z\nafter\n") == Lines{"after"});
    // NULs do not count as length.
    CHECK(feed(splitter, "\0"s + longest + "\0\n"s) == Lines{longest});
    CHECK(splitter.too_long() == 2);
}

TEST_CASE("ten megabytes without a line end are one long line, and hold no memory") {
    LineSplitter splitter;
    const std::string block(1 << 20, 'a');
    for (int i = 0; i < 10; ++i) {
        CHECK(feed(splitter, block).empty());
    }
    CHECK(splitter.too_long() == 1);
    CHECK(feed(splitter, "\r\nG28\r\n") == Lines{"G28"});
    static_assert(sizeof(LineSplitter) < max_line_bytes + 64);
}

TEST_CASE("reset forgets the unfinished line") {
    LineSplitter splitter;
    feed(splitter, "half");
    splitter.reset();
    CHECK_FALSE(splitter.in_line());
    CHECK(feed(splitter, "whole\n") == Lines{"whole"});
    feed(splitter, std::string(600, 'x'));
    splitter.reset();
    CHECK(feed(splitter, "whole\n") == Lines{"whole"});
    CHECK(splitter.too_long() == 1);
}

TEST_CASE("reset from inside the callback") {
    LineSplitter splitter;
    Lines lines;
    const auto take = [&](std::string_view line) {
        splitter.reset();
        lines.emplace_back(line);
    };
    splitter.feed("on", take);
    splitter.feed("e\ntwo\nth", take);
    splitter.feed("ree\n", take);
    CHECK(lines == Lines{"one", "two", "three"});
}

TEST_CASE("plain_run finds the first NUL, CR or LF at every place") {
    for (std::size_t size = 0; size < 40; ++size) {
        std::string bytes(size, '\t');  // below 14, and not one of the three
        CHECK(plain_run(bytes) == size);
        for (std::size_t at = 0; at < size; ++at) {
            for (const char mark : {'\0', '\r', '\n'}) {
                std::string marked = bytes;
                marked[at] = mark;
                marked.back() = '\n';
                REQUIRE(plain_run(marked) == at);
            }
        }
    }
    CHECK(plain_run("\xFF\x80\x8D\x8A\x80\x81\x82\x83\n") == 8);
}

TEST_CASE("property: any split of any stream gives the same lines") {
    std::mt19937 random(42);
    const std::string_view marks("\r\n\0", 3);
    std::size_t lines_seen = 0;
    std::uint64_t long_seen = 0;
    for (int round = 0; round < 300; ++round) {
        std::string stream;
        for (int i = 0; i < 40; ++i) {
            const std::size_t most = random() % 8 == 0 ? 1200 : 30;
            stream += std::string(random() % most, static_cast<char>(random() % 256));
            stream += marks[random() % 3];
        }
        std::uint64_t too_long = 0;
        std::uint64_t nuls = 0;
        const Lines wanted = by_the_book(stream, too_long, nuls);
        LineSplitter splitter;
        Lines got;
        for (std::string_view rest = stream; !rest.empty();) {
            const std::size_t piece =
                std::min<std::size_t>(rest.size(), random() % (round % 3 == 0 ? 4 : 700));
            for (std::string& line : feed(splitter, rest.substr(0, piece))) {
                got.push_back(std::move(line));
            }
            rest.remove_prefix(piece);
        }
        REQUIRE(got == wanted);
        REQUIRE(splitter.too_long() == too_long);
        REQUIRE(splitter.nuls() == nuls);
        lines_seen += got.size();
        long_seen += too_long;
    }
    CHECK(lines_seen > 3000);
    CHECK(long_seen > 300);
}
