#include "emulator/link/pending_bytes.h"

#include <doctest/doctest.h>

using fauxboard::link::PendingBytes;

TEST_CASE("pending bytes keep order and know how many messages are left") {
    PendingBytes pending;
    CHECK(pending.push("abc", 10));
    CHECK(pending.push("def", 10));
    CHECK_FALSE(pending.push("12345", 10));
    CHECK(pending.view() == "abcdef");
    pending.consume(4);
    CHECK(pending.view() == "ef");
    CHECK(pending.push("12345678", 10));
    CHECK(pending.view() == "ef12345678");
    const PendingBytes::Dropped dropped = pending.clear();
    CHECK(dropped.bytes == 10);
    CHECK(dropped.messages == 2);
    CHECK(pending.empty());
}

TEST_CASE("a message that just fits is kept, one byte more is not") {
    PendingBytes pending;
    CHECK_FALSE(pending.push("12345", 4));
    CHECK(pending.push("1234", 4));
    CHECK_FALSE(pending.push("5", 4));
    pending.consume(100);
    CHECK(pending.empty());
    CHECK(pending.clear().messages == 0);
}
