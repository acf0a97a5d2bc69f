// `fauxboard sliced`: what is in a sliced file of a resin printer; its pictures as PNG.

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "emulator/link/host_error.h"
#include "emulator/sliced/scanlines.h"
#include "tools/file_roles.h"
#include "tools/file_source.h"
#include "tools/option_values.h"
#include "tools/png_file.h"
#include "tools/report.h"
#include "tools/sliced_text.h"

namespace fauxboard::tools {
namespace {

using link::HostError;
using sliced::Scanlines;
using sliced::SlicedFile;

struct SlicedOptions {
    std::string file;
    bool json = false;
    std::optional<std::uint32_t> layer;
    std::string preview;
    std::string png;
};

[[noreturn]] void wrong_file(const SlicedOptions& options, const std::string& problem) {
    throw HostError(fmt::format("{} cannot be used. {}", options.file, problem));
}

/// The value, or HostError with the file's name.
template <class T>
T need(const SlicedOptions& options, sliced::Outcome<T> outcome) {
    if (!outcome) {
        wrong_file(options, outcome.problem());
    }
    return std::move(*outcome);
}

std::string line(const nlohmann::ordered_json& object) {
    return object.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Every picture of a layer, run by run. Throws HostError.
void check_pictures(const SlicedOptions& options, const SlicedFile& file, const FileSource& source,
                    std::uint32_t n) {
    for (std::uint32_t plane = 0; plane < file.header().level_sets; ++plane) {
        const sliced::Layer layer = need(options, file.layer(source, n, plane));
        auto runs = sliced::PictureRuns::of_layer(file, source, n, layer, plane);
        for (sliced::Run run; runs.next(run);) {
        }
        if (!runs.problem().empty()) {
            wrong_file(options, fmt::format("Layer {}: {}", n, runs.problem()));
        }
    }
}

/// The header first; then every layer, whose pictures are read through to know that they are whole.
void tell(const SlicedOptions& options, const SlicedFile& file, const FileSource& source) {
    print(options.json ? line(sliced_json(file.header(), source.size()))
                       : sliced_text(file.header(), source.size()));
    std::uint64_t end = 0;
    for (std::uint32_t n = 0; n < file.header().layers; ++n) {
        const sliced::Layer layer = need(options, file.layer(source, n));
        check_pictures(options, file, source, n);
        end = layer.end();
        if (options.json) {
            print(line(layer_json(layer, n)));
        }
    }
    if (!options.json) {
        print(fmt::format("All {} layers are whole; the last one ends at byte {}.\n", file.header().layers,
                          end));
    }
}

Scanlines scanlines_of(const SlicedOptions& options, const SlicedFile& file, const FileSource& source) {
    if (options.layer) {
        return need(options, Scanlines::of_layer(file, source, *options.layer));
    }
    const auto& preview =
        options.preview == "large" ? file.header().large_preview : file.header().small_preview;
    if (!preview) {
        wrong_file(options, fmt::format("It has no {} preview.", options.preview));
    }
    return Scanlines::of_preview(*preview, source);
}

/// Says whether the whole picture can be read, before a file is made of it.
void check_scanlines(const SlicedOptions& options, Scanlines lines) {
    std::vector<std::uint32_t> row(lines.width());
    while (lines.next(row)) {
    }
    if (!lines.problem().empty()) {
        wrong_file(options, lines.problem());
    }
}

void write_picture(const SlicedOptions& options, const SlicedFile& file, const FileSource& source) {
    check_scanlines(options, scanlines_of(options, file, source));
    Scanlines lines = scanlines_of(options, file, source);
    std::vector<std::uint32_t> values(lines.width());
    const bool colour = !options.layer;
    const PngPicture picture{lines.width(), lines.height(), colour, false, [&](std::span<unsigned char> out) {
                                 const bool more = lines.next(values);
                                 std::size_t at = 0;
                                 for (const std::uint32_t value : values) {
                                     for (int shift = colour ? 16 : 0; shift >= 0; shift -= 8) {
                                         out[at++] = static_cast<unsigned char>(value >> shift & 0xFF);
                                     }
                                 }
                                 return more;
                             }};
    if (!write_png(options.png, picture)) {
        wrong_file(options, lines.problem());
    }
    print(options.json ? line({{"png", options.png}, {"width", lines.width()}, {"height", lines.height()}})
                       : fmt::format("{}: {} x {} pixels\n", options.png, lines.width(), lines.height()));
}

ExitCode sliced(const SlicedOptions& options) {
    const bool picture = options.layer || !options.preview.empty();
    if (picture == options.png.empty()) {
        return complain("sliced", ExitCode::usage,
                        picture ? "Name the file to write with --png."
                                : "Say what --png is to show: --layer or --preview.");
    }
    try {
        FileRoles roles;
        roles.reads("the file", options.file);
        roles.writes("the picture", options.png);
        const FileSource source(options.file);
        const SlicedFile file = need(options, SlicedFile::open(source));
        picture ? write_picture(options, file, source) : tell(options, file, source);
        return ExitCode::ok;
    } catch (const HostError& error) {
        return complain("sliced", ExitCode::bad_input, error.what());
    }
}

}  // namespace

void add_sliced(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand(
        "sliced",
        "Tell what is in a sliced file of a resin printer (.ctb, .cbddlp, .photon, .pws, .photons)");
    const auto options = std::make_shared<SlicedOptions>();
    command->add_option("FILE", options->file, "The file")->type_name("FILE")->required();
    command->add_flag("--json", options->json, "JSON lines: the header, then each layer");
    CLI::Option* layer =
        command->add_option("--layer", options->layer, "This layer's picture; the first is 0")
            ->type_name("N");
    command->add_option("--preview", options->preview, "This preview's picture")
        ->type_name("large|small")
        ->check(one_of({"large", "small"}))
        ->excludes(layer);
    command->add_option("--png", options->png, "Where the picture goes")->type_name("OUT");
    command->callback([options, &exit] { exit = sliced(*options); });
}

}  // namespace fauxboard::tools
