// SPDX-License-Identifier: BSD-3-Clause
#include "solver/sweep/extension_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "base/band_system.hpp"
#include "solver/kernels/reconstruction.hpp"
#include "solver/sweep/interface_corrections.hpp"
#include "solver/sweep/stencils.hpp"

namespace slipwave::solver {
namespace {

/// Cells on each side that may lie off the slopes. In the last of them less than a thousandth is left of the
/// error in the first at Courant numbers from 0.1 on.
constexpr int rows = 16;
/// v of these cells, then s.
constexpr int unknowns = 4 * rows;

constexpr std::size_t place(std::int64_t n) { return std::size_t(n); }

/// Rows of what a sweep makes of the values of all cells; sweeps by their part of the step.
using Matrix = std::vector<std::vector<double>>;
using AdjointSweeps = std::map<double, Matrix>;

/// Cells in a line, from -1 on before a face and from 0 on behind it; beyond `rows` on each side those with
/// the slopes themselves, and as far as sweeps of these read what is swept.
class Column {
 public:
  Column(const SweepsAcross& of, const SlopesBeside& slopes, const std::array<double, 2>& known,
         AdjointSweeps& adjoint)
      : of_(&of),
        slopes_(&slopes),
        reach_(reach_of(of.order)),
        swept_(rows + reach_ + 1),
        held_(swept_ + 1 + reach_),
        v_(2 * std::size_t(held_)),
        s_(v_.size()),
        adjoint_(&adjoint) {
    for (int n = -held_; n < held_; ++n)
      v(n) = slopes.v[side(n)] * (n + 0.5), s(n) = slopes.s[side(n)] * (n + 0.5);
    const auto &z = of.impedance, &c = of.courant;
    const double both = z[0] + z[1];
    bend_ = (z[0] * known[0] - z[1] * known[1]) / both;
    const double share = of.beside_void ? 1 : traction_share;
    left_ = share / 2 * (c[1] * z[1] * known[1] - c[0] * z[0] * known[0]);
  }
  /// The values that may lie off, and whether there is anything.
  double& off(int n) { return n < 2 * rows ? v(n - rows) : s(n - 3 * rows); }
  bool any(int n) const { return !empty(n % (2 * rows) - rows); }

  /// A whole step, from the middle of what runs along its first axis; where sweeps across end a step, from
  /// before the last one, which the first one of the next step is made together with.
  void step() {
    double together = part_recorded(*of_);
    const auto last = of_->of_step.end() - (together == 0 ? 0 : 1);
    for (auto sweep = of_->of_step.begin(); sweep != last; ++sweep) {
      if (sweep->axis == of_->axis)
        across(sweep->fraction + std::exchange(together, 0));
      else if (sweep->axis == of_->along)
        note_v(sweep->fraction), take_away(sweep->fraction);
    }
  }
  /// The part of a step that the sweep across takes by which records leave the state that step() begins with,
  /// or 0 where it is recorded itself.
  static double part_recorded(const SweepsAcross& of) {
    return of.merges && of.of_step.back().axis == of.axis ? of.of_step.back().fraction : 0;
  }
  /// The mean of a value of v that sweeps along the face have found.
  double found_v(int n) const { return found_v_[place(n + rows)]; }
  /// What sweeps along the face leave, which cells with the slopes want sweeps across to give back.
  void take_away(double fraction) {
    for (int n = -held_; n < held_; ++n)
      if (!empty(n)) add(n, -fraction, slopes_->s[side(n)], slopes_->v[side(n)]);
  }
  /// A sweep across, which back in time is one forward of -v.
  void across(double fraction) {
    const auto turn = [&] {
      if (fraction > 0) return;
      for (auto& motion : v_) motion = -motion;
      bend_ = -bend_, left_ = -left_;
    };
    turn();
    const double turned = fraction < 0 ? -1 : 1;
    if (of_->adjoint)
      adjoint(std::abs(fraction), turned);
    else
      forward(std::abs(fraction), turned);
    turn();
  }

 private:
  static std::size_t side(int n) { return n < 0 ? 0 : 1; }
  double& v(int n) { return v_[std::size_t(std::int64_t(held_) + n)]; }
  double& s(int n) { return s_[std::size_t(std::int64_t(held_) + n)]; }
  void note_v(double fraction) {
    for (int n = -rows; n < rows; ++n) found_v_[place(n + rows)] += fraction * v(n);
  }
  double impedance(int n) const { return of_->impedance[side(n)]; }
  double courant(int n) const { return of_->courant[side(n)]; }
  bool empty(int n) const { return impedance(n) == 0; }

  /// v and s change with the differences of the other.
  void add(int n, double fraction, double of_s, double of_v) {
    v(n) += fraction * courant(n) / impedance(n) * of_s;
    s(n) += fraction * courant(n) * impedance(n) * of_v;
  }
  /// Cells with the slopes, those of v times `turned`, keep them.
  void forward(double fraction, double turned) {
    std::vector<double> up(place(2 * swept_ + 2)), down(up), motion(up), traction(up);
    for (int n = -swept_ - 1; n <= swept_; ++n)
      if (!empty(n)) reconstruct(n, fraction, up[place(n + swept_ + 1)], down[place(n + swept_ + 1)]);
    for (int face = -swept_; face <= swept_; ++face) {
      const auto k = place(face + swept_);
      const double before = impedance(face - 1), behind = impedance(face);
      if (before + behind == 0) continue;
      motion[k] = (up[k] + down[k + 1]) / (before + behind);
      traction[k] = (before * down[k + 1] - behind * up[k]) / (before + behind);
    }
    for (int n = -held_; n < held_; ++n) {
      if (empty(n)) continue;
      const auto k = place(n + swept_);
      if (n >= -swept_ && n < swept_)
        add(n, fraction, traction[k + 1] - traction[k], motion[k + 1] - motion[k]);
      else
        add(n, fraction, slopes_->s[side(n)], turned * slopes_->v[side(n)]);
    }
  }
  /// The sweep that is adjoint in the energy of the fields, which weighs v with Z/c and s with 1/(Z c), run
  /// back in time: what it makes of the values of all cells, v first.
  void adjoint(double fraction, double turned) {
    auto& sweep = (*adjoint_)[fraction];
    if (sweep.empty()) sweep = adjoint_sweep(fraction);
    auto values = v_;
    values.insert(values.end(), s_.begin(), s_.end());
    for (int n = -held_; n < held_; ++n) {
      if (empty(n)) continue;
      if (n >= -rows && n < rows)
        v(n) = dot(sweep[place(held_ + n)], values), s(n) = dot(sweep[place(3 * held_ + n)], values);
      else
        add(n, fraction, slopes_->s[side(n)], turned * slopes_->v[side(n)]);
    }
  }
  static double dot(const std::vector<double>& row, const std::vector<double>& values) {
    return std::inner_product(row.begin(), row.end(), values.begin(), 0.);
  }
  Matrix adjoint_sweep(double fraction) const {
    const SlopesBeside none;
    const int all = 2 * held_;
    const auto energy = [&](int value) {
      const int n = value % all - held_;
      return (value < all ? impedance(n) : 1 / impedance(n)) / courant(n);
    };
    const auto values = 2 * place(all);
    Matrix sweep(values, std::vector<double>(values));
    for (int from = 0; from < 2 * all; ++from) {
      if (empty(from % all - held_)) continue;
      Column column(*of_, none, {}, *adjoint_);
      (from < all ? column.v_ : column.s_)[place(from % all)] = 1;
      column.forward(fraction, 1);
      for (int to = 0; to < 2 * all; ++to) {
        const double value = (to < all ? column.v_ : column.s_)[place(to % all)];
        const double back = (from < all) == (to < all) ? 1 : -1;
        if (value != 0) sweep[place(from)][place(to)] = back * value * energy(to) / energy(from);
      }
    }
    return sweep;
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
        if (own == at) continue;
        // (E11a)
        v_about[place(k + reach)] += std::abs(2 * at + 1) * bend_;
        s_about[place(k + reach)] += (n < 0 ? 2 : -2) * (1 - share) * fraction * left_;
      }
      reconstruct_cell<Order>(&v_about[reach], &s_about[reach], 1, impedance(n), fraction * courant(n), up,
                              down);
    });
  }

  const SweepsAcross* of_;
  const SlopesBeside* slopes_;
  int reach_, swept_, held_;
  double bend_ = 0, left_ = 0;  // of v and s in extensions
  std::vector<double> v_, s_;
  std::array<double, 2 * std::size_t(rows)> found_v_{};
  AdjointSweeps* adjoint_;
};

/// A step is linear in what cells lie off and leaves that as it is: one system of equations.
ExtensionErrors found_errors(const SweepsAcross& of, const SlopesBeside& slopes,
                             const std::array<double, 2>& known) {
  AdjointSweeps adjoint;
  Column recorded(of, slopes, known, adjoint);
  const double part = Column::part_recorded(of);
  auto exact = recorded;
  if (part != 0) exact.take_away(part);
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
  auto lies_off = exact;
  for (int n = 0; n < unknowns; ++n) lies_off.off(n) += found[std::size_t(n)].real();
  auto following = lies_off;
  following.step();
  if (part != 0) lies_off.across(part);
  const auto error = [&](int n) {
    return part == 0 ? found[std::size_t(n)].real() : lies_off.off(n) - recorded.off(n);
  };
  ExtensionErrors errors;
  for (int n = 0; n < rows; ++n)
    for (const std::size_t side : {0, 1}) {
      const int at = side == 0 ? rows - 1 - n : rows + n;
      errors.v[side].push_back(error(at));
      errors.s[side].push_back(error(at + 2 * rows));
      errors.v_found[side].push_back(following.found_v(at - rows) - slopes.v[side] * (at - rows + 0.5));
    }
  return errors;
}

}  // namespace

/// Many points ask for those of one interface, so each thread keeps some.
ExtensionErrors extension_errors(const SweepsAcross& of, const SlopesBeside& slopes,
                                 const std::array<double, 2>& known) {
  constexpr std::size_t most_kept = 256;
  thread_local std::map<std::vector<double>, ExtensionErrors> kept;
  std::vector<double> asked{double(of.order),   double(of.axis),   double(of.along),
                            double(of.adjoint), double(of.merges), double(of.beside_void)};
  for (const auto& pair : {of.impedance, of.courant, slopes.v, slopes.s, known})
    asked.insert(asked.end(), pair.begin(), pair.end());
  for (const auto& sweep : of.of_step) asked.insert(asked.end(), {double(sweep.axis), sweep.fraction});
  const auto found = kept.find(asked);
  if (found != kept.end()) return found->second;
  if (kept.size() == most_kept) kept.clear();
  return kept[asked] = found_errors(of, slopes, known);
}

}  // namespace slipwave::solver
