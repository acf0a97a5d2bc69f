// Screens of a board's own that are wrong, one way each: wrong_screens.json.

#include "tests/support/wrong_values.h"
#include "tests/touch/bench.h"

namespace fauxboard::testing {

TEST_CASE("mistakes in a board's own screen are told by place, each by one sentence") {
    check_wrong_values("touch/wrong_screens.json", made_up_screen, wrong_with);
}

}  // namespace fauxboard::testing
