// Every code of a ChiTu board over a real pseudo-terminal: the vectors that the board passes in virtual time.

#include <fstream>
#include <iterator>

#include "tests/e2e/program.h"
#include "tests/e2e/raw_peer.h"
#include "tests/support/chitu.h"

namespace fauxboard::e2e {
namespace {

using testing::ChituVector;
using testing::ChituVectors;

/// A question that no vector asks, and its answer: what came before is what came of the question before.
constexpr const char* last_question = "M5002\r\n";
constexpr const char* last_answer = "0x350041 0x4d485001 0x20393150\r\n";

std::string read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void check_vector(const std::string& profile, const ChituVector& vector) {
    CAPTURE(vector.name);
    TemporaryFolder folder;
    testing::make_seed_stick(folder.file(""));
    TemporaryFolder outside;
    const std::string control = outside.file("control");
    Program program({"run", "-q", "--profile", profile, "--sd", folder.file(""), "--control", control});
    RawPeer peer(program.ready()["path"]);
    const auto settle = [&] {
        peer.say(last_question);
        return peer.until(last_answer);
    };
    settle();  // the boot
    for (const ChituVector::Preparation& step : vector.prepare) {
        peer.say(step.send);
        settle();
        if (step.wait_s > 0.1) {
            REQUIRE(run({"ctl", control, "advance", std::to_string(step.wait_s) + "s"}).code == 0);
            settle();
        }
    }
    peer.say(vector.send);
    CHECK(settle() == vector.reply);
    for (const auto& [name, content] : vector.files) {
        CHECK(read_file(folder.file(name)) == content);
    }
}

/// Those that need nothing beforehand and leave the stick as it is share a board, which is restarted after
/// each.
bool plain(const ChituVector& vector) {
    return vector.prepare.empty() && vector.files.empty() && !vector.send.starts_with("M30 ") &&
           !vector.send.starts_with("M8093");
}

int check_plain(const ChituVectors& file) {
    TemporaryFolder folder;
    testing::make_seed_stick(folder.file(""));
    Program program({"run", "-q", "--profile", file.profile, "--sd", folder.file("")});
    RawPeer peer(program.ready()["path"]);
    const std::string booted = "chitu_initial_file_autorun!\r\n";
    peer.until(booted);
    int sent = 0;
    for (const ChituVector& vector : file.vectors) {
        if (!vector.stick || !plain(vector) || vector.name == "M5002") {
            continue;
        }
        CAPTURE(vector.name);
        peer.say(vector.send + last_question);
        CHECK(peer.until(last_answer) == vector.reply);
        peer.say("M6040 I0\r\n");
        peer.until(booted);
        ++sent;
    }
    return sent;
}

int check_file(std::string_view name) {
    const ChituVectors file = testing::load_chitu_vectors(name);
    int sent = check_plain(file);
    for (const ChituVector& vector : file.vectors) {
        if (vector.stick && !plain(vector)) {
            check_vector(file.profile, vector);
            ++sent;
        }
    }
    return sent;
}

TEST_CASE("every code of a ChiTu board is answered over a pseudo-terminal, byte for byte") {
    CHECK(check_file("chitu") > 90);
}

TEST_CASE("so are those that other ChiTu boards answer otherwise") {
    CHECK(check_file("chitu-photon") > 5);
    CHECK(check_file("chitu-4.4.3") > 5);
    CHECK(check_file("chitu-saturn") > 3);
}

TEST_CASE("a ChiTu board is checked, reached into, recorded, explained and replayed like any other") {
    for (const char* profile :
         {"chitu-base", "elegoo-mars-pro", "elegoo-saturn", "anycubic-photon", "chitu-4.4.3"}) {
        CAPTURE(profile);
        CHECK(run({"check", profile}).code == 0);
    }
    TemporaryFolder folder;
    const std::string control = folder.file("control");
    const std::string record = folder.file("talk.jsonl");
    Program program({"run", "-q", "--profile", "elegoo-mars-pro", "--control", control, "--record", record});
    RawPeer peer(program.ready()["path"]);
    const auto ask = [&](const std::string& line) {
        peer.say(line + "\r\n" + last_question);
        return peer.until(last_answer);
    };
    ask("M4002");
    CHECK(run({"ctl", control, "do", "resin.fan", R"({"value": 100})"}).code == 0);
    CHECK(contains(ask("M4000"), " F:100/0 "));
    CHECK(contains(run({"ctl", control, "get", "resin.led_fan"}).out, "100"));
    CHECK(run({"ctl", control, "set", "config.max_height=9999"}).code != 0);
    CHECK(run({"ctl", control, "world", "card out"}).code == 0);
    CHECK(ask("M23 a.ctb") == "//Disk init fail!\r\nok N:0\r\n");
    CHECK(run({"ctl", control, "send", "position"}).code == 0);
    CHECK(contains(peer.until("E:0.000000\r\n"), "ok C: X:0.000000"));
    CHECK(run({"ctl", control, "fault", "add", "stray_ok:to_screen,number=80"}).code == 0);
    peer.say("M4004\r\n");
    CHECK(peer.until("ok C:0\r\n") == "ok N:80\r\n");
    CHECK(program.stop() == 0);

    const std::string words = run({"decode", record}).out;
    for (const char* word : {"power-on", "version query", "acknowledged: \"V4.3.3_LCDC\"", "no stick",
                             "select file", "status query"}) {
        CAPTURE(word);
        CHECK(contains(words, word));
    }
    const Result replayed = run({"replay", "--profile", "elegoo-mars-pro", record});
    CHECK(replayed.code == 0);
    CHECK(contains(replayed.out, "ok V4.3.3_LCDC"));
}

}  // namespace
}  // namespace fauxboard::e2e
