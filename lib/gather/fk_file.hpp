// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "gather/fk_spectrum.hpp"
#include "io/output_file.hpp"

namespace slipwave {

/// What a file of f-k spectra says about them.
struct FkFacts {
  SampleAxis axis;
  SpectrumSettings settings;
  std::string history;              // commands, one a line
  std::vector<std::string> source;  // lines that say where the traces come from
};

/// UDUNITS name of an f-k spectrum's unit: "m s-1 Hz-1 m", "(m s-1)^2 s Hz-1 m2"; "" for components
/// without.
std::string fk_unit(Component component, bool power);

/// netCDF-4: frequency(frequency) in Hz, wavenumber(wavenumber) in m-1, or phase_velocity(phase_velocity) in
/// m s-1, and a variable a component, vz(wavenumber, frequency). Commits the output.
void write_fk_netcdf(OutputFile& out, const FkFacts& facts, const FkSpectra& spectra);

/// Columns: wavenumber or phase velocity, frequency and one column a component; an empty line after each
/// wavenumber. Commits.
void write_fk_text(OutputFile& out, const FkFacts& facts, const FkSpectra& spectra);

}  // namespace slipwave
