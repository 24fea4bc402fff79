// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"

namespace slipwave {

/// Linear slip as a command line says it: of planes a compliance ZN,ZT in m/Pa or a stiffness KN,KT in Pa/m,
/// their spacing and dashpots DN,DT in Pa s/m; or of cracks.
struct ComplianceText {
  std::string compliance, stiffness, dashpot;
  std::optional<double> spacing_m, crack_density, aspect, fill_pa;

  bool given() const;
};

/// Throws a usage Error that names the option where a value is out of range, something is missing, or two
/// options contradict each other. Single fractures have no spacing.
LinearCompliance parse_compliance(const ComplianceText& text, bool single = false);

}  // namespace slipwave
