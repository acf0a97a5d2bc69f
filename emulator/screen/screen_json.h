#pragma once

// What a screen shows and finds, for programs. Bytes of the line are Latin-1 code points.

#include <span>
#include <string>
#include <vector>

#include "emulator/behaviour/document.h"
#include "emulator/screen/page_view.h"
#include "emulator/screen/tour.h"

namespace fauxboard::screen {

/// {"button", "verdict", "sent", "expected", "came", "at_s", "took_s", "sentence"}
behaviour::Json to_json(const TourResult& result);
/// {"line", "frame", "verdict", "why"}
behaviour::Json to_json(const Judgement& judgement);
/// {"times", "line", "frame", "verdict", "why"}
behaviour::Json to_json(const Finding& finding);

/// The first as one line.
std::string result_json(const TourResult& result);
/// {"t": seconds, "lint": {"line", "frame", "verdict", "why"}} as one line. `at` is the time to tell.
std::string judgement_json(const Judgement& judgement, SimTime at);
/// {"page", "title", "lines", "values": {name: {"value", "unit", "from", "told"}}, "buttons": [{"path",
/// "label", "row", "shut", "input"}], "findings"}, indented. `missing`: values that no line has brought.
std::string page_json(const Standpoint& at, const std::vector<std::size_t>& missing,
                      std::span<const Finding> findings);

/// The open page for somebody who draws it and presses: {"screen", "page", "title", "lines", "buttons":
/// [{"path", "label", "row", "everywhere", "shut", "input": {"min", "max", "normally"}}]}.
behaviour::Json face_json(const Standpoint& at);

}  // namespace fauxboard::screen
