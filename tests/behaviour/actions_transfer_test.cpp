// What the actions of file transfers do on a card that only reads. Whole transfers are tested with the
// boards.

#include "tests/behaviour/action_bench.h"

namespace fauxboard::testing {
namespace {

/// A file that the card has.
string a_file(Bench& b) {
    for (const machine::CardEntry& entry : b.machine.listing()) {
        if (!entry.folder && entry.bytes != 0) {
            return entry.name;
        }
    }
    FAIL("the small profile's card has no file");
    return {};
}

void download(Bench& b) {
    b.run(R"({"transfer.download": {"name": ")" + a_file(b) + R"("}})");
}

}  // namespace

const std::vector<ActionRow>& transfer_action_rows() {
    static const std::vector<ActionRow> rows{
        {"transfer.upload",
         [](Bench& b) {
             b.run(R"({"transfer.upload": {"name": "new.ctb"}})");
             CHECK(b.text("transfer.outcome") == "write_failed");
             CHECK(b.text("transfer.asked") == "new.ctb");
             CHECK(b.text("transfer.mode") == "none");
         }},
        {"transfer.finish",
         [](Bench& b) {
             b.run(R"("transfer.finish")");
             CHECK(b.text("transfer.outcome") == "not_open");
         }},
        {"transfer.remove",
         [](Bench& b) {
             b.run(R"({"transfer.remove": {"name": "missing.ctb"}})");
             CHECK(b.text("transfer.outcome") == "missing");
             b.run(R"({"transfer.remove": {"name": ")" + a_file(b) + R"("}})");
             CHECK(b.text("transfer.outcome") == "missing");  // of a card that can be read only
         }},
        {"transfer.download",
         [](Bench& b) {
             b.run(R"({"transfer.download": {"name": "missing.ctb"}})");
             CHECK(b.text("transfer.outcome") == "missing");
             download(b);
             CHECK(b.text("transfer.outcome") == "done");
             CHECK(b.text("transfer.mode") == "download");
             CHECK(b.number("transfer.bytes") > 0);
         }},
        {"transfer.block",
         [](Bench& b) {
             download(b);
             b.run(R"("transfer.block")");
             CHECK(b.text("transfer.outcome") == "done");
             CHECK(b.machine.transfer.last_block.size == b.number("transfer.bytes"));
             b.run(R"({"transfer.block": {"offset": 1}})");
             CHECK(b.machine.transfer.last_block.size == b.number("transfer.bytes") - 1);
         }},
        {"transfer.close",
         [](Bench& b) {
             download(b);
             b.run(R"("transfer.close")");
             CHECK(b.text("transfer.mode") == "none");
         }},
    };
    return rows;
}

}  // namespace fauxboard::testing
