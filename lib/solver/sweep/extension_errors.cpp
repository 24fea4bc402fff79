// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/extension_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/band_system.hpp"
#include "solver/kernels/reconstruction.hpp"
#include "solver/sweep/stencils.hpp"

namespace slipwave::solver {
namespace {

/// Cells on each side that may lie off the slopes. In the last of them less than a thousandth is left of the
/// error in the first at Courant numbers from 0.1 on.
constexpr int rows = 16;
/// v of these cells, then s.
constexpr int unknowns = 4 * rows;

constexpr std::size_t place(std::int64_t n) { return std::size_t(n); }

/// Cells in a line, from -1 on before a face and from 0 on behind it; beyond `rows` on each side those with
/// the slopes themselves.
class Column {
 public:
  Column(const SweepsAcross& of, const PairBeside<double>& slopes)
      : of_(&of),
        slopes_(&slopes),
        reach_(reach_of(of.order)),
        held_(rows + 1 + reach_),
        v_(2 * std::size_t(held_)),
        s_(v_.size()) {
    for (int n = -held_; n < held_; ++n)
      v(n) = slopes.v[side(n)] * (n + 0.5), s(n) = slopes.s[side(n)] * (n + 0.5);
  }
  /// The values that may lie off, and whether there is anything.
  double& off(int n) { return n < 2 * rows ? v(n - rows) : s(n - 3 * rows); }
  bool any(int n) const { return !empty(n % (2 * rows) - rows); }

  /// A whole step, from the middle of what runs along its first axis.
  void step() {
    const int along = of_->axis == 0 ? of_->of_step[1].axis : 0;
    for (const auto& sweep : of_->of_step) {
      if (sweep.axis == of_->axis)
        across(sweep.fraction);
      else if (sweep.axis == along)
        take_away(sweep.fraction);
    }
  }

 private:
  static std::size_t side(int n) { return n < 0 ? 0 : 1; }
  double& v(int n) { return v_[std::size_t(std::int64_t(held_) + n)]; }
  double& s(int n) { return s_[std::size_t(std::int64_t(held_) + n)]; }
  double impedance(int n) const { return of_->impedance[side(n)]; }
  double courant(int n) const { return of_->courant[side(n)]; }
  bool empty(int n) const { return impedance(n) == 0; }

  /// v and s change with the differences of the other.
  void add(int n, double fraction, double of_s, double of_v) {
    v(n) += fraction * courant(n) / impedance(n) * of_s;
    s(n) += fraction * courant(n) * impedance(n) * of_v;
  }
  void take_away(double fraction) {
    for (int n = -held_; n < held_; ++n)
      if (!empty(n)) add(n, -fraction, slopes_->s[side(n)], slopes_->v[side(n)]);
  }
  /// A sweep across, which back in time is one forward of -v.
  void across(double fraction) {
    const auto turn = [&] {
      if (fraction < 0)
        for (auto& motion : v_) motion = -motion;
    };
    turn();
    forward(std::abs(fraction), fraction < 0 ? -1 : 1);
    turn();
  }
  /// Cells with the slopes, those of v times `turned`, keep them.
  void forward(double fraction, double turned) {
    std::array<double, 2 * rows + 2> up{}, down{};
    for (int n = -rows - 1; n <= rows; ++n)
      if (!empty(n)) reconstruct(n, fraction, up[place(n + rows + 1)], down[place(n + rows + 1)]);
    std::array<double, 2 * rows + 1> motion{}, traction{};
    for (int face = -rows; face <= rows; ++face) {
      const auto k = place(face + rows);
      const double before = impedance(face - 1), behind = impedance(face);
      if (before + behind == 0) continue;
      motion[k] = (up[k] + down[k + 1]) / (before + behind);
      traction[k] = (before * down[k + 1] - behind * up[k]) / (before + behind);
    }
    for (int n = -held_; n < held_; ++n) {
      if (empty(n)) continue;
      const auto k = place(n + rows);
      if (n >= -rows && n < rows)
        add(n, fraction, traction[k + 1] - traction[k], motion[k + 1] - motion[k]);
      else
        add(n, fraction, slopes_->s[side(n)], turned * slopes_->v[side(n)]);
    }
  }
  void reconstruct(int n, double fraction, double& up, double& down) {
    const int cells = n < 0 ? -1 - n : n;
    at_order_reaching(reach_up_to(cells, most_reach_at_contrasts, reach_), [&]<int Order>() {
      constexpr int reach = reach_of(Order);
      std::array<double, std::size_t(2 * reach + 1)> v_about, s_about;
      const double share = impedance(-1 - n) / (of_->impedance[0] + of_->impedance[1]);
      for (int k = -reach; k <= reach; ++k) {
        // (E10); a cell on this side is its own.
        const int at = n + k, own = side(at) == side(n) ? at : -1 - at;
        v_about[place(k + reach)] = v(own) + 2 * share * (v(at) - v(own));
        s_about[place(k + reach)] = s(own) + 2 * (1 - share) * (s(at) - s(own));
      }
      reconstruct_cell<Order>(&v_about[reach], &s_about[reach], 1, impedance(n), fraction * courant(n), up,
                              down);
    });
  }

  const SweepsAcross* of_;
  const PairBeside<double>* slopes_;
  int reach_, held_;
  std::vector<double> v_, s_;
};

}  // namespace

/// A step is linear in what cells lie off and leaves that as it is: one system of equations.
PairBeside<std::vector<double>> extension_errors(const SweepsAcross& of, const PairBeside<double>& slopes) {
  Column exact(of, slopes);
  auto stepped = exact;
  stepped.step();
  BandSystem<unknowns> equations(unknowns);
  for (int n = 0; n < unknowns; ++n) {
    const auto column = std::size_t(n);
    equations.at(column, column) = 1;
    if (!exact.any(n)) continue;
    auto lies_off = exact;
    lies_off.off(n) += 1;
    lies_off.step();
    for (int k = 0; k < unknowns; ++k)
      equations.at(std::size_t(k), column) -= lies_off.off(k) - stepped.off(k);
    equations.right(column) = stepped.off(n) - exact.off(n);
  }
  const auto found = equations.solve();
  PairBeside<std::vector<double>> errors;
  for (int n = 0; n < rows; ++n)
    for (const std::size_t side : {0, 1}) {
      const auto at = std::size_t(side == 0 ? rows - 1 - n : rows + n);
      errors.v[side].push_back(found[at].real());
      errors.s[side].push_back(found[at + 2 * std::size_t(rows)].real());
    }
  return errors;
}

}  // namespace slipwave::solver
