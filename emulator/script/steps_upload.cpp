// Files that come over the network.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "emulator/behaviour/wire_text.h"
#include "emulator/script/compiler.h"
#include "emulator/sliced/sample.h"
#include "protocol/chitu_chunk.h"

namespace fauxboard::script::rows {
namespace {

using behaviour::ObjectReader;

constexpr std::size_t most_name_bytes = 200;
/// Without progress for so long, the file does not get through.
constexpr int most_tries = 100;
/// Who sends: a number that no socket gives out.
constexpr std::uint64_t sender = machine::Transfer::usb_side - 1;

/// Sends a file as slicers do: a piece, an answer. Past sockets and their faults, at one moment.
class Sender {
  public:
    Sender(board::Board& board, SimTime now) : board_(board), now_(now) {}

    /// What went wrong, as the end of a sentence; empty when the file is there.
    std::string send(const std::string& name, std::string_view content) {
        ask("M28 " + name);
        if (answers_.empty() || !answers_[0].starts_with("ok")) {
            return refused("M28 " + name);
        }
        std::size_t at = 0;
        for (int tries = 0; at < content.size(); ++tries) {
            if (tries == most_tries) {
                return refused(fmt::format("the piece from {} on, sent {} times,", at, most_tries));
            }
            const std::size_t before = at;
            const std::string_view piece = content.substr(at, protocol::max_chunk_payload);
            std::array<char, protocol::max_chunk_bytes> room{};
            const std::size_t bytes = protocol::write_chunk(room, static_cast<std::uint32_t>(at), piece);
            ask({room.data(), bytes});
            if (heard_ok()) {
                at += piece.size();
            } else if (const auto again = asked_again()) {
                at = std::min<std::size_t>(*again, content.size());
            } else if (!answers_.empty()) {
                return refused(fmt::format("the piece from {} on", at));
            }
            tries = at > before ? -1 : tries;
        }
        ask("M29");
        return heard_ok() ? std::string{} : refused("M29");
    }

  private:
    void ask(std::string_view datagram) {
        answers_.clear();
        board_.receive_datagram(now_, sender, datagram);
        board_.take_datagrams(
            [this](std::uint64_t, std::string_view answer) { answers_.emplace_back(answer); });
    }
    bool heard_ok() const {
        const auto says = [this](std::string_view start) {
            return std::any_of(answers_.begin(), answers_.end(),
                               [&](const std::string& answer) { return answer.starts_with(start); });
        };
        return says("ok") && !says("Error") && !says("resend");
    }
    std::optional<std::uint32_t> asked_again() const {
        return answers_.empty() ? std::nullopt : protocol::resend_offset(answers_[0]);
    }
    std::string refused(const std::string& what) const {
        if (answers_.empty()) {
            return fmt::format("{} was not answered", what);
        }
        const std::string& first = answers_[0];
        return fmt::format("{} was answered \"{}\"", what,
                           behaviour::from_wire(first.substr(0, first.find_first_of("\r\n"))));
    }

    board::Board& board_;
    SimTime now_;
    std::vector<std::string> answers_;
};

void compile_upload(Compiler& c, const Json& value, ObjectReader& reader, Step& out) {
    out.text = c.line(value, reader.pointer("upload"), most_name_bytes, true);
    out.words = "upload " + value.dump();
    sliced::Sample sample;
    unsigned layers = sample.layers;
    reader.unsigned_integer("layers", layers, 1, sliced::Sample::most_layers);
    sample.layers = layers;
    if (const Json* exposure = reader.get("exposure")) {
        const SimTime time =
            c.time(*exposure, reader.pointer("exposure"), SimTime{1000}, std::chrono::hours(1));
        sample.exposure_s = static_cast<float>(machine::to_seconds(time));
    }
    out.bytes = sliced::make_sample(sample);
}

std::string run_upload(Acting& acting, const Step& step) {
    std::string trouble;
    acting.stage.visit(
        [&](board::Board& board, SimTime now) { trouble = Sender(board, now).send(step.text, step.bytes); });
    return trouble.empty() ? trouble : fmt::format("\"{}\" did not go up: {}", step.text, trouble);
}

constexpr std::array upload_keys{
    KeyInfo{"layers", "integer", "how many it has; 5 unless given"},
    KeyInfo{"exposure", "time", "how long each is exposed; 2s unless given"},
};

constexpr std::array upload_table{
    StepKind{"upload", "text",
             "a small made-up file that a resin printer can print goes up over the network under this name, "
             "as slicers send it: M28, pieces, M29; a board that does not take it fails the scenario",
             R"j({"upload": "box.cbddlp", "layers": 4})j", upload_keys, Role::act, compile_upload,
             run_upload},
};

}  // namespace

std::span<const StepKind> upload_steps() {
    return upload_table;
}

}  // namespace fauxboard::script::rows
