// Files that lie: every field at its extremes, every length of a cut file, pictures that do not fit.

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "tests/sliced/helpers.h"

namespace fauxboard::sliced::test {
namespace {

using Kind = ResinFile::Kind;

ResinFile plain(Kind kind, std::uint32_t version = 3, std::uint32_t level_sets = 1) {
    ResinFile wishes;
    wishes.kind = kind;
    wishes.version = version;
    wishes.level_sets = level_sets;
    wishes.layers = 3;
    return wishes;
}

void check_sentence(const std::string& problem) {
    CHECK(problem.size() > 20);
    CHECK(problem.size() < 400);
    CHECK(problem.back() == '.');
}

/// Reads all of it. What it costs is bounded by the file, whatever the file says of itself.
std::string read_bounded(const std::string& bytes) {
    const MemorySource source(bytes);
    std::string problem = read_all(source);
    CHECK(source.biggest_read <= ByteWindow::buffer_bytes);
    CHECK(source.bytes_read <= 200 * bytes.size());
    if (!problem.empty()) {
        check_sentence(problem);
    }
    return problem;
}

TEST_CASE("sliced, hostile: every word of every record at its extremes is taken or told, within bounds") {
    for (const ResinFile& wishes : {plain(Kind::ctb), plain(Kind::cbddlp, 2, 4)}) {
        const MadeResinFile made = make_resin_file(wishes);
        const auto size = static_cast<std::uint32_t>(made.bytes.size());
        const float inf = std::numeric_limits<float>::infinity();
        std::vector<std::uint32_t> values{0,
                                          1,
                                          2,
                                          0x54,
                                          0x70,
                                          0x7FFF,
                                          size,
                                          size - 1,
                                          size + 1,
                                          0x7FFF'FFFF,
                                          0x8000'0000,
                                          0xFFFF'FFFF,
                                          made.layer_table,
                                          made.ext1,
                                          made.large_preview};
        for (const float value : {inf, -inf, std::nanf(""), -1.0F, 1e30F, 1e-40F}) {
            values.push_back(std::bit_cast<std::uint32_t>(value));
        }
        const auto records = std::to_array<std::pair<std::uint32_t, std::uint32_t>>(
            {{0, 0x70},
             {made.ext1, 60},
             {made.ext2, 76},
             {made.large_preview, 32},
             {made.small_preview, 32},
             {made.layer_table, 36 * wishes.layers * wishes.level_sets},
             {made.data_begins[1] - 84, 84}});
        for (const auto& record : records) {
            for (std::uint32_t at = record.first; at < record.first + record.second; at += 4) {
                for (const std::uint32_t value : values) {
                    std::string bytes = made.bytes;
                    poke(bytes, at, value);
                    read_bounded(bytes);
                }
            }
        }
    }
}

struct Wrong {
    std::size_t at;
    std::uint32_t value;
    std::string_view says;
};

void check_wrong(const MadeResinFile& made, const std::vector<Wrong>& rows) {
    for (const Wrong& row : rows) {
        CAPTURE(row.at);
        CAPTURE(row.value);
        std::string bytes = made.bytes;
        poke(bytes, row.at, row.value);
        const std::string problem = read_bounded(bytes);
        CAPTURE(problem);
        CHECK(problem.find(row.says) != std::string::npos);
    }
}

constexpr std::uint32_t nan_bits = 0x7FC0'0000;
constexpr std::uint32_t minus_one = 0xBF80'0000;

TEST_CASE("sliced, hostile: the header's mistakes are named with their place and what can be") {
    const MadeResinFile made = make_resin_file(plain(Kind::ctb));
    CHECK(read_bounded(made.bytes) == "");
    check_wrong(
        made, {
                  {0x00, 0x12FD'0108, "begins with the bytes 08 01 FD 12 03 00; a .cbddlp or .photon begins"},
                  {0x04, 0, "version of a .ctb (at 0x4) is 0; it can be 1 to 3"},
                  {0x04, 4, "version of a .ctb (at 0x4) is 4; it can be 1 to 3"},
                  {0x08, nan_bits, "bed's size in mm (at 0x8) is nan"},
                  {0x1C, minus_one, "model's height in mm (at 0x1C) is -1; it can be 0 to 10000"},
                  {0x24, 0x7F80'0000, "exposure in seconds (at 0x24) is inf"},
                  {0x34, 0, "width in pixels (at 0x34) is 0"},
                  {0x38, 0xFFFF'FFFF, "height in pixels (at 0x38) is 4294967295"},
                  {0x3C, 0xFFFF'FFF0, "large preview would take bytes 4294967280 to 4294967312"},
                  {0x40, 0x40, "offset of the layer table (at 0x40) is 64; it can be 108"},
                  {0x40, 0xFFFF'FFFF, "layer table would take bytes 4294967295"},
                  {0x44, 0, "number of layers (at 0x44) is 0"},
                  {0x44, 0xFFFF'FFFF, "layer table would take bytes"},
                  {0x54, 0x10, "first extension (bytes 16 to 76) lies over the header"},
                  {0x54, made.layer_table, "lies over the layer table"},
                  {0x58, 59, "size of the first extension (at 0x58) is 59; it can be 60"},
                  {0x68, made.ext1, "second extension"},
                  {0x6C, 0xFFFF'FFFF, "size of the second extension (at 0x6C) is 4294967295"},
                  {made.ext1 + 8, minus_one, "lift in mm"},
                  {made.ext2 + 0x1C, 0, "machine's name (bytes 0 to 11) lies over the header"},
                  {made.ext2 + 0x20, 257, "length of the machine's name"},
                  {made.small_preview, 0, "preview's width in pixels"},
                  {made.small_preview + 8, made.small_preview, "data of a preview"},
                  {made.small_preview + 12, 0xFFFF'FFFF, "data of a preview would take"},
              });
    check_wrong(make_resin_file(plain(Kind::cbddlp, 2)), {{0x5C, 0, ""},  // none said: one
                                                          {0x5C, 17, "is 17; it can be 1 to 16"}});
    std::string wide = made.bytes;
    poke(wide, 0x34, SlicedFile::max_side);
    poke(wide, 0x38, SlicedFile::max_side);
    CHECK(read_bounded(wide).find("at most 134217728") != std::string::npos);
}

TEST_CASE("sliced, hostile: a layer's mistakes") {
    const MadeResinFile made = make_resin_file(plain(Kind::ctb));
    const std::uint32_t record = made.layer_table + 36;
    check_wrong(made,
                {
                    {record, nan_bits, "Layer 1: The layer's place in mm"},
                    {record + 4, minus_one, "Layer 1: The layer's exposure in seconds"},
                    {record + 0x0C, made.layer_table, "lies over the layer table"},
                    {record + 0x0C, 0x70, "lies over the header"},  // with its block, it would begin within
                    {record + 0x0C, 0xFFFF'FFFF, "would take bytes 4294967295"},
                    {record + 0x10, 0, "length of the layer's picture"},
                    {record + 0x10, 0xFFFF'FFFF, "would take bytes"},
                    {record + 0x18, 85, "size of the layer's block"},
                    {made.data_begins[1] - 84 + 0x28, nan_bits, "layer's lift in mm"},
                    {made.data_begins[1] - 84 + 0x38, minus_one, "layer's retract speed"},
                });
}

TEST_CASE("sliced, hostile: a file cut at any byte is told, as is one that shrank while it was read") {
    for (const ResinFile& wishes : {plain(Kind::ctb), plain(Kind::cbddlp, 2, 2)}) {
        const MadeResinFile made = make_resin_file(wishes);
        for (std::size_t size = 0; size < made.bytes.size(); ++size) {
            CAPTURE(size);
            const std::string_view cut = std::string_view(made.bytes).substr(0, size);
            check_sentence(read_bounded(std::string(cut)));
            MemorySource shrunk(cut);
            shrunk.say_size(made.bytes.size());
            check_sentence(read_all(shrunk));
        }
    }
}

TEST_CASE("sliced, hostile: pictures that overflow, fall short, go on or break off") {
    // One layer, 16 x 8, its data replaced: what stands before it says how long it is.
    const auto problem_of = [](Kind kind, std::string_view data) {
        ResinFile wishes = plain(kind, 2);
        wishes.layers = 1;
        wishes.previews = false;
        MadeResinFile made = make_resin_file(wishes);
        made.bytes.resize(made.data_begins[0]);
        made.bytes += data;
        poke(made.bytes, made.layer_table + 0x10, static_cast<std::uint32_t>(data.size()));
        return read_bounded(made.bytes);
    };
    using namespace std::string_view_literals;
    CHECK(problem_of(Kind::cbddlp, "\x7F\x81"sv) == "");
    CHECK(problem_of(Kind::cbddlp, "\x00\x7F\x80\x81"sv) == "");  // runs of nothing are nothing
    CHECK(problem_of(Kind::cbddlp, "\x7F"sv).find("ends at byte 1 with 1 of 128 pixels missing") !=
          std::string::npos);
    CHECK(problem_of(Kind::cbddlp, "\x7F\x02"sv).find("overflows at byte 1 of its data: a run of 2") !=
          std::string::npos);
    CHECK(problem_of(Kind::cbddlp, "\x7F\x01\x01"sv).find("whole at byte 2 of its data, which goes on") !=
          std::string::npos);
    CHECK(problem_of(Kind::ctb, "\xFF\x80\x80"sv) == "");
    CHECK(problem_of(Kind::ctb, "\xFF\x7F"sv).find("1 of 128 pixels missing") != std::string::npos);
    CHECK(problem_of(Kind::ctb, "\xFF\xEF\xFF\xFF\xFF"sv).find("a run of 268435455 pixels") !=
          std::string::npos);
    CHECK(problem_of(Kind::ctb, "\xFF"sv).find("its last run is cut off") != std::string::npos);
    CHECK(problem_of(Kind::ctb, "\xFF\xE0\x00\x00"sv).find("its last run is cut off") != std::string::npos);
    CHECK(problem_of(Kind::ctb, "\xFF\xF0\x00\x00\x00\x80"sv).find("0xF0, which has no meaning") !=
          std::string::npos);
}

TEST_CASE("sliced, hostile: a preview whose copies are none, or too many") {
    const MadeResinFile made = make_resin_file(plain(Kind::ctb));
    const std::uint32_t data = testing::peek(made.bytes, made.large_preview + 8);
    check_wrong(made, {{data, 0x2FFF'0020, "number of copies is 0x2FFF"},
                       {data, 0x3FFF'0020, "overflows at byte 0 of its data: a run of 4096 pixels"}});
    std::string odd = made.bytes;
    poke(odd, made.large_preview + 12, 1U);
    CHECK(read_bounded(odd).find("its last run is cut off") != std::string::npos);
}

/// A file as big as the format allows, of which only the beginning is not zero.
class Hollow final : public ByteSource {
  public:
    explicit Hollow(std::string_view bytes) : begin_(bytes) {}
    std::uint64_t size() const override { return 0xFFFF'FFFF; }
    std::size_t read(std::uint64_t offset, std::span<char> out) const override {
        std::fill(out.begin(), out.end(), '\0');
        begin_.read(offset, out);
        reads_ += 1;
        return out.size();
    }
    int reads() const { return reads_; }

  private:
    MemorySource begin_;
    mutable int reads_ = 0;
};

TEST_CASE("sliced, hostile: a hundred million layers cost no more to open than three") {
    const MadeResinFile made = make_resin_file(plain(Kind::ctb));
    std::string bytes = made.bytes.substr(0, 0x70);
    poke(bytes, 0x3C, 0U);
    poke(bytes, 0x48, 0U);
    poke(bytes, 0x54, 0U);
    poke(bytes, 0x68, 0U);
    poke(bytes, 0x40, 0x70U);
    poke(bytes, 0x44, 119'000'000U);
    const Hollow source(bytes);
    const Outcome<SlicedFile> file = SlicedFile::open(source);
    REQUIRE_MESSAGE(file, file.problem());
    CHECK(source.reads() == 3);  // the beginning, twice, and the header
    const Outcome<Layer> last = file->layer(source, 118'999'999);
    CHECK_FALSE(last);
    CHECK(last.problem().find("Layer 118999999: The offset of the layer's picture") != std::string::npos);
    CHECK_FALSE(file->layer(source, 119'000'000));
    CHECK_FALSE(file->layer(source, 0, 1));
    CHECK_FALSE(file->layer_end(source, 0xFFFF'FFFF));
}

}  // namespace
}  // namespace fauxboard::sliced::test
