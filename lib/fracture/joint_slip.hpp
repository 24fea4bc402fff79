// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fracture/friction_policy.hpp"
#include "fracture/plane_response.hpp"
#include "grid/tensor.hpp"

namespace slipwave {

template <int D, class Real>
using Stress = SymmetricTensor<D, Real>;
template <int D, class Real>
using Traction = std::array<Real, std::size_t(D)>;

/// s += factor (change n + n change).
template <int D, class Real>
void add_shear(Stress<D, Real>& s, Real factor, const Traction<D, Real>& change, const Traction<D, Real>& n) {
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      s(i, j) +=
          factor * (change[std::size_t(i)] * n[std::size_t(j)] + change[std::size_t(j)] * n[std::size_t(i)]);
}

/// Any number of slip systems in one cell, in any directions: blocks in 3-D, planes that cross at any angle.
/// Each takes off the shear traction that the others leave, round after round to and fro, until nothing
/// changes (S12): at most `most_rounds` times, and energy falls in each of them. With a law that has a state
/// the rounds are made again at the strengths of the end.
template <int D, class Real, class Law>
class JointSlip {
 public:
  struct System {
    Traction<D, Real> normal;
    FrictionConstants<Real> law;
  };
  static constexpr int most_rounds = 24;
  static constexpr std::size_t most_systems = D;

  /// What the systems of a cell have besides its stress, by system.
  struct Cell {
    const Real* relaxation;  // c
    const bool* open;        // whether the planes are open
    // Of laws with a state: slip so far, and h/mu.
    Real* slip_m = nullptr;
    Real slip_per_pa = 0;
    // Of planes askew to the axes of anisotropic rock, by system. Null: n tau + tau n.
    const PlaneResponse<D, Real>* response = nullptr;
  };

  JointSlip(SlipCorrection correction, std::vector<System> systems)
      : correction_(correction), systems_(std::move(systems)) {}
  /// Lets the planes of one cell slip at the end of an elastic step: `s` is its stress, `total` that with the
  /// prestress.
  void slip(Stress<D, Real>& s, Stress<D, Real> total, const Cell& cell) const {
    const Stress<D, Real> before = total;
    if (correction_ == SlipCorrection::exponential)
      for (std::size_t n = systems_.size(); n-- > 0;) end_half(n, cell, total);
    else
      relax(total, cell);
    add(s, before, total);
  }
  /// The explicit half, with which the next step begins.
  void begin(Stress<D, Real>& s, Stress<D, Real> total, const Cell& cell) const {
    if (correction_ == SlipCorrection::first) return;
    const Stress<D, Real> before = total;
    for (std::size_t n = 0; n < systems_.size(); ++n) {
      const bool exponential = correction_ == SlipCorrection::exponential;
      const auto on = resolved(n, cell, exponential ? total : before);
      const Real loss =
          exponential ? half_loss(n, cell, on, on.strength)
                      : slip::explicit_half(on.size, on.strength, cell.relaxation[n], int(systems_.size()));
      take_off(n, on, loss, cell, total);
    }
    add(s, before, total);
  }

 private:
  /// The traction on the planes of one system, its size, the normal stress and the strength.
  struct Resolved {
    Traction<D, Real> tau;
    Real size, s_n, strength;
  };
  using Losses = std::array<Traction<D, Real>, most_systems>;
  using Strengths = std::array<Real, most_systems>;

  Resolved resolved(std::size_t n, const Cell& cell, const Stress<D, Real>& s) const {
    Resolved on;
    on.s_n = resolve<D, Real>(systems_[n].normal, s, on.tau);
    on.size = length<D, Real>(on.tau);
    on.strength = cell.open[n] ? Real(0) : Law::strength(systems_[n].law, on.s_n, slip_of(n, cell));
    return on;
  }
  static Real slip_of(std::size_t n, const Cell& cell) {
    if constexpr (Law::has_state) return cell.slip_m[n];
    return 0;
  }
  /// Strength at the end of a step in which the slip of a system takes off so much, theta c being `weighted`.
  Real strength_at_end(std::size_t n, const Cell& cell, const Resolved& on, Real loss, Real weighted) const {
    if (cell.open[n]) return 0;
    return Law::strength_at_end(systems_[n].law, on.s_n, slip_of(n, cell), cell.slip_per_pa, loss,
                                weighted / std::max(on.strength + weighted, slip::least<Real>));
  }
  void note_slip(std::size_t n, Real loss, const Cell& cell) const {
    if constexpr (Law::has_state) cell.slip_m[n] = Law::slip_after(cell.slip_m[n], cell.slip_per_pa, loss);
  }
  void take_off(std::size_t n, const Resolved& on, Real loss, const Cell& cell, Stress<D, Real>& s) const {
    if (!(loss > 0)) return;
    if constexpr (D == 3)
      if (cell.response) {
        change_by(n, cell, -loss, cell.response[n].loss_along(on.tau, on.size), s);
        return note_slip(n, loss, cell);
      }
    change_by(n, cell, -loss / on.size, on.tau, s);
    note_slip(n, loss, cell);
  }
  /// What half a step of slip of one system alone takes off its traction, by the exponential rule; in 3-D,
  /// where planes lie askew, times the larger modulus over that along the traction.
  Real half_loss(std::size_t n, const Cell& cell, const Resolved& on, Real strength) const {
    const Real half = cell.relaxation[n] * Real(0.5);
    if constexpr (D == 3)
      if (cell.response && on.size > 0) {
        const Real share = cell.response[n].share_along(on.tau, on.size);
        return slip::unloaded_loss(on.size, strength, half * share) / share;
      }
    return slip::unloaded_loss(on.size, strength, half);
  }
  /// The second half of a step of slip of one system alone, by the exponential rule.
  void end_half(std::size_t n, const Cell& cell, Stress<D, Real>& s) const {
    const auto on = resolved(n, cell, s);
    Real loss = half_loss(n, cell, on, on.strength);
    if constexpr (Law::has_state)
      loss = half_loss(n, cell, on, strength_at_end(n, cell, on, loss, cell.relaxation[n] * Real(0.5)));
    take_off(n, on, loss, cell, s);
  }
  Real weighted(std::size_t n, const Cell& cell, Real strength) const {
    return correction_ == SlipCorrection::first
               ? cell.relaxation[n]
               : slip::relaxation_of_end(cell.relaxation[n], strength, int(systems_.size()));
  }
  void relax(Stress<D, Real>& s, const Cell& cell) const {
    const std::size_t count = systems_.size();
    Strengths strengths{};
    for (std::size_t n = 0; n < count; ++n) strengths[n] = resolved(n, cell, s).strength;
    const Stress<D, Real> before = s;
    auto losses = relax_at(s, cell, strengths);
    if constexpr (Law::has_state) {
      Strengths ends{};
      for (std::size_t n = 0; n < count; ++n)
        ends[n] = strength_at_end(n, cell, resolved(n, cell, before), slip_size(n, cell, losses[n]),
                                  weighted(n, cell, strengths[n]));
      if (ends != strengths) {
        s = before;
        losses = relax_at(s, cell, strengths = ends);
      }
    }
    if (cell.response) losses = follow_normal_stress(before, cell, strengths, losses, s);
    for (std::size_t n = 0; n < count; ++n) note_slip(n, slip_size(n, cell, losses[n]), cell);
    take_off_rest(s, cell, strengths, losses);
  }
  /// The rounds at given strengths. Returns what each system took off.
  Losses relax_at(Stress<D, Real>& s, const Cell& cell, const Strengths& strengths) const {
    const std::size_t count = systems_.size();
    Losses off{};
    Real scale = 0;
    for (const Real value : s.values) scale = std::max(scale, std::abs(value));
    for (int round = 0; round < most_rounds; ++round) {
      Real moved = 0;
      for (std::size_t visit = 0; visit < count; ++visit) {
        const std::size_t n = round % 2 ? count - 1 - visit : visit;
        change_by(n, cell, 1, off[n], s);
        Traction<D, Real> tau;
        resolve<D, Real>(systems_[n].normal, s, tau);
        const auto released = this->released(n, cell, tau, strengths[n]);
        for (std::size_t i = 0; i < D; ++i) {
          moved = std::max(moved, std::abs(released[i] - off[n][i]));
          off[n][i] = released[i];
        }
        change_by(n, cell, -1, off[n], s);
      }
      if (!(moved > std::numeric_limits<Real>::epsilon() * scale)) break;
    }
    return off;
  }
  /// What a system takes off this traction at a strength.
  Traction<D, Real> released(std::size_t n, const Cell& cell, const Traction<D, Real>& tau,
                             Real strength) const {
    const Real relaxation = weighted(n, cell, strength);
    if constexpr (D == 3)
      if (cell.response) return cell.response[n].relaxed(tau, strength, relaxation);
    const Real size = length<D, Real>(tau);
    Real over;
    const Real now = slip::relaxed(size, strength, relaxation, over);
    const Real share = now < size ? 1 - now / size : Real(0);
    Traction<D, Real> off;
    for (std::size_t i = 0; i < D; ++i) off[i] = share * tau[i];
    return off;
  }
  /// The size of the slip that took this off a traction, times the modulus.
  Real slip_size(std::size_t n, const Cell& cell, const Traction<D, Real>& loss) const {
    if constexpr (D == 3)
      if (cell.response) return cell.response[n].slip_size(loss);
    return length<D, Real>(loss);
  }
  /// Rounds that end early leave some planes with more than their slip carries: dry ones hold S to the bit.
  void take_off_rest(Stress<D, Real>& s, const Cell& cell, const Strengths& strengths,
                     const Losses& losses) const {
    for (std::size_t n = 0; n < systems_.size(); ++n) {
      Traction<D, Real> tau;
      resolve<D, Real>(systems_[n].normal, s, tau);
      const Real size = length<D, Real>(tau);
      const Real carried =
          strengths[n] *
          (1 + slip_size(n, cell, losses[n]) / std::max(weighted(n, cell, strengths[n]), slip::least<Real>));
      if (!(cell.relaxation[n] > 0 && size > carried)) continue;
      const Real share = (size - carried) / size;
      change_by(n, cell, -share, tau, s);
      note_slip(n, D == 3 && cell.response ? share * slip_size(n, cell, tau) : size - carried, cell);
    }
  }
  /// s += factor times what a change of the traction of a system by slip is to the stress.
  void change_by(std::size_t n, const Cell& cell, Real factor, const Traction<D, Real>& change,
                 Stress<D, Real>& s) const {
    const auto& normal = systems_[n].normal;
    const auto add = [&](Real along, const Stress<D, Real>& response) {
      for (std::size_t c = 0; c < s.values.size(); ++c) s.values[c] += along * response.values[c];
    };
    if (cell.response) {
      const auto& of = cell.response[n];
      if constexpr (D == 2) {
        add(factor * (change[1] * normal[0] - change[0] * normal[1]), of.stress);
      } else {
        const auto parts = of.components(change);
        for (std::size_t k = 0; k < parts.size(); ++k) add(factor * parts[k], of.stress[k]);
      }
      return;
    }
    add_shear<D, Real>(s, factor, change, normal);
  }
  /// Slip of planes that lie askew in their rock changes the normal stress on them: rounds are made again at
  /// the strengths that it leaves.
  Losses follow_normal_stress(const Stress<D, Real>& before, const Cell& cell, Strengths& strengths,
                              Losses losses, Stress<D, Real>& s) const {
    constexpr int most_visits = 12;
    for (int visit = 0; visit < most_visits; ++visit) {
      Strengths ends{};
      for (std::size_t n = 0; n < systems_.size(); ++n) {
        auto on = resolved(n, cell, before);
        on.s_n = resolved(n, cell, s).s_n;
        on.strength = cell.open[n] ? Real(0) : Law::strength(systems_[n].law, on.s_n, slip_of(n, cell));
        ends[n] = strength_at_end(n, cell, on, slip_size(n, cell, losses[n]), weighted(n, cell, on.strength));
      }
      if (ends == strengths) break;
      s = before;
      losses = relax_at(s, cell, strengths = ends);
    }
    return losses;
  }
  static void add(Stress<D, Real>& s, const Stress<D, Real>& before, const Stress<D, Real>& after) {
    for (std::size_t c = 0; c < s.values.size(); ++c) s.values[c] += after.values[c] - before.values[c];
  }

  SlipCorrection correction_;
  std::vector<System> systems_;
};

}  // namespace slipwave
