#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "emulator/sliced/sliced_file.h"

namespace fauxboard::tools {

/// What a sliced file says of itself, for people: a line each, "What  value".
std::string sliced_text(const sliced::Header& header, std::uint64_t file_bytes);

/// The same for programs. Units are in the names.
nlohmann::ordered_json sliced_json(const sliced::Header& header, std::uint64_t file_bytes);
nlohmann::ordered_json layer_json(const sliced::Layer& layer, std::uint32_t n);

}  // namespace fauxboard::tools
