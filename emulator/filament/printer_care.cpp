// What a board sees to by itself: its motors, its fan.

#include "emulator/filament/printer.h"

namespace fauxboard::filament {

/// Motors that nobody needs any more switch themselves off after a while.
void Printer::rest_motors(SimTime now) {
    if (config().motion.idle_off_s <= 0) {
        return;
    }
    if (motors_rest_ <= now) {
        motors_off();
    }
    const bool idle =
        motion.motors() && !motion.busy() && !job.active() && feeder.mode() == Feeder::Mode::idle;
    if (!idle) {
        motors_rest_ = never;
    } else if (motors_rest_ == never) {
        motors_rest_ = now + from_seconds(config().motion.idle_off_s);
    }
}

int Printer::own_fan_percent() const {
    const BoardFanConfig& fan = config().board_fan;
    if (!fan.automatic || now() < power_on_ + from_seconds(fan.starts_s)) {
        return fan.percent;
    }
    const bool busy = job.status() == JobStatus::printing ||
                      thermal.target_c(HeaterId::nozzle) >= fan.nozzle_c ||
                      thermal.target_c(HeaterId::bed) >= fan.bed_c;
    return busy ? fan.busy_percent : fan.idle_percent;
}

int Printer::board_fan_percent() const {
    const int own = own_fan_percent();
    return fan_order_ && fan_order_->instead_of == own ? fan_order_->percent : own;
}

}  // namespace fauxboard::filament
