#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// A file, or a pipe, that is written piece by piece while something else goes on: nothing here waits, but
/// for the `patience` that its owner has with the reader of a pipe.
class OutputFile {
  public:
    static constexpr std::size_t max_waiting = 1024UL * 1024;
    /// That a pipe's reader has at least to take the last of it.
    static constexpr std::chrono::milliseconds end_patience{1000};

    /// Creates or empties `file`. Throws HostError, in which `what` says what it is ("The recording
    /// talk.jsonl"): it cannot be written; it is a pipe that nobody reads; another writes it just now.
    OutputFile(const std::string& file, std::string_view what, std::chrono::milliseconds patience = {});
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// A piece, whole or not at all. What a pipe's reader does not take in time waits here, within
    /// max_waiting. Empty; or, once, why there is nothing more to be written: a full disk ends the file, not
    /// its owner.
    std::string append(std::string_view piece);
    /// The end of it: what waits is taken within the patience, or end_patience if that is longer. Empty, or
    /// why it is not whole.
    std::string finish();
    /// Nothing more is written.
    bool over() const { return !fd_; }
    /// That were written, or wait.
    std::uint64_t pieces() const { return pieces_; }

  private:
    int catch_up(std::chrono::milliseconds patience);
    std::string give_up(std::string why, std::size_t torn);

    std::chrono::milliseconds patience_;
    UniqueFd fd_;
    std::string waiting_;  ///< of a pipe whose reader is slow
    std::uint64_t pieces_ = 0;
};

/// The whole of a file, such as a report or a picture: it has its name when all of it is there, and a file
/// that had it before is as it was until then. Throws HostError as OutputFile does, and when there is no
/// room.
void write_output(const std::string& file, std::string_view what, std::string_view bytes);

}  // namespace fauxboard::link
