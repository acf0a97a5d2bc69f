#include "emulator/host/recorder.h"

#include <fmt/format.h>

#include <utility>

#include "emulator/fault/deed_text.h"
#include "emulator/record/recording.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr std::size_t max_datagram = 4096;

}  // namespace

Recorder::Recorder(std::string file, OnTrouble on_trouble)
    : file_(std::move(file)),
      on_trouble_(std::move(on_trouble)),
      out_(file_, fmt::format("The recording {}", file_)) {}

void Recorder::on_received(SimTime now, board::Channel channel, std::string_view line, board::Verdict) {
    // What came as a datagram is kept as one.
    if (channel != board::Channel::network) {
        write(now,
              record::recording_line(now, board::other_end(channel), "line", protocol::mask_secrets(line)));
    }
}

void Recorder::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    if (channel != board::Channel::network) {
        write(now,
              record::recording_line(now, board::own_end(channel), "line", protocol::mask_secrets(line)));
    }
}

void Recorder::on_world(SimTime now, std::string_view words) {
    write(now, record::recording_line(now, from_name(record::RecordedLine::From::world), "do", words));
}

void Recorder::on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) {
    on_fault(now, fmt::format("fault {}: {}", deed.fault, fault::deed_text(deed, board::other_end(channel))));
}

void Recorder::on_fault(SimTime now, std::string_view sentence) {
    write(now, record::recording_line({now, record::RecordedLine::From::fault, std::string(sentence)}));
}

void Recorder::on_datagram(SimTime now, std::uint64_t peer, bool to_board, std::string_view bytes) {
    using From = record::RecordedLine::From;
    // Longer ones are neither pieces of files nor requests, and would not fit into a line of a recording.
    const std::string_view kept = bytes.substr(0, max_datagram);
    write(now, record::recording_line(
                   {now, to_board ? From::network : From::module, protocol::mask_secrets(kept), peer}));
}

void Recorder::write(SimTime now, const std::string& text) {
    const std::string why = out_.append(text);
    if (!why.empty() && on_trouble_) {
        on_trouble_(now, fmt::format("the recording {} ends here, after {} lines: {}", file_, lines(), why));
    }
}

void Recorder::finish(SimTime now) {
    const std::string why = out_.finish();
    if (!why.empty() && on_trouble_) {
        on_trouble_(now, fmt::format("the recording {} is not whole: {}", file_, why));
    }
}

}  // namespace fauxboard::host
