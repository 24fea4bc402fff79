// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slipwave::segy {

inline constexpr std::size_t text_lines = 40;
inline constexpr std::size_t text_columns = 80;
inline constexpr std::size_t text_bytes = text_lines * text_columns;
inline constexpr std::size_t text_prefix = 4;  // "C 1 " before what a line says

enum class TextEncoding { ebcdic, ascii };

/// "ebcdic" or "ascii".
const char* name_of(TextEncoding encoding);

/// What a textual header is written in: by its first byte or that of a stanza, else by the commoner blank.
TextEncoding encoding_of(std::span<const std::uint8_t> text);

/// Bytes of a file to ISO 8859-1 (EBCDIC is code page 037), one character a byte; encode_text is its inverse.
std::string decode_text(std::span<const std::uint8_t> bytes, TextEncoding encoding);
std::vector<std::uint8_t> encode_text(std::string_view text, TextEncoding encoding);

/// A textual header of 40 lines x 80: every line of `lines` wrapped at blanks to 76 columns behind "C 1 " ..,
/// C39 and C40 the stamps of the revision. Characters that differ between EBCDIC code pages, and those
/// outside ASCII, are replaced: [ ] become ( ), | becomes /, the others a dot. Where 38 lines do not hold
/// everything, the last of `lines` stays and a line "..." stands for what is left out.
std::string lay_out_text(std::span<const std::string> lines, int revision);

/// Lays out two groups of lines as lay_out_text() does one, the second of which always stays as a whole:
/// where 38 lines do not hold both, the longest of the first are cut, the later of them left out, and a few
/// lines stay free for the commands of tools that come after.
std::string lay_out_text(std::span<const std::string> lines, std::span<const std::string> always,
                         int revision);

/// The lines of 80 columns of a textual header, or of several behind one another.
std::vector<std::string> lines_of(std::string_view text);

/// `text` (3200 characters of another file) with one more entry after its last line in use, laid out as
/// lay_out_text does. The other lines stay as they are; C39 and C40 are stamped where they are blank or hold
/// a stamp. When there is no room, the entry takes the place of the last lines before C39, a line "..."
/// before it.
std::string with_entry(std::string_view text, const std::string& entry, int revision);

/// The lines for a person: trailing blanks off, what is not printable ASCII shown as '.', lines with nothing
/// behind their number left out.
std::vector<std::string> shown_lines(std::string_view text);

}  // namespace slipwave::segy
