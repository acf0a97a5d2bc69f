#include "emulator/host/eeprom_cells_file.h"

#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "emulator/link/host_error.h"
#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

struct Chip {
    link::test::TemporaryFolder folder;
    std::string file = folder.file("chip");
    std::vector<std::string> troubles;
    EepromCellsFile cells{file, 2048, [this](std::string_view text) { troubles.emplace_back(text); }};
};

TEST_CASE("a cell that cannot be written is told of once, until one can be again") {
    Chip chip;
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto old = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    chip.cells.store(1500, "a");
    chip.cells.store(1501, "b");
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, old);
    REQUIRE(chip.troubles.size() == 1);
    CHECK(chip.troubles[0].find("could not be saved") != std::string::npos);
    chip.cells.store(1500, "a");
    CHECK(chip.troubles.size() == 1);
    const auto bytes = chip.cells.load();
    REQUIRE(bytes);
    CHECK(bytes->substr(1500, 2) == "a\xFF");
}

TEST_CASE("a chip has one board; a file of another size is no chip") {
    Chip chip;
    CHECK_THROWS_WITH_AS(EepromCellsFile(chip.file, 2048, {}),
                         doctest::Contains("in use by a board that runs"), link::HostError);
    std::filesystem::resize_file(chip.file, 100);
    CHECK_THROWS_WITH_AS(EepromCellsFile(chip.file, 2048, {}), doctest::Contains("has 2048 bytes"),
                         link::HostError);
}

}  // namespace
}  // namespace fauxboard::host
