// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "segy/reader.hpp"
#include "segy/writer.hpp"

namespace slipwave::segy {

/// How the file was written that is being read. Revisions that do not exist count as the nearest that does,
/// Seismic Unix as SEG-Y revision 1.
FileFormat format_of(const Reader& reader);

/// A file of that format with the traces of `reader`: its sampling, its binary header where it has one, its
/// text with `entry` (a command line) added; extended textual headers since revision 1 and additional trace
/// headers in revision 2, these where the byte order is the same, because nobody but their author knows their
/// words.
FileInfo info_as(const Reader& reader, const std::string& entry, const FileFormat& format);

/// Why traces of `found` cannot stand beside those of `expected` in one file as they are: the first of kind
/// of file, byte order, sample format, unit of length, additional headers and sampling that differs, with
/// both values ("the byte order is little, expected big"); "" when none does.
std::string record_difference(const Reader& found, const Reader& expected);

/// Sentences about what of the input a file of that format does not hold.
std::vector<std::string> losses_of(const Reader& reader, const FileFormat& format);

}  // namespace slipwave::segy
