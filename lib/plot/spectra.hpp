// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gather/trace.hpp"

namespace slipwave {
class NetcdfFile;
}

namespace slipwave::plot {

/// What a file of sw-spectrum holds: spectra of components, or of one component at many places, which are
/// traces, wavenumbers or phase velocities.
struct Spectra {
  struct Line {
    std::string name, unit;  // "vz", "m/s/Hz"
    std::vector<double> values;
  };
  std::string name;      // of the file, without folders
  std::string quantity;  // "amplitude" or "energy density"
  std::vector<double> frequencies_hz;
  std::vector<Line> lines;     // of a component each, or all of one component, in ascending order of places
  std::vector<double> places;  // empty: the lines are of components
  enum class Place { trace_number, receiver_x, wavenumber, phase_velocity } place = Place::trace_number;
  bool each() const { return !places.empty(); }
};

/// `component`: of these traces, or this component's mean, only. Without it, all components of means, and of
/// traces and of f-k those of the first one's. Traces stand at the x of their receivers where these ascend,
/// else one after the other. Throws Error naming the file when it holds no such spectra.
Spectra read_spectra(const NetcdfFile& file, const std::optional<Component>& component);

}  // namespace slipwave::plot
