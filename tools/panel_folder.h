#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "emulator/dlp/printer.h"
#include "emulator/host/live_observer.h"
#include "emulator/link/output_file.h"

namespace fauxboard::tools {

/// `run --panel DIR`: a PNG of each picture that the UV panel shows, and a line of panel.jsonl with its time,
/// layer, height, light, lit pixels and checksum.
class PanelFolder final : public host::LiveObserver {
  public:
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// Makes the folder, and a fresh panel.jsonl in it. Throws link::HostError.
    PanelFolder(std::string folder, OnTrouble on_trouble);
    /// The file with a line for each picture.
    static std::string list_in(const std::string& folder);
    /// Whose panel it is; before the first event.
    void watch(const dlp::Printer& machine) { machine_ = &machine; }

    /// No more comes.
    void finish();
    void on_event(machine::SimTime now, machine::EventId event) override;
    void on_received(machine::SimTime, board::Channel, std::string_view, board::Verdict) override {}
    void on_sent(machine::SimTime, board::Channel, std::string_view) override {}
    void on_notice(machine::SimTime, board::Level, std::string_view) override {}
    void on_link(machine::SimTime, link::LinkState, std::string_view) override {}

  private:
    void write_picture(const std::string& name) const;

    std::string folder_;
    OnTrouble on_trouble_;
    const dlp::Printer* machine_ = nullptr;
    std::optional<link::OutputFile> lines_;
    std::uint64_t count_ = 0;
};

}  // namespace fauxboard::tools
