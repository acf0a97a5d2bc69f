#include "emulator/host/board_display.h"

#include <fmt/format.h>

#include "emulator/behaviour/lists.h"
#include "emulator/drawing/draw.h"
#include "emulator/drawing/png.h"
#include "emulator/screen/scene.h"

namespace fauxboard::host {

using control::Display;
using control::Json;

namespace {

/// What the machine has to show, as whoever draws wants it.
class MachinePictures final : public drawing::Pictures {
  public:
    explicit MachinePictures(const machine::Machine& machine) : machine_(machine) {}

    bool size(std::string_view name, std::size_t index, std::uint32_t& width,
              std::uint32_t& height) const override {
        const behaviour::Picture* picture = behaviour::find_picture(name);
        return picture != nullptr && picture->size(machine_, index, width, height);
    }
    bool row(std::string_view name, std::size_t index, std::uint32_t y,
             std::span<std::uint32_t> out) const override {
        const behaviour::Picture* picture = behaviour::find_picture(name);
        return picture != nullptr && picture->row(machine_, index, y, out);
    }

  private:
    const machine::Machine& machine_;
};

}  // namespace

Json BoardDisplay::page(SimTime /*now*/) {
    return page_json(screen_.scene(board_.machine()));
}

std::string BoardDisplay::png(SimTime /*now*/) {
    const MachinePictures pictures(board_.machine());
    return drawing::png_bytes(drawing::draw(screen_.scene(board_.machine()), &pictures));
}

Display::Touched BoardDisplay::touch(SimTime now, int x, int y, SimTime how_long) {
    const auto touched = screen_.touch(now, x, y, how_long);
    return {touched.why, touched.done};
}

Display::Touched BoardDisplay::touch(SimTime now, std::string_view control, SimTime how_long) {
    const auto touched = screen_.touch(now, board_.machine(), control, how_long);
    return {touched.why, touched.done};
}

Json PlugDisplay::page(SimTime /*now*/) {
    return page_json(screen::scene_of(plug_.screen().standpoint()));
}

std::string PlugDisplay::png(SimTime /*now*/) {
    return drawing::png_bytes(drawing::draw(screen::scene_of(plug_.screen().standpoint())));
}

Display::Touched PlugDisplay::touch(SimTime now, int x, int y, SimTime /*how_long*/) {
    const screen::Scene scene = screen::scene_of(plug_.screen().standpoint());
    const screen::SceneControl* control = scene.hit(x, y);
    if (control == nullptr) {
        return {fmt::format("There is no button at {}, {} on the page {}.", x, y, scene.page), now};
    }
    return {plug_.touch(control->button, control->row).sentence, now};
}

Display::Touched PlugDisplay::touch(SimTime now, std::string_view control, SimTime /*how_long*/) {
    return {plug_.press(control).sentence, now};
}

}  // namespace fauxboard::host
