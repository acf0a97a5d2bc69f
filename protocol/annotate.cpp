#include "protocol/annotate.h"

#include <algorithm>

#include "protocol/command.h"
#include "protocol/decode.h"
#include "protocol/scan.h"

namespace fauxboard::protocol {

namespace {

/// Prefixes off the front; the rest of the line.
std::string_view decode_prefixes(std::string_view line, DecodedLine& decoded) {
    while (const auto token = scan::prefix_at(line)) {
        const std::size_t gap = token->length - 1 - token->number.size();
        decoded.prefixes.push_back(
            {std::string(token->number), std::string(line.substr(token->length - gap, gap))});
        line.remove_prefix(token->length);
    }
    return line;
}

/// Checksum off the end of `rest`, judged over `line`; the body.
std::string_view decode_checksum(std::string_view line, std::string_view rest, DecodedLine& decoded) {
    const scan::ChecksumToken token = scan::checksum_of(line);
    const bool bare = decoded.prefixes.empty();
    const std::string_view body = rest.substr(0, rest.size() - (line.size() - token.star));
    // The A30 screen's bare "M23 name*82" keeps our checksum in its name, and the log line never has one.
    const bool exempt = bare && (scan::starts_with_word(rest, "M23") || scan::starts_with_word(rest, "log"));
    if (token.tail == scan::StarTail::number && !exempt) {
        decoded.style = FrameStyle::framed;
        decoded.checksum_given = token.value;
        decoded.checksum_expected = xor_checksum(line.substr(0, token.star));
        return body;
    }
    if (token.tail == scan::StarTail::nothing && !bare) {
        decoded.style = FrameStyle::star_only;
        return body;
    }
    decoded.style = bare ? FrameStyle::bare : FrameStyle::unfinished;
    return rest;
}

/// Code or words off the front of `body`; what follows them.
std::string_view decode_code(std::string_view body, DecodedLine& decoded) {
    const auto command = parse_command(body);
    std::size_t length = body.size();
    if (const CodeInfo* words = find_words(decoded.direction, body)) {
        decoded.code = words;
        length = words->word.size();
    } else if (command) {
        decoded.code = find_code(decoded.direction, command->letter, command->number);
        length = command->word.size();
    } else if (const std::size_t blank = body.find_first_of(" \t"); blank != std::string_view::npos) {
        length = blank;
    }
    decoded.code_text = body.substr(0, length);
    return body.substr(length);
}

}  // namespace

bool DecodedLine::known() const {
    return code != nullptr &&
           std::all_of(fields.begin(), fields.end(), [](const DecodedField& f) { return f.info != nullptr; });
}

const DecodedField* DecodedLine::field(std::string_view key) const {
    const auto at =
        std::find_if(fields.begin(), fields.end(), [&](const DecodedField& f) { return f.key == key; });
    return at == fields.end() ? nullptr : &*at;
}

DecodedLine decode_line(std::string_view line, Direction direction) {
    DecodedLine decoded;
    decoded.direction = direction;
    const std::size_t blanks = scan::blanks_at(line, 0);
    decoded.lead = line.substr(0, blanks);
    line.remove_prefix(blanks);
    const std::string_view rest = decode_prefixes(line, decoded);
    const std::string_view body = decode_checksum(line, rest, decoded);
    const std::string_view text = decode_code(body, decoded);
    const auto fields = decoded.code != nullptr ? decoded.code->fields : std::span<const FieldInfo>{};
    decoded.fields = decode_fields(text, fields, decoded.tail);
    return decoded;
}

bool is_of_a_screen(const DecodedLine& line) {
    if (!line.prefixes.empty()) {
        return line.prefixes.front().number == "-0";
    }
    return line.code != nullptr && (line.code->letter == 'L' || line.code->word == "log");
}

std::string encode_body(const DecodedLine& line) {
    std::string body = line.code_text;
    for (const DecodedField& field : line.fields) {
        body += field.lead;
        body += field.key;
        body += field.number ? format_number(*field.number, field.decimals) : field.text;
        if (field.closed && field.info != nullptr) body += field.info->closing;
    }
    return body + line.tail;
}

std::string encode_line(const DecodedLine& line) {
    std::string bytes;
    for (const DecodedPrefix& prefix : line.prefixes) {
        bytes += 'N' + prefix.number + prefix.gap;
    }
    bytes += encode_body(line);
    if (line.style == FrameStyle::framed) {
        bytes += '*' + std::to_string(xor_checksum(bytes));
    } else if (line.style == FrameStyle::star_only) {
        bytes += '*';
    }
    return line.lead + bytes;
}

}  // namespace fauxboard::protocol
