#pragma once

#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emulator/dlp/spi_frames.h"
#include "emulator/link/direct_stream.h"
#include "emulator/link/output_file.h"
#include "emulator/record/pcapng.h"

namespace fauxboard::tools {

/// `run --spi FILE|pty[=LINK]|HOST:PORT`: the wires to the UV panel as records (see dlp/spi_frames.h), in a
/// file, in a capture (FILE.pcapng), or for somebody at the other end, who may answer.
///
/// Who has sent a 'P' record is waited for after each line, who has sent an 'I' record after each question
/// for the command byte, who has sent one of a controller after each reading of an id: the answer is a record
/// of the same kind with the number of the transfer. One that does not come in time is that of the FPGA made
/// up here, and nobody is waited for until the next one comes; but an id that does not come is missing, and
/// waited for again.
class SpiPort final : public dlp::SpiTap {
  public:
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// `start`: real time, since 1970, at which virtual time was 0. Throws link::HostError, link::LinkError.
    SpiPort(const std::string& where, machine::SimTime start, OnTrouble on_trouble);
    ~SpiPort() override;
    SpiPort(const SpiPort&) = delete;
    SpiPort& operator=(const SpiPort&) = delete;

    /// The file, or the name of the link to a pseudo-terminal, that `where` means; "" for none.
    static std::string file_of(const std::string& where);
    /// {"link": "file", "path": ...}
    nlohmann::ordered_json ready() const;
    /// Where it listens for TCP; "" when it does not.
    std::string network_path() const;

    /// The records that wait are handed on, and trouble with that is told: later nobody is there to be told.
    void finish();

    void transfer(dlp::SimTime now, dlp::ChipSelect chip, std::span<const std::uint8_t> out,
                  std::span<std::uint8_t> in) override;
    bool pin(dlp::SimTime now, bool good) override;
    void reset(dlp::SimTime now, bool low) override;

  private:
    /// Whether the other end answers with records of a kind.
    struct Answers {
        dlp::SpiKind kind;
        bool of_controllers;  ///< else of the FPGA
        std::string_view what;
        bool awaited = false;

        bool takes(const dlp::SpiRecord& record) const {
            return record.kind == kind && (record.chip != dlp::ChipSelect::fpga) == of_controllers;
        }
    };
    /// The answer of whoever is at the other end to the transfer at hand. False: nobody's there to give one.
    bool ask(Answers& answers, std::span<std::uint8_t> in);
    void tell(dlp::SpiRecord record);
    void flush();
    void hear();
    void hear(const dlp::SpiRecord& record);
    std::optional<dlp::SpiRecord> await(Answers& answers);

    std::string path_;
    OnTrouble on_trouble_;
    std::optional<link::OutputFile> file_;
    std::optional<record::PcapngWriter> capture_;
    std::unique_ptr<link::DirectStream> stream_;
    std::string waiting_;  ///< records not handed on yet
    dlp::SpiSplitter splitter_;
    Answers pins_{dlp::SpiKind::pin, false, "the checksum pin"};
    Answers bytes_{dlp::SpiKind::in, false, "the command byte"};
    Answers ids_{dlp::SpiKind::in, true, "the ids of the controllers"};
    std::optional<dlp::SpiRecord> answer_;  ///< the one that is waited for
    std::uint32_t number_ = 0;              ///< of the last transfer
    dlp::SimTime last_{0};                  ///< time of the last record: there is no going back
    bool told_pin_ = true;
    bool was_up_ = false;
};

}  // namespace fauxboard::tools
