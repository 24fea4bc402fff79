// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "segy/bytes.hpp"
#include "segy/words.hpp"

namespace slipwave::segy {

/// Whether a file of that name is Seismic Unix: "gather.su".
bool names_su(const std::string& path);

enum class FileKind { unknown, segy, su };

/// What the first bytes of an input (3600 tell everything, fewer less) look like; `size` is the whole
/// input's, where known. Seismic Unix files carry no mark: they are told by a plausible trace header and,
/// where known, a size that holds whole traces.
FileKind kind_of(std::span<const std::uint8_t> first, std::optional<std::uint64_t> size = {});

/// SEG-Y or Seismic Unix: segy::Reader would take it.
bool looks_like_segy(std::span<const std::uint8_t> first, std::optional<std::uint64_t> size = {});

/// Nineteen of twenty bytes are printable characters or blanks, in ASCII or EBCDIC (0 counts as one, but not
/// for more than half of them).
bool looks_like_text(std::span<const std::uint8_t> bytes);

/// A stanza begins "((" in either encoding; as the first bytes of a trace header that is a trace number
/// beyond reason.
bool begins_stanza(std::span<const std::uint8_t> bytes);

/// What the word at 3297 is since revision 2, in the file's byte order.
inline constexpr std::int64_t byte_order_constant = 0x01020304;

/// Byte order of a SEG-Y file from its binary header: the constant at 3297, then the format code, else big.
Endian byte_order_of(std::span<const std::uint8_t, BinaryLayout::size> binary);

/// Byte order of a Seismic Unix file from its first trace header: the one in which a whole number of traces
/// makes `size`; where that does not tell, the one with the smaller header words; else the machine's.
Endian su_byte_order_of(std::span<const std::uint8_t, TraceLayout::size> header,
                        std::optional<std::uint64_t> size);

}  // namespace slipwave::segy
