#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/record/transcript.h"
#include "protocol/annotate.h"

namespace fauxboard::record {

/// What is to be said against a line.
struct LineMark {
    std::string kind;  ///< "checksum", "unknown code", "unknown field", "length", "nul", "unreadable"
    std::string sentence;
};

/// One line of a transcript, taken apart and judged.
struct JudgedLine {
    TranscriptEntry entry;
    std::optional<protocol::DecodedLine> decoded;  ///< not of `world`, `bad` and notes, nor of pieces
    std::string piece;  ///< of a datagram that is a piece of a file: what it brings
    std::vector<LineMark> marks;
    std::string own;                   ///< the words that a profile has of its own for it
    std::string_view peer = "screen";  ///< what the main line's other end is called; see protocol::PeerName
};

/// Finds something to say against lines, or nothing. Rows of a table: see line_judges().
using LineJudge =
    std::function<void(const TranscriptEntry&, const protocol::DecodedLine&, std::vector<LineMark>&)>;

/// The judges that every line meets: checksum, unknown code, unknown fields, length, NULs. Whoever knows more
/// about a screen adds its own.
std::vector<LineJudge> line_judges();

JudgedLine judge(TranscriptEntry entry, const std::vector<LineJudge>& judges);

/// Whether its form is known and, of a line that has none, whether it could be one of a wire. Notes do not
/// count.
bool makes_sense(const JudgedLine& line);

/// One line of text, UTF-8 without control bytes, for a person; line end included:
///     ?   16.451778  screen → board  N-0 M999 X1*52        unknown "M999 X1"
/// The mark at its start: '!' checksum wrong, '?' code or field unknown, 'x' not readable, '*' anything else.
std::string text_line(const JudgedLine& line);

/// The same for a program, one JSON object in ASCII, line end included. Timed lines can be read as a
/// recording again. Keys: t, from, line or do; code, title, words, fields (key, name, text, value, unit,
/// meaning), checksum ("right", "wrong", "none", "unfinished"), known, marks. Of what cannot be read: file,
/// number, problem, text; of a note file, number, note.
std::string json_line(const JudgedLine& line);

}  // namespace fauxboard::record
