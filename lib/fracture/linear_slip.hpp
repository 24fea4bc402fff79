// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

/// Linear slip (Schoenberg 1980, J. Acoust. Soc. Am. 68(5)): planes that give by as much as their traction
/// says, as springs, with a dashpot beside each where there is one (docs/theory/fractures.md).
namespace slipwave {

/// Constants of one family of planes: either of each plane and their spacing, or of cracks.
struct LinearCompliance {
  double normal_m_per_pa = 0, tangential_m_per_pa = 0;              // of a plane, Z_N and Z_T
  double normal_dashpot_pa_s_m = 0, tangential_dashpot_pa_s_m = 0;  // of a plane, Pa s/m
  double spacing_m = 0;                                             // of planes
  double crack_density = 0;  // number of penny-shaped cracks in a unit volume times the cube of their radius
  double aspect = 0;         // thickness over diameter
  double fill_pa = 0;        // bulk modulus of what fills them, 0: dry

  bool gives() const { return normal_m_per_pa > 0 || tangential_m_per_pa > 0 || crack_density > 0; }
  bool damped() const {
    return (normal_m_per_pa > 0 && normal_dashpot_pa_s_m > 0) ||
           (tangential_m_per_pa > 0 && tangential_dashpot_pa_s_m > 0);
  }
};

/// The compliance of a cell: strain for traction, 1/Pa, and the damping: traction for strain rate, Pa s.
struct CellCompliance {
  double normal = 0, tangential = 0;
  double normal_damping = 0, tangential_damping = 0;
};

/// Returns the compliance of planes in rock with these Lame parameters, Pa. Cracks add to the compliance what
/// Hudson's (1981) theory takes off the stiffness in first order of their density (S21).
inline CellCompliance compliance_in(const LinearCompliance& of, double lambda, double mu) {
  if (of.crack_density > 0) {
    const double stiffness_of_fill =
        of.fill_pa > 0 ? of.fill_pa * (lambda + 2 * mu) / (M_PI * of.aspect * mu * (lambda + mu)) : 0;
    return {4. / 3 * of.crack_density * (lambda + 2 * mu) / (mu * (lambda + mu)) / (1 + stiffness_of_fill),
            16. / 3 * of.crack_density * (lambda + 2 * mu) / (mu * (3 * lambda + 4 * mu)), 0, 0};
  }
  if (!of.gives()) return {};
  return {of.normal_m_per_pa / of.spacing_m, of.tangential_m_per_pa / of.spacing_m,
          of.normal_dashpot_pa_s_m * of.spacing_m, of.tangential_dashpot_pa_s_m * of.spacing_m};
}

/// Returns the compliance of planes in a share of the cell, which carry the traction of all of it (S38).
inline CellCompliance in_share(const CellCompliance& of, double share) {
  return {of.normal * share, of.tangential * share, of.normal_damping / share, of.tangential_damping / share};
}

namespace slip {

/// Softer planes than this, times the stiffness of the rock, count as free.
inline constexpr double most_compliance = 1e7;

/// Springs of planes that give at most so many times as much as the rock.
inline CellCompliance bounded(CellCompliance of, double lambda, double mu, double most = most_compliance) {
  of.normal = std::min(of.normal, most / (lambda + 2 * mu));
  of.tangential = std::min(of.tangential, most / mu);
  return of;
}

/// What a spring, with a dashpot beside it, in rock of modulus m takes off the traction at the end of a step
/// in which the load grows steadily (S20): r' = left r + of_start t_s + of_end t_s', where t_s is the
/// traction that welded planes would carry. Exact.
struct SpringStep {
  double left = 0, of_start = 0, of_end = 0;
  /// What 1 Pa less of traction, by slip on the planes, takes off r.
  double follows = 0;
};
/// `compliance` in 1/Pa, `damping` in Pa s.
inline SpringStep spring_step(double modulus_pa, double compliance, double damping_pa_s, double dt_s) {
  const double soft = std::min(modulus_pa * compliance, most_compliance);
  if (!(soft > 0)) return {};
  const double share = soft / (1 + soft), time_s = damping_pa_s * compliance / (1 + soft);
  double left = 0, mean = 0;  // exp(-x) and (1 - exp(-x))/x
  if (time_s > 0) {
    const double x = dt_s / time_s;
    left = std::exp(-x);
    mean = x > 0 ? -std::expm1(-x) / x : 1;
  }
  const double of_end = share * (1 - mean);
  return {left, share * (mean - left), of_end, time_s > 0 ? of_end / (1 - of_end) : soft};
}

/// Shear modulus of a cell for slip that continues steadily through a step while springs in line with it give
/// way: mu where there are none.
inline double modulus_above_springs(double mu, double follows) { return mu / (1 + follows); }

}  // namespace slip

}  // namespace slipwave
