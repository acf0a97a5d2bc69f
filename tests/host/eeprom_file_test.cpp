#include "emulator/host/eeprom_file.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <csignal>

#include <atomic>
#include <fstream>
#include <sstream>

#include "emulator/link/host_error.h"
#include "tests/link/helpers.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;
using link::test::TemporaryFolder;

std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

void write(const std::string& file, std::string_view text) {
    std::ofstream(file, std::ios::binary) << text;
}

struct Fixture {
    TemporaryFolder folder;
    std::string file = folder.file("eeprom.txt");
    std::vector<std::string> troubles;
    EepromFile::OnTrouble on_trouble = [this](std::string_view text) { troubles.emplace_back(text); };

    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(fs::path(file).parent_path()))
            found.push_back(entry.path().filename().string());
        std::sort(found.begin(), found.end());
        return found;
    }
};

TEST_CASE_FIXTURE(Fixture, "a missing file is a fresh EEPROM, and none is made before something is saved") {
    EepromFile eeprom(file, on_trouble);
    CHECK_FALSE(eeprom.load());
    CHECK(troubles.empty());
    CHECK(names().empty());
}

TEST_CASE_FIXTURE(Fixture, "what was saved is loaded, byte for byte") {
    const std::string image = "a 1\nb \xFFtext with blanks \n";
    CHECK(EepromFile(file, on_trouble).save(image));
    CHECK(EepromFile(file, on_trouble).load() == image);
    CHECK(EepromFile(file, on_trouble).save(""));
    CHECK(EepromFile(file, on_trouble).load() == "");
    CHECK(names() == std::vector<std::string>{"eeprom.txt"});
}

TEST_CASE_FIXTURE(Fixture, "an image of any length, cut anywhere or with any byte changed, is found out") {
    const std::string whole = eeprom_text("settings.steps.x 80\nheaters.nozzle 2.5\n");
    REQUIRE(eeprom_image(whole));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        CAPTURE(i);
        CHECK_FALSE(eeprom_image(std::string_view(whole).substr(0, i)));
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        CHECK_FALSE(eeprom_image(changed));
    }
    CHECK_FALSE(eeprom_image(whole + "\n"));
}

TEST_CASE_FIXTURE(Fixture, "a broken file is put aside, and nothing is lost, also the second time") {
    const std::vector<std::string> broken{"", "fauxboard",
                                          "fauxboard eeprom 2\na 1\nchecksum 0123456789abcdef\n"};
    for (const std::string& text : broken) {
        write(file, text);
        CHECK_FALSE(EepromFile(file, on_trouble).load());
        CHECK_FALSE(fs::exists(file));
    }
    CHECK(troubles.size() == 3);
    CHECK(link::test::contains(troubles[0], "eeprom.txt.broken"));
    CHECK(read(file + ".broken").empty());
    CHECK(read(file + ".broken.2") == broken[1]);
    CHECK(read(file + ".broken.3") == broken[2]);
    EepromFile eeprom(file, on_trouble);
    CHECK(eeprom.save("x 1\n"));
    CHECK(eeprom.load() == "x 1\n");
}

TEST_CASE_FIXTURE(Fixture, "what is not ours is refused, and stays where it is") {
    write(file, "a novel\n");
    const std::string copy = file + ".new-backup";
    write(copy, eeprom_text("a 1\n"));
    CHECK_THROWS_WITH_AS(EepromFile(file, on_trouble), doctest::Contains("is not fauxboard's"),
                         link::HostError);
    CHECK(read(file) == "a novel\n");
    CHECK(read(copy) == eeprom_text("a 1\n"));
    fs::remove(file);
    CHECK(EepromFile(file, on_trouble).save("b 2\n"));
    CHECK(read(copy) == eeprom_text("a 1\n"));
    write(file, std::string(20, '\0'));  // as a power cut may leave it
    CHECK_FALSE(EepromFile(file, on_trouble).load());
    CHECK(read(file + ".broken") == std::string(20, '\0'));
}

TEST_CASE_FIXTURE(Fixture, "the file's mode and a symlink to it survive saving") {
    write(file, eeprom_text("a 1\n"));
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    const std::string name = folder.file("name");
    fs::create_symlink(file, name);
    CHECK(EepromFile(name, on_trouble).save("a 2\n"));
    CHECK(fs::is_symlink(name));
    CHECK(eeprom_image(read(file)) == "a 2\n");
    CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE_FIXTURE(Fixture, "places that cannot hold it are refused at the start") {
    const std::string pipe = folder.file("pipe");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    for (const std::string& bad : {folder.file("missing/eeprom"), pipe, folder.file(""),
                                   std::string("/dev/null"), std::string("/proc/eeprom")}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(EepromFile(bad, on_trouble), link::HostError);
    }
}

TEST_CASE_FIXTURE(Fixture, "a folder that vanishes fails the save and says so; the board lives on") {
    fs::create_directory(folder.file("in"));
    EepromFile eeprom(folder.file("in/eeprom"), on_trouble);
    fs::remove(folder.file("in"));
    CHECK_FALSE(eeprom.save("a 1\n"));
    REQUIRE(troubles.size() == 1);
    CHECK(link::test::contains(troubles[0], "could not be saved"));
}

/// Saves without end, from image number 1 on; a byte on `told` after each.
[[noreturn]] void save_until_killed(const std::string& file, int told) {
    EepromFile eeprom(file, [](std::string_view) { ::_exit(1); });
    for (int i = 1;; ++i) {
        std::string image = "number " + std::to_string(i) + "\n";
        image.append(static_cast<std::size_t>(i % 50) * 997, 'x');
        if (!eeprom.save(image) || ::write(told, "", 1) != 1) {
            ::_exit(1);
        }
    }
}

TEST_CASE_FIXTURE(Fixture, "killed at any moment of saving, the file is whole") {
    for (int round = 0; round < 40; ++round) {
        std::array<int, 2> pipe{};
        REQUIRE(::pipe(pipe.data()) == 0);
        const pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            save_until_killed(file, pipe[1]);
        }
        ::close(pipe[1]);
        // The kill comes after some saves, and somewhere in the middle of the next: the spinning shifts it.
        char byte = 0;
        for (int i = 0; i <= round % 5; ++i)
            REQUIRE(::read(pipe[0], &byte, 1) == 1);
        for (int spin = 0; spin < round * 5000; ++spin)
            std::atomic_signal_fence(std::memory_order_seq_cst);
        REQUIRE(::kill(child, SIGKILL) == 0);
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        REQUIRE(WIFSIGNALED(status));
        ::close(pipe[0]);
        const auto image = eeprom_image(read(file));
        REQUIRE(image);
        CHECK(image->starts_with("number "));
    }
    EepromFile eeprom(file, on_trouble);  // sweeps
    CHECK(eeprom.load());
    CHECK(troubles.empty());
    CHECK(names() == std::vector<std::string>{"eeprom.txt"});
}

}  // namespace
}  // namespace fauxboard::host
