// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

namespace slipwave::plot {

/// The three properties that every model has, in one cell: m/s, m/s, kg/m3.
struct ElasticCell {
  double vp = 0, vs = 0, rho = 0;
};

/// A property that follows from those of the model.
struct DerivedProperty {
  const char* name;   // as it is typed
  const char* label;  // as pictures show it
  const char* unit;
  bool of_vp, of_vs, of_rho;            // what it is made of
  double (*value)(const ElasticCell&);  // NaN where there is none
};

/// vp/vs (none in fluids), poisson: (vp^2 - 2 vs^2) / (2 (vp^2 - vs^2)), 1/2 in fluids, impedance rho vp and
/// shear-impedance rho vs (Aki and Richards 2002, tables 2.2 and 5.2).
std::span<const DerivedProperty> derived_properties();

/// Nothing where none has this name.
std::optional<DerivedProperty> find_derived_property(const std::string& name);

}  // namespace slipwave::plot
