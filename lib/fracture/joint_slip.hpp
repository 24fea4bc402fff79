#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fracture/slip_law.hpp"
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
/// changes (S12): at most `most_rounds` times, and energy falls in each of them.
template <int D, class Real>
class JointSlip {
 public:
  struct System {
    Traction<D, Real> normal;
    Real friction, cohesion_pa;
  };
  static constexpr int most_rounds = 24;
  static constexpr std::size_t most_systems = D;

  JointSlip(SlipCorrection correction, std::vector<System> systems)
      : correction_(correction), systems_(std::move(systems)) {}
  /// Of one cell at the end of an elastic step: `s` is its stress, `total` that with the static part, `creep`
  /// and `open` (whether its planes stand apart) are by system.
  void slip(Stress<D, Real>& s, Stress<D, Real> total, const Real* creep, const bool* open) const {
    const Stress<D, Real> before = total;
    if (correction_ == SlipCorrection::exponential)
      for (std::size_t n = systems_.size(); n-- > 0;) crept(n, creep[n], open[n], total);
    else
      relax(total, creep, open);
    add(s, before, total);
  }
  /// What the next step begins with.
  void begin(Stress<D, Real>& s, Stress<D, Real> total, const Real* creep, const bool* open) const {
    if (correction_ == SlipCorrection::first) return;
    const Stress<D, Real> before = total;
    if (correction_ == SlipCorrection::exponential) {
      for (std::size_t n = 0; n < systems_.size(); ++n) crept(n, creep[n], open[n], total);
    } else {
      for (std::size_t n = 0; n < systems_.size(); ++n) {
        Traction<D, Real> tau;
        resolve<D, Real>(systems_[n].normal, before, tau);
        const Real size = length<D, Real>(tau);
        const Real off =
            slip::taken_first(size, strength(n, open[n], before), creep[n], int(systems_.size()));
        if (off > 0) add_shear<D, Real>(total, -off / size, tau, systems_[n].normal);
      }
    }
    add(s, before, total);
  }

 private:
  Real strength(std::size_t n, bool open, const Stress<D, Real>& s) const {
    Traction<D, Real> tau;
    if (open) return 0;
    return systems_[n].friction * std::max(-resolve<D, Real>(systems_[n].normal, s, tau), Real(0)) +
           systems_[n].cohesion_pa;
  }
  /// Half a step of slip of one system alone.
  void crept(std::size_t n, Real creep, bool open, Stress<D, Real>& s) const {
    Traction<D, Real> tau;
    const Real strength_pa = strength(n, open, s);
    resolve<D, Real>(systems_[n].normal, s, tau);
    const Real size = length<D, Real>(tau), off = slip::crept(size, strength_pa, creep * Real(0.5));
    if (off > 0) add_shear<D, Real>(s, -off / size, tau, systems_[n].normal);
  }
  void relax(Stress<D, Real>& s, const Real* creep, const bool* open) const {
    const std::size_t count = systems_.size();
    std::array<Real, most_systems> strengths{}, weighted{};
    std::array<Traction<D, Real>, most_systems> off{};
    for (std::size_t n = 0; n < count; ++n) {
      strengths[n] = strength(n, open[n], s);
      weighted[n] = correction_ == SlipCorrection::first
                        ? creep[n]
                        : slip::creep_of_end(creep[n], strengths[n], int(count));
    }
    Real scale = 0;
    for (const Real value : s.values) scale = std::max(scale, std::abs(value));
    for (int round = 0; round < most_rounds; ++round) {
      Real moved = 0;
      for (std::size_t visit = 0; visit < count; ++visit) {
        const std::size_t n = round % 2 ? count - 1 - visit : visit;
        add_shear<D, Real>(s, 1, off[n], systems_[n].normal);
        Traction<D, Real> tau;
        resolve<D, Real>(systems_[n].normal, s, tau);
        const Real size = length<D, Real>(tau);
        Real over;
        const Real now = slip::relaxed(size, strengths[n], weighted[n], over);
        const Real share = now < size ? 1 - now / size : Real(0);
        for (std::size_t i = 0; i < D; ++i) {
          moved = std::max(moved, std::abs(share * tau[i] - off[n][i]));
          off[n][i] = share * tau[i];
        }
        add_shear<D, Real>(s, -1, off[n], systems_[n].normal);
      }
      if (!(moved > std::numeric_limits<Real>::epsilon() * scale)) break;
    }
    // Rounds that end early leave some planes with more than their slip carries: dry ones hold S to the bit.
    for (std::size_t n = 0; n < count; ++n) {
      Traction<D, Real> tau;
      resolve<D, Real>(systems_[n].normal, s, tau);
      const Real size = length<D, Real>(tau);
      const Real carried =
          strengths[n] * (1 + length<D, Real>(off[n]) / std::max(weighted[n], slip::least<Real>));
      if (creep[n] > 0 && size > carried)
        add_shear<D, Real>(s, -(size - carried) / size, tau, systems_[n].normal);
    }
  }
  static void add(Stress<D, Real>& s, const Stress<D, Real>& before, const Stress<D, Real>& after) {
    for (std::size_t c = 0; c < s.values.size(); ++c) s.values[c] += after.values[c] - before.values[c];
  }

  SlipCorrection correction_;
  std::vector<System> systems_;
};

}  // namespace slipwave
