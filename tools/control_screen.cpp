#include "tools/control_screen.h"

#include "emulator/behaviour/parse_json.h"
#include "emulator/control/base64.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/link/host_error.h"

namespace fauxboard::tools {

Json ControlScreen::ask(const Json& request) {
    std::string line;
    client_.ask(request);
    while (client_.receive(line) == ControlClient::Got::line) {
        Json answer = behaviour::parse_json(line);
        if (answer.is_object() && answer.contains("ok")) {
            return answer;
        }
    }
    throw link::HostError("The board's control channel does not answer; is it a board's?");
}

std::string ControlScreen::png() {
    const Json answer = ask({{"op", "screenshot"}});
    const auto bytes = control::from_base64(answer.value("png", ""));
    if (!bytes || bytes->empty()) {
        throw link::HostError("The board gives no picture of its screen: " + answer.dump());
    }
    return *bytes;
}

Json ControlScreen::page() {
    Json answer = ask({{"op", "page"}});
    if (!answer.value("ok", false)) {
        throw link::HostError(answer.value("/error/message"_json_pointer, "The board shows no page."));
    }
    for (const char* around : {"id", "ok", "t", "notices"}) {
        answer.erase(around);
    }
    return answer;
}

std::string ControlScreen::touch(std::string_view control) {
    const Json answer = ask({{"op", "touch"}, {"control", control}});
    return answer.value("ok", false) ? std::string{}
                                     : answer.value("/error/message"_json_pointer, "It was not touched.");
}

void ControlScreen::touch(int x, int y) {
    ask({{"op", "touch"}, {"x", x}, {"y", y}});
}

void ControlScreen::hold_time() {
    const Json answer = ask({{"op", "hold"}, {"on", true}});
    if (!answer.value("ok", false)) {
        throw link::HostError(
            answer.value("/error/message"_json_pointer, "The board does not hold its time."));
    }
}

void ControlScreen::pass(std::string_view time) {
    ask({{"op", "advance"}, {"by", time}});
}

std::shared_ptr<const screen::ScreenProfile> ControlScreen::profile() {
    const Json status = ask({{"op", "status"}});
    const auto board = host::load_profile_by_name(status.value("profile", ""));
    return host::load_own_screen(board->screen);
}

std::string place_of(const Json& page) {
    const Json& box = page.at("box");
    if (!box.is_object()) {
        return page.value("page", "");
    }
    const std::string text = box.value("text", "");
    return page.value("page", "") + " / " + box.value("caption", "") + " " + text.substr(0, text.find('\n'));
}

}  // namespace fauxboard::tools
