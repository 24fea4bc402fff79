// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gather/spectrum.hpp"
#include "gather/trace.hpp"
#include "io/output_file.hpp"

namespace slipwave {

/// What a file of spectra says about them.
struct SpectrumFacts {
  std::vector<double> frequencies_hz;
  bool power = false;
  std::string definition;           // window, padding and formula in words (definition_of)
  std::string history;              // commands, one a line
  std::vector<std::string> source;  // lines that say where the traces come from
};

/// "energy spectral density 2 |F|^2, ...; window hann; 1200 zeros appended to 800 samples".
std::string definition_of(const SampleAxis& axis, const SpectrumSettings& settings, std::size_t length);

/// UDUNITS name of a spectrum's unit: "m s-1 Hz-1", "(m s-1)^2 s Hz-1"; "" for components without unit.
std::string spectrum_unit(Component component, bool power);

/// A file of spectra in the making: either one spectrum a trace, in the order of calls, or means.
class SpectrumFile {
 public:
  virtual ~SpectrumFile() = default;
  /// The spectrum of one trace: as many values as there are frequencies.
  virtual void add(const TraceHeader& header, std::span<const double> values) = 0;
  /// The mean over all traces of each component.
  virtual void add_means(const std::map<Component, SpectrumMean>& means) = 0;
  /// Writes what is left and commits the output.
  virtual void finish() = 0;
};

/// Columns: frequency and one column a component for means; else a block of two columns a trace, blocks two
/// empty lines apart. Lines that start with # say what is what.
std::unique_ptr<SpectrumFile> spectrum_text(OutputFile& out, const SpectrumFacts& facts);

/// netCDF-4: frequency(frequency); a variable a component for means ("vz"), else amplitude(trace, frequency)
/// (or power) with shot, channel, component and positions of the traces.
std::unique_ptr<SpectrumFile> spectrum_netcdf(OutputFile& out, const SpectrumFacts& facts);

}  // namespace slipwave
