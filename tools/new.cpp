// `fauxboard new`: a small profile, screen or scenario that passes `check`, to start from.

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/host/profile_files.h"
#include "tools/commands.h"
#include "tools/option_values.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

namespace fs = std::filesystem;

/// @SCHEMA@ and @NAME@ are filled in.
struct Template {
    std::string_view kind;
    std::string_view text;
    std::string_view next;  ///< what to do with the file, in a line
};

constexpr Template templates[] = {
    {"profile",
     R"({
  "$schema": "@SCHEMA@/profile.schema.json",
  "name": "@NAME@",
  "title": "@NAME@: a board of my own, after the Geeetech A30T",
  "extends": "geeetech-a30t",
  "identity": { "device_name": "@NAME@", "firmware": "V0.0.1" },
  "frames": { "L14.hello": "L14 the nozzle is at {heaters.nozzle.printed:.1f}" },
  "requests": {
    "M2999": { "send": ["L14.hello", "L2"] }
  }
}
)",
     "fauxboard run --profile {0}, and change it while it runs; `fauxboard describe` lists all that it can "
     "say"},
    {"screen",
     R"({
  "$schema": "@SCHEMA@/screen.schema.json",
  "name": "@NAME@",
  "title": "@NAME@: a screen of my own, after the Geeetech A30T's",
  "extends": "geeetech-a30t",
  "pages": {
    "Main": { "buttons": { "Mine": { "leads_to": "Mine" } } },
    "Mine": {
      "shows": ["Nozzle {nozzle.current:.1f} / {nozzle.target:.1f} °C"],
      "buttons": {
        "Warm up": {
          "send": "M104 S60.0",
          "expect": [{ "frame": "L2", "where": { "nozzle.target": 60 }, "within_ms": 9000 }]
        }
      }
    }
  }
}
)",
     "fauxboard screen --port DEV --screen {0} show Mine"},
    {"scenario",
     R"({
  "$schema": "@SCHEMA@/scenario.schema.json",
  "name": "@NAME@",
  "title": "The nozzle warms up when it is told to",
  "profile": "geeetech-a30t",
  "screen": "geeetech-a30t",
  "steps": [
    { "wait": { "line": "^L23 " }, "why": "the board has started" },
    { "press": "Control/Filament/Hotend on" },
    { "expect": "^L2 .*/200\\.0", "why": "the screen is told the target" },
    { "wait": { "field": { "heaters.nozzle.true": { "min": "60C" } } }, "within": "5min", "why": "it gets warm" }
  ]
}
)",
     "fauxboard run --script {0} --speed max"},
};

/// A name is also a file's name, and stands in JSON text.
std::string wrong_name(const std::string& name) {
    const bool plain = !name.empty() && name.size() <= 64 && name.front() != '-' && name.front() != '.' &&
                       std::all_of(name.begin(), name.end(), [](unsigned char c) {
                           return c < 0x80 && (std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.');
                       });
    return plain ? std::string()
                 : "'" + name + "' is no name; expected up to 64 letters, digits, '-', '_' and '.'";
}

std::string filled(std::string_view text, std::string_view name) {
    std::string schema;
    for (const fs::path& folder : host::profile_folders()) {
        std::error_code error;
        if (fs::is_directory(folder / "schemas", error)) {
            schema = fs::absolute(folder / "schemas", error).lexically_normal().string();
            break;
        }
    }
    std::string out(text);
    const std::pair<std::string_view, std::string_view> places[] = {{"@SCHEMA@", schema}, {"@NAME@", name}};
    for (const auto& [place, value] : places) {
        for (std::size_t at = out.find(place); at != std::string::npos;
             at = out.find(place, at + value.size())) {
            out.replace(at, place.size(), value);
        }
    }
    return out;
}

ExitCode create(const std::string& kind, const std::string& name) {
    const auto* const hit = std::find_if(std::begin(templates), std::end(templates),
                                         [&](const Template& one) { return one.kind == kind; });
    const std::string file = name + ".json";
    std::FILE* const out = std::fopen(file.c_str(), "wxe");  // never over a file that is there
    if (out == nullptr) {
        return complain("new", ExitCode::bad_input,
                        fmt::format("{}: {}", file,
                                    errno == EEXIST ? "there is such a file already, and it stays as it is"
                                                    : std::strerror(errno)));
    }
    const std::string text = filled(hit->text, name);
    const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
    if (std::fclose(out) != 0 || !written) {
        return complain("new", ExitCode::bad_input, file + ": " + std::strerror(errno));
    }
    print(fmt::format("{}\n  fauxboard check {}\n  {}\n", file, file,
                      fmt::format(fmt::runtime(hit->next), file)));
    return ExitCode::ok;
}

}  // namespace

void add_new(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand(
        "new", "A small profile, screen or scenario to start from, as NAME.json in this folder");
    const auto kind = std::make_shared<std::string>();
    const auto name = std::make_shared<std::string>();
    command->add_option("KIND", *kind, "profile, screen or scenario")
        ->type_name("profile|screen|scenario")
        ->required()
        ->check(one_of({"profile", "screen", "scenario"}));
    command->add_option("NAME", *name, "What it is called")->required()->check(wrong_name);
    command->callback([kind, name, &exit] { exit = create(*kind, *name); });
}

}  // namespace fauxboard::tools
