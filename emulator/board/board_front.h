#pragma once

#include "emulator/board/board.h"

namespace fauxboard::board {

/// The built-in front, if there is one, acts on the machine.
template <class Call>
void Board::call_front(Call&& call) {
    if (options_.front == nullptr) {
        return;
    }
    behaviour::ActionContext context{*machine_, variables_, *this};
    call(*options_.front, context);
    if (context.reset) {
        power_on(time_);
    }
}

}  // namespace fauxboard::board
