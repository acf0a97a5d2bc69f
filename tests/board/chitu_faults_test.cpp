// Everything that is known to go wrong with ChiTu boards, on demand: each of the table's faults that this
// family is known for, with what a client sees, and the way back.

#include <doctest/doctest.h>

#include <algorithm>

#include "protocol/chitu_chunk.h"
#include "tests/support/chitu.h"
#include "tests/support/resin_bench.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

using Texts = std::vector<std::string>;

const std::string position = "ok C: X:0.000000 Y:0.000000 Z:0.000000 E:0.000000\r\n";

}  // namespace

TEST_CASE("chitu faults: stray ok N: lines come before or behind the answer, as often as asked for") {
    ResinBench bench;
    bench.fault("stray_ok:to_screen,number=80,count=2");
    CHECK(bench.ask("M114") == "ok N:80\r\n" + position);
    CHECK(bench.ask("M114") == "ok N:80\r\n" + position);
    CHECK(bench.ask("M114") == position);
    bench.fault("stray_ok:to_screen,number=160,where=after");
    CHECK(bench.ask("M114") == position + "ok N:160\r\n");
    bench.clear_faults();
    CHECK(bench.ask("M114") == position);
}

TEST_CASE("chitu faults: runs of NUL, before an answer and within a request") {
    ResinBench bench;
    bench.fault("nul_burst:to_screen,bytes=200");
    CHECK(bench.ask("M114") == std::string(200, '\0') + position);
    bench.clear_faults();
    bench.fault("nul_burst:to_board,bytes=30,where=inside");
    CHECK(bench.ask("M114") == position);
    CHECK(bench.board.nul_bytes() >= 30);
}

TEST_CASE("chitu faults: late and slow answers") {
    ResinBench bench;
    bench.fault("delay:to_screen,time=300ms,count=1");
    CHECK(bench.ask("M114", 0.29) == "");
    CHECK(bench.say("", 0.05) == position);
    bench.clear_faults();
    bench.fault("slow:to_screen,rate=100B/s");
    const std::string part = bench.ask("M114", 0.25);
    CHECK(!part.empty());
    CHECK(part.size() < position.size());
    CHECK(position.starts_with(part));
    CHECK(part + bench.say("", 1) == position);
}

TEST_CASE("chitu faults: doubled and missing answers, garbled ones, silence") {
    ResinBench bench;
    bench.fault("duplicate:to_screen,count=1");
    CHECK(bench.ask("M114") == position + position);
    bench.clear_faults();
    bench.fault("drop:to_screen,count=1");
    CHECK(bench.ask("M114") == "");
    CHECK(bench.ask("M114") == position);
    bench.clear_faults();
    bench.fault("drop:to_board,count=1");
    CHECK(bench.ask("M114") == "");
    bench.clear_faults();
    bench.fault("garble:to_screen,bytes=2,count=1");
    const std::string spoiled = bench.ask("M114");
    CHECK(spoiled.size() == position.size());
    CHECK(spoiled != position);
    bench.clear_faults();
    bench.fault("silence:for=2s");
    CHECK(bench.ask("M114") == "");
    bench.run_for(2);
    CHECK(bench.ask("M114") == position);
}

TEST_CASE("chitu faults: a stick that is gone or dead is no disk, until it is back and read") {
    for (const char* spec : {"card_removed", "card_failed"}) {
        CAPTURE(spec);
        ResinBench bench;
        put_seed_stick(bench.disk);
        bench.fault(spec);
        const std::string name = seed_file;
        CHECK(bench.ask("M23 " + name) == "//Disk init fail!\r\nok N:0\r\n");
        CHECK(bench.ask("M6030 '" + name + "'") ==
              "Error:File is not existed or empty, file /" + name + "\r\nok N:0\r\n");
        CHECK(bench.ask("M28 a.ctb") == "//Disk init fail!\r\nok N:0\r\n");
        CHECK(bench.ask("M8512 a.gcode") == "//Disk init fail!\r\nok N:0\r\n");
        bench.clear_faults();
        CHECK(bench.ask("M23 " + name) == "//Disk init fail!\r\nok N:0\r\n");  // not seen yet
        CHECK(bench.say("", 3) == "USB disk_ok\r\nok\r\n");
        CHECK(bench.ask("M23 " + name).starts_with("File opened:" + name));
    }
}

TEST_CASE("chitu faults: files that are not there when they are asked for, or cannot be read") {
    for (const char* spec : {"file_missing", "file_unreadable"}) {
        CAPTURE(spec);
        ResinBench bench;
        put_seed_stick(bench.disk);
        bench.fault(spec);
        const std::string name = seed_file;
        CHECK(bench.ask("M20").find(name) != std::string::npos);  // still listed
        CHECK(bench.ask("M6030 '" + name + "'") ==
              "Error:File is not existed or empty, file /" + name + "\r\nok N:0\r\n");
        CHECK(bench.ask("M23 " + name) == "//############Error!cann't open file " + name +
                                              "!\r\nopen failed, File :" + name + "\r\nok N:0\r\n");
        bench.clear_faults();
        CHECK(bench.ask("M6030 '" + name + "'") == "ok N:0\r\n");
    }
}

TEST_CASE("chitu faults: a print whose file cannot be read on stops at its layer, and goes on later") {
    ResinBench bench;
    put_seed_stick(bench.disk);
    bench.ask(std::string("M6030 '") + seed_file + "'");
    REQUIRE(bench.reaches("job.layer", 1));
    bench.fault("file_unreadable");
    CHECK(bench.say("", 60) == "//Disk init fail!\r\n");
    CHECK(bench.number("job.status") == 2);
    bench.clear_faults();
    CHECK(bench.ask("M24") == "ok N:0\r\n");
    CHECK(bench.reaches("job.layer", 3));
}

TEST_CASE("chitu faults: lost pieces are not answered, lost answers leave the piece written") {
    ResinBench bench;
    bench.send("M28 a.ctb");
    bench.fault("chunk_lost:what=piece,share=100");
    CHECK(bench.send(chunk(0, "abc")) == Texts{});
    CHECK(bench.number("transfer.position") == 0);
    CHECK(bench.send("M4012 I1 T3") == Texts{"ok 0/0\r\n"});  // requests get through
    bench.clear_faults();
    bench.fault("chunk_lost:what=answer,share=100");
    CHECK(bench.send(chunk(0, "abc")) == Texts{});
    CHECK(bench.number("transfer.position") == 3);
    bench.clear_faults();
    CHECK(bench.send(chunk(0, "abc")) == Texts{"resend 3\r\n"});
    CHECK(bench.send("M29").front() == "Done saving file!\r\n");
    CHECK(*bench.disk.content("a.ctb") == "abc");
}

TEST_CASE("chitu faults: damaged pieces are asked for again, repeated ones are written once") {
    ResinBench bench("elegoo-saturn");
    bench.send("M28 a.ctb");
    bench.fault("chunk_damaged:share=100");
    CHECK(bench.send(chunk(0, "abc")) == Texts{"resend 1280,offset error:0\r\n"});
    bench.clear_faults();
    bench.fault("chunk_repeated:share=100");
    CHECK(bench.send(chunk(0, "abc")) == Texts{"ok\r\n", "resend 1280,offset error:3\r\n"});
    bench.clear_faults();
    bench.send("M29");
    CHECK(*bench.disk.content("a.ctb") == "abc");
}

TEST_CASE("chitu faults: blocks of a download are lost, damaged, repeated") {
    ResinBench bench;
    bench.disk.put("a.ctb", "abc");
    bench.send("M6032 'a.ctb'");
    bench.fault("chunk_lost:share=100");
    CHECK(bench.send("M3001 I0") == Texts{});
    bench.clear_faults();
    bench.fault("chunk_damaged:share=100");
    const Texts damaged = bench.send("M3001 I0");
    REQUIRE(damaged.size() == 1);
    CHECK(protocol::read_chunk(damaged[0]).fault == protocol::ChunkFault::checksum);
    bench.clear_faults();
    bench.fault("chunk_repeated:share=100");
    CHECK(bench.send("M3001 I0") == Texts{chunk(0, "abc"), chunk(0, "abc")});
}

TEST_CASE("chitu faults: a file goes both ways through all of them at once, the same; the same each time") {
    std::vector<std::uint64_t> lines;
    for (int round = 0; round < 2; ++round) {
        ResinBench bench;
        for (const char* spec : {"chunk_lost:what=piece,share=10", "chunk_lost:what=answer,share=10",
                                 "chunk_damaged:share=10", "chunk_repeated:share=10"}) {
            bench.fault(spec);
        }
        CHECK(bench.number("faults.chunk_damaged") == 1);
        TransferClient client = bench.client();
        constexpr std::uint64_t size = 400'001;
        CHECK(client.upload("a.ctb", size, pattern) == "");
        CHECK(*bench.disk.content("a.ctb") == pattern(0, size));
        std::string back;
        CHECK(client.download("a.ctb", size, [&](std::string_view bytes) { back += bytes; }) == "");
        CHECK(back == pattern(0, size));
        lines.push_back(bench.board.counters().lines_sent);
    }
    CHECK(lines[0] == lines[1]);
    CHECK(lines[0] > 2 * 313 + 60);
}
