// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/extension_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/kernels/reconstruction.hpp"
#include "solver/sweep/stencils.hpp"

namespace slipwave::solver {
namespace {

/// Cells below the surface, behind which the motion is the linear one. What is left of the errors there is
/// below a millionth at Courant numbers from 0.1 on.
constexpr int rows = 32;
/// Steps until nothing changes, in cells of slope.
constexpr double settled = 1e-7;
constexpr int most_steps = 20000;

/// Motion and traction of impedance 1 of cells below a surface, images and the linear motion around them.
class Column {
 public:
  explicit Column(int reach)
      : reach_(reach), v_(std::size_t(rows) + 1 + 2 * std::size_t(reach)), s_(v_.size()) {
    for (int n = 0; n < rows + 1 + reach; ++n) v(n) = n + 0.5;
  }
  double& v(int n) { return v_[std::size_t(std::int64_t(reach_) + n)]; }

  /// Sweeps along the surface take this away from all tractions.
  void unload(double load) {
    for (auto& traction : s_) traction -= load;
  }
  /// A sweep across the surface, back in time where the Courant number is negative.
  void sweep(double courant) {
    if (courant < 0) turn();
    forwards(std::abs(courant));
    if (courant < 0) turn();
  }

 private:
  double& s(int n) { return s_[std::size_t(std::int64_t(reach_) + n)]; }
  void turn() {
    for (auto& motion : v_) motion = -motion;
  }
  void forwards(double courant) {
    for (int n = 1; n <= reach_; ++n) v(-n) = v(n - 1), s(-n) = -s(n - 1);
    std::vector<double> up(rows + 1), down(rows + 1);
    for (int n = 0; n <= rows; ++n)
      at_order_reaching(reach_up_to(n, most_reach_at_contrasts, reach_), [&]<int Order>() {
        reconstruct_cell<Order>(&v(n), &s(n), 1, 1., courant, up[std::size_t(n)], down[std::size_t(n)]);
      });
    double motion = down[0], traction = 0;
    const double linear = v(rows + 1) - v(rows);
    for (int n = 0; n < rows; ++n) {
      const double below_v = (up[std::size_t(n)] + down[std::size_t(n) + 1]) / 2,
                   below_s = (down[std::size_t(n) + 1] - up[std::size_t(n)]) / 2;
      v(n) += courant * (below_s - traction), s(n) += courant * (below_v - motion);
      motion = below_v, traction = below_s;
    }
    for (int n = rows; n < rows + 1 + reach_; ++n) s(n) += courant * linear;
  }

  int reach_;
  std::vector<double> v_, s_;
};

}  // namespace

std::vector<double> extension_errors(const SurfaceSweeps& of) {
  Column column((of.order - 1) / 2);
  double before = column.v(0);
  for (int step = 0; step < most_steps; ++step) {
    // The load of a step is that of sweeps along one axis, those beside the last one or the first.
    const int loading = of.axis == 0 ? of.of_step[1].axis : 0;
    for (const auto& sweep : of.of_step) {
      if (sweep.axis == of.axis)
        column.sweep(sweep.fraction * of.courant);
      else if (sweep.axis == loading)
        column.unload(sweep.fraction * of.courant);
    }
    if (step > 0 && std::abs(column.v(0) - before) < settled * of.courant) break;
    before = column.v(0);
  }
  std::vector<double> errors(rows);
  for (int n = 0; n < rows; ++n) errors[std::size_t(n)] = column.v(n) - (n + 0.5);
  return errors;
}

}  // namespace slipwave::solver
