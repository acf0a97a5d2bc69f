#include "emulator/link/reopening_link.h"

namespace fauxboard::link {

void ReopeningLink::on_end(const std::string& why) {
    detach();
    release_device();
    go_waiting(lost_sentence(why));
    retry_later();
}

void ReopeningLink::retry_later() {
    timer_.after(retry_period);
}

// A failed try says nothing: the listener has been told that the port is gone.
void ReopeningLink::try_again() {
    try {
        open_device();
    } catch (const LinkError&) {
        detach();
        release_device();
        retry_later();
    }
}

void ReopeningLink::close_device() {
    timer_.cancel();
    release_device();
}

}  // namespace fauxboard::link
