// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "gather/trace.hpp"
#include "segy/file_header.hpp"
#include "segy/words.hpp"

namespace slipwave::segy {

/// Trace identification code (byte 29) of a component: 11 p, 12 vz, 13 vy, 14 vx as the standard has them,
/// 256 plus the Voigt index of the stress in the range left to users: 257 sxx, 258 syy, 259 szz, 260 syz, 261
/// sxz, 262 sxy; 1 other. fldr, tracf and trid together so name one trace.
std::int64_t code_of(Component component);
Component component_of_code(std::int64_t code);

/// What in-lines and cross-lines (bytes 189 and 193) of a gather count. Programs that know only regular
/// cubes, offsets fastest, open a line or a well by them.
enum class Numbering {
  bins,      // midpoints spread over an area: bins of their y and x
  shots,     // midpoints on a line: shot and component (trid), channels being the offsets
  channels,  // one offset for all channels, as in a well: component and channel
};

/// What all trace headers of a file share.
struct SurveyLayout {
  int coordinate_scalar = 1;         // 1, -10, -100, -1000 or -10000
  double rounding_m = 0;             // of any place, by that scalar
  double closest_m = 0;              // smallest distance of receivers, or of one and its source; 0: none
  double bin_m = 1;                  // width of a midpoint bin along x
  double bin_y_m = 1;                // and along y
  std::int64_t traces_per_shot = 1;  // of the shot that has most
  std::int64_t traces = 0;           // 0: not known beforehand
  Numbering numbering = Numbering::bins;
};

/// The coarsest scalar of 1, -10, -100, -1000, -10000 that keeps every coordinate, depth and midpoint
/// exactly; where none does, the finest whose words fit 32 bits. Bins are half the smallest distance between
/// receivers of consecutive traces of a shot (1 m where there is only one receiver), across lines of
/// receivers at most half the smallest distance between two of them: no line has the number of another.
/// Numbering counts shots where all midpoints lie in one bin of y. Throws Error when a coordinate is not
/// finite or does not fit 32 bits in whole metres.
SurveyLayout layout_of(std::span<const TraceHeader> headers);

/// Number of the bin of width bin_m whose centre is nearest to the midpoint: 1 for 0 m, 2 for bin_m, ...
/// and -1 for -bin_m; there is no bin 0, which readers take for "unknown".
std::int64_t bin_of(double midpoint_m, double bin_m);

/// All words that follow from header and layout (a bin that is given goes first); counters, ns, dt and delrt
/// stay 0. Throws Error naming a word that overflows.
TraceWords words_from_si(const TraceHeader& header, const SurveyLayout& layout);

/// The inverse, for any file: scalars applied, feet made metres. Source z is its depth below the surface
/// minus the surface's elevation, receiver z minus the receiver's elevation. Coordinates in arc (counit 2 to
/// 4) stay as they are. Words of extension 1 that are not 0 go first; they have no scalars.
TraceHeader si_from_words(const TraceWords& words, const FileHeader& file,
                          const std::optional<ExtensionWords>& extension = {});

/// Whether traces say where sources and receivers are.
struct PositionsGiven {
  bool source = true, receiver = true;
  bool anything = true;  // false: all that could say it is 0
};

/// What a scalar of lengths may be: 1, 10, 100, 1000 or 10000, negative ones of them, or 0.
bool is_length_scalar(std::int64_t word);

/// Units of coordinates (byte 89) that are not lengths but arcs: "seconds of arc", "degrees" or "degrees,
/// minutes and seconds, DDDMMSS.ss"; "" of lengths.
std::string arc_of(const TraceWords& words);

/// What a trace says of its place beside the coordinates of its ends.
struct PlaceWords {
  double offset_m = 0;                 // byte 37: receiver minus source, signed
  double unit_m = 1;                   // of that word
  std::array<double, 2> midpoint_m{};  // bytes 181 to 188, since revision 1
};
PlaceWords place_words(const TraceWords& words, const FileHeader& file,
                       const std::optional<ExtensionWords>& extension = {});

/// An end may lack its position: its x and y are 0, and the distance of both ends is not that of byte 37. A
/// source at 0 lacks it only where byte 37 says something, both also where the midpoint is elsewhere.
PositionsGiven positions_given(const TraceHeader& header, const PlaceWords& place);

/// Puts an end whose position is not given at the offset along x from the other one, both about the midpoint
/// where neither is given.
void place_missing(TraceHeader& header, const PositionsGiven& given, const PlaceWords& place);

/// Time of the first sample (delrt and, since revision 1, its scalar).
double start_s(const TraceWords& words, const FileHeader& file);

/// `value` times a scalar word: positive multiplies, negative divides, 0 is 1.
double scaled(std::int64_t value, std::int64_t scalar);

/// Fills bytes 181 to 240 of a trace that had none (Seismic Unix) from the others: midpoint, bin, shot point,
/// unit.
void fill_revision_1(TraceWords& words);

}  // namespace slipwave::segy
