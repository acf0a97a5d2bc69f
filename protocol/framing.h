#pragma once

// Bytes <-> lines <-> bodies: the frame of the Smartto screen line.
//
// A frame is "N-0 " + body + '*' + the decimal XOR of every byte from the N up to the byte before the star +
// CR LF. Source: the Smartto touch-screen protocol document, chapters 1 and 2, and 3996 recorded frames of a
// Geeetech A30T, all of which verify. None of these functions allocates (but frame(), the convenience), reads
// a clock or throws.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace fauxboard::protocol {

/// XOR of all bytes, 0..255; 0 for no bytes. "N-0 G28" -> 62. The document calls it a 16 bit CRC; it is this.
std::uint8_t xor_checksum(std::string_view bytes);

/// Longest line taken, in bytes, line end and NULs not counted: Smartto's own checksum loop stops at 512.
inline constexpr std::size_t max_line_bytes = 512;

/// How a line is dressed for the wire.
enum class FrameStyle : std::uint8_t {
    framed,     ///< "N-0 body*XOR"
    bare,       ///< "body": what an A30 screen sends, and the board's "SD printing byte 0/0"
    star_only,  ///< "N-0 body*": a real A30T's "L14 Pausing... please try again later."
    unfinished  ///< "N-0 body": a real A30T's "L14 file select succeed!:..."
};

/// What a line ends with. Smartto's all end in CR LF; a ChiTu board ends its M4002 with LF alone.
enum class LineEnd : std::uint8_t { crlf, lf, none };

/// Writes one wire line to the start of `out` and returns its length in bytes, or 0 and leaves `out` alone
/// when it does not fit. `body` holds no CR, LF or NUL: they would end or spoil the line, and are not looked
/// for.
std::size_t write_frame(std::span<char> out, std::string_view body, FrameStyle style);

/// Bytes that a frame of this style has before its body.
std::size_t frame_head(FrameStyle style);

/// As write_frame(), for a body that stands in `out` already, frame_head() bytes from its start, and whose
/// bytes XOR to `body_sum`.
std::size_t dress_frame(std::span<char> out, std::size_t body_size, unsigned body_sum, FrameStyle style,
                        LineEnd end = LineEnd::crlf);

/// What write_frame() writes, as a string, for tests and tools.
std::string frame(std::string_view body, FrameStyle style = FrameStyle::framed);

/// What a receiver does with checksums.
enum class ChecksumPolicy : std::uint8_t {
    required,    ///< every line must carry a right one, but for `log ...`
    if_present,  ///< a line may do without; a wrong one is a fault
    ignored      ///< taken off, never judged (as the A30 screen does)
};

enum class FrameFault : std::uint8_t {
    none,
    checksum_missing,   ///< no star at all
    checksum_wrong,     ///< a number, and not the XOR of the line
    checksum_malformed  ///< behind the star: nothing, something else than digits, over three digits, over 255
};

/// A line without its frame. The views point into the line given.
struct Unframed {
    /// The request itself. Blanks before it are gone, blanks at its end are its own and stay (the A30 screen
    /// sends "M106 P0 S252 "); NULs at either end of the line are gone.
    std::string_view body;
    bool prefixed = false;  ///< at least one "N<int>" stood before it
    int line_number = 0;  ///< of the last prefix: "N-0" -> 0, "N12" -> 12; clamped to int; 0 without a prefix
    bool has_checksum = false;            ///< a well-formed one (0..255) stood at the end, right or wrong
    FrameFault fault = FrameFault::none;  ///< as judged by the policy; the body is cut out in any case
};

/// Takes the frame off one line (without its line end) and judges its checksum.
///
/// - Any number of prefixes is one frame: "N-0 N-0 M2134 FW:V1.02.xx*39" is what an A30T screen really sends.
/// The XOR
///   covers all from the first byte that is no blank (the first N, where there is one) up to the star.
/// - The LAST star of the line starts the checksum, since a file name may hold one.
/// - `required`: no star is checksum_missing; a `log ...` line, the screen's message at power-up, is never
/// framed and so
///   always taken whole.
/// - `if_present`: a star with digits behind it is judged; a star with nothing behind it is cut off without a
/// word
///   (FrameStyle::star_only); a star with other things behind it belongs to the body. A bare `M23 name*82` is
///   not judged, only cut: the A30 screen keeps the checksum of our L7 line as part of the file's name.
/// - `ignored`: cut off as in `if_present`, never judged.
Unframed unframe(std::string_view line, ChecksumPolicy policy);

/// Bytes before the first NUL, CR or LF of `bytes`; all of them where there is none.
std::size_t plain_run(std::string_view bytes);

/// Cuts a byte stream into lines, whatever pieces it comes in.
///
/// CR or LF ends a line, empty lines are skipped (source: protocol document; the A30 screen's firmware does
/// the same). NULs are counted and dropped: the A30 screen sends one after its power-up message. A line over
/// max_line_bytes is dropped whole up to its end, or given without what is too much, and counted once. Memory
/// is fixed; nothing a peer sends makes it grow.
class LineSplitter {
  public:
    /// Whether a line that is too long is given all the same, as far as it fits.
    void set_cutting(bool cutting) { cutting_ = cutting; }
    /// Calls on_line(std::string_view) once per complete line, in order. The view lives until on_line
    /// returns: it points into `bytes` where the line lay there whole, else into the splitter. on_line may
    /// call reset(), not feed().
    template <class F>
    void feed(std::string_view bytes, F&& on_line) {
        while (!bytes.empty()) {
            const std::size_t run = plain_run(bytes);
            const std::string_view piece = bytes.substr(0, run);
            if (run == bytes.size()) {
                keep(piece);
                return;
            }
            const char mark = bytes[run];
            const bool pair = mark == '\r' && run + 1 < bytes.size() && bytes[run + 1] == '\n';
            bytes.remove_prefix(run + (pair ? 2 : 1));
            if (mark == '\0') {
                ++nuls_;
                keep(piece);
            } else if (!in_line() && run <= max_line_bytes) {
                if (run != 0) on_line(piece);
            } else {
                keep(piece);
                end_line(on_line);
            }
        }
    }

    /// Lines dropped for their length, since construction.
    std::uint64_t too_long() const { return too_long_; }
    /// NUL bytes dropped, since construction.
    std::uint64_t nuls() const { return nuls_; }
    /// True while bytes of an unfinished line have come in.
    bool in_line() const { return length_ != 0 || dropping_; }
    /// Calls on_line as feed() does with the unfinished line, as if its end had come; not for an empty one.
    template <class F>
    void end_line(F&& on_line) {
        const std::size_t length = finish();
        if (length != 0) on_line(std::string_view(partial_.data(), length));
    }
    /// Forgets the unfinished line (the port was closed); the counters stay.
    void reset() {
        length_ = 0;
        dropping_ = false;
    }

  private:
    void keep(std::string_view piece) {
        if (dropping_ || piece.empty()) return;
        if (piece.size() > max_line_bytes - length_) {
            ++too_long_;
            dropping_ = true;
            if (!cutting_) return;
            piece = piece.substr(0, max_line_bytes - length_);
        }
        std::memcpy(partial_.data() + length_, piece.data(), piece.size());
        length_ += piece.size();
    }

    /// Ends the stored line; its length, 0 when it was dropped.
    std::size_t finish() {
        const std::size_t length = dropping_ && !cutting_ ? 0 : length_;
        reset();
        return length;
    }

    std::array<char, max_line_bytes> partial_{};
    std::size_t length_ = 0;
    bool dropping_ = false;  ///< the rest of the line
    bool cutting_ = false;
    std::uint64_t too_long_ = 0;
    std::uint64_t nuls_ = 0;
};

}  // namespace fauxboard::protocol
