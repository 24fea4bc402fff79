// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "acquisition/survey.hpp"

namespace slipwave {

/// All that the house knows of a kind of source: with a row of its own it is known to options, their help and
/// errors, and the solver injects it.
template <int D>
struct SourceKind {
  const char* name;            // "force"
  const char* parameters;      // what stands behind the colon, "AX,AZ"; "" without one
  const char* remark;          // for the help of options; ""
  const char* amplitude_unit;  // "N/m"
  /// Reads the parameters. `text` is the whole, for errors; throws a usage Error.
  Mechanism<D> (*parse)(const std::string& text, const std::string& parameters);
  /// Sets what a source of that amplitude injects per unit of its wavelet. Null where it is no point source.
  void (*inject)(const Mechanism<D>& mechanism, double amplitude, PointInjection<D>& injection);
};

/// The first rows are the alternatives of Mechanism, in their order; others are parsed to one of those.
template <int D>
std::span<const SourceKind<D>> source_kinds();

/// "explosion, force:AX,AZ, ... (degrees, 0 is down); in 3-D force:AX,AY,AZ, ...": for the help of an option.
std::string source_kind_help();
/// "explosion, moment: N m/s per m; ...; in 3-D ...": units of the amplitude, for the help of an option.
std::string amplitude_help();

}  // namespace slipwave
