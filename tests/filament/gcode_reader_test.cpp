#include "emulator/filament/gcode_reader.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "tests/support/sliced_file.h"

using namespace fauxboard::filament;
using fauxboard::testing::MemoryDisk;

namespace {

using Result = GcodeReader::Result;
using Lines = std::vector<std::string>;

Lines read_all(const std::string& content, std::uint64_t from = 0) {
    MemoryDisk disk;
    disk.put("x", content);
    GcodeReader reader;
    reader.open(disk, "x", from);
    Lines lines;
    std::string_view line;
    while (reader.next(line) == Result::line) {
        lines.emplace_back(line);
        REQUIRE(lines.size() < 100'000);
    }
    CHECK(reader.byte() == content.size());
    return lines;
}

}  // namespace

TEST_CASE("reader: lines end in LF, CR LF, CR, or with the file") {
    CHECK(read_all("").empty());
    CHECK(read_all("a\nb\n") == Lines{"a", "b"});
    CHECK(read_all("a\r\nb") == Lines{"a", "b"});
    CHECK(read_all("a\rb\r") == Lines{"a", "b"});
    CHECK(read_all("\n\r\n\r") == Lines{"", "", ""});
    CHECK(read_all(std::string("a\0b\n", 4)) == Lines{std::string("a\0b", 3)});
}

TEST_CASE("reader: whatever the pieces cut, the lines come whole") {
    std::string content;
    Lines expected;
    for (int i = 0; content.size() < 5 * GcodeReader::piece_bytes; ++i) {
        expected.push_back("G1 X" + std::to_string(i) + std::string(static_cast<std::size_t>(i % 97), 'x'));
        content += expected.back() + (i % 3 == 0 ? "\r\n" : "\n");
    }
    CHECK(read_all(content) == expected);
    // A CR LF of which the pieces' border cuts the LF off.
    const std::string filler(GcodeReader::piece_bytes - 11, 'f');
    CHECK(read_all(filler + "\n123456789\r\nlast") ==
          Lines{filler.substr(0, GcodeReader::max_line_bytes), "123456789", "last"});
}

TEST_CASE("reader: of a line without end its beginning is given once") {
    const std::string huge(10 * GcodeReader::piece_bytes, 'h');
    MemoryDisk disk;
    disk.put("x", huge + "\nG1\n");
    GcodeReader reader;
    reader.open(disk, "x");
    std::string_view line;
    REQUIRE(reader.next(line) == Result::line);
    CHECK(line == huge.substr(0, GcodeReader::max_line_bytes));
    CHECK(reader.lines_cut() == 1);
    // The rest is passed over, a bounded piece with each call.
    Result result = reader.next(line);
    std::size_t pieces = 0;
    for (; result == Result::passing_over; result = reader.next(line)) {
        ++pieces;
    }
    CHECK(pieces >= 8);
    CHECK(pieces <= 10);
    REQUIRE(result == Result::line);
    CHECK(line == "G1");
    CHECK(reader.next(line) == Result::end);
    CHECK(reader.next(line) == Result::end);
}

TEST_CASE("reader: begun in the middle of a line it goes on behind that line") {
    const std::string content = "G28\nG1 X10\r\nG1 X20\n";
    CHECK(read_all(content, 0).size() == 3);
    CHECK(read_all(content, 4) == Lines{"G1 X10", "G1 X20"});  // exactly at its beginning
    CHECK(read_all(content, 5) == Lines{"G1 X20"});
    CHECK(read_all(content, 11) == Lines{"G1 X20"});  // between CR and LF
    CHECK(read_all(content, 12) == Lines{"G1 X20"});
    CHECK(read_all(content, content.size()).empty());
}

TEST_CASE("reader: byte() is where the next line begins") {
    MemoryDisk disk;
    disk.put("x", "one\ntwo\r\nthree");
    GcodeReader reader;
    reader.open(disk, "x");
    std::string_view line;
    for (const std::uint64_t byte : {4U, 9U, 14U}) {
        REQUIRE(reader.next(line) == Result::line);
        CHECK(reader.byte() == byte);
    }
}

TEST_CASE("reader: byte() is the place it was opened at until the first line is read") {
    MemoryDisk disk;
    disk.put("x", "one\ntwo\nthree\n");
    for (const std::uint64_t from : {0U, 1U, 4U, 6U, 14U}) {
        CAPTURE(from);
        GcodeReader reader;
        reader.open(disk, "x", from);
        CHECK(reader.byte() == from);
        std::string_view line;
        reader.next(line);
        CHECK(reader.byte() > std::min<std::uint64_t>(from, 13));
    }
}

TEST_CASE("reader: a file that cannot be read fails, and goes on where it stood when it can") {
    MemoryDisk disk;
    disk.put("x", "one\ntwo\n");
    GcodeReader reader;
    reader.open(disk, "x");
    std::string_view line;
    disk.set_failing(true);
    CHECK(reader.next(line) == Result::failed);
    CHECK(reader.next(line) == Result::failed);
    disk.set_failing(false);
    REQUIRE(reader.next(line) == Result::line);
    CHECK(line == "one");
    GcodeReader none;
    CHECK(none.next(line) == Result::end);
    none.open(disk, "missing");
    CHECK(none.next(line) == Result::failed);
}

TEST_CASE("reader: half a gigabyte starts at once and is read once, piece by piece") {
    constexpr std::uint64_t bytes = 500'000'000;
    MemoryDisk disk;
    disk.put("x", bytes, [](std::uint64_t offset, std::span<char> out) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = (offset + i) % 25 == 24 ? '\n' : 'G';
        }
    });
    GcodeReader reader;
    reader.open(disk, "x");
    std::string_view line;
    REQUIRE(reader.next(line) == Result::line);
    CHECK(disk.bytes_read <= GcodeReader::piece_bytes);
    reader.open(disk, "x", bytes - 40);
    REQUIRE(reader.next(line) == Result::line);
    CHECK(line.size() == 24);
    CHECK(reader.next(line) == Result::end);
    CHECK(disk.bytes_read <= 2 * GcodeReader::piece_bytes);
}

namespace {

/// A file without a single line end, as large as they come, that counts what is read of it.
struct EndlessLine final : Volume {
    static constexpr std::uint64_t bytes = 50'000'000'000;
    mutable std::uint64_t read_bytes = 0;
    bool list(std::string_view, std::vector<fauxboard::machine::CardEntry>&) const override { return true; }
    Kind look(std::string_view, std::uint64_t& size) const override {
        size = bytes;
        return Kind::file;
    }
    std::optional<std::size_t> read(std::string_view, std::uint64_t offset,
                                    std::span<char> out) const override {
        const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), bytes - offset));
        std::fill_n(out.begin(), size, 'x');
        read_bytes += size;
        return size;
    }
};

}  // namespace

TEST_CASE("reader: what a call reads is bounded, however long a line is; it gets to its end all the same") {
    const EndlessLine disk;
    GcodeReader reader;
    reader.open(disk, "x", EndlessLine::bytes - 10'000'000);
    std::string_view line;
    int calls = 0;
    Result result = Result::line;
    std::uint64_t place = 0;
    while ((result = reader.next(line)) == Result::passing_over) {
        CHECK(disk.read_bytes <= 2 * GcodeReader::piece_bytes);
        CHECK(reader.byte() > place);
        place = reader.byte();
        disk.read_bytes = 0;
        ++calls;
    }
    CHECK(result == Result::end);
    CHECK(calls > 100);
}
