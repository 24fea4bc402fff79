#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fracture/slip_law.hpp"
#include "grid/tensor.hpp"

namespace slipwave {

template <int D, class Real>
using Stress = SymmetricTensor<D, Real>;
template <int D, class Real>
using Traction = std::array<Real, std::size_t(D)>;

/// s_n and tau of the planes with unit normal n (S1).
template <int D, class Real>
Real resolve(const Traction<D, Real>& n, const Stress<D, Real>& s, Traction<D, Real>& tau) {
  Real s_n = 0;
  for (std::size_t i = 0; i < D; ++i) {
    tau[i] = 0;
    for (std::size_t j = 0; j < D; ++j) tau[i] += s(int(i), int(j)) * n[j];
    s_n += n[i] * tau[i];
  }
  for (std::size_t i = 0; i < D; ++i) tau[i] -= s_n * n[i];
  return s_n;
}

/// s += factor (change n + n change).
template <int D, class Real>
void add_shear(Stress<D, Real>& s, Real factor, const Traction<D, Real>& change, const Traction<D, Real>& n) {
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j)
      s(i, j) +=
          factor * (change[std::size_t(i)] * n[std::size_t(j)] + change[std::size_t(j)] * n[std::size_t(i)]);
}

template <int D, class Real>
Real length(const Traction<D, Real>& a) {
  Real largest = 0, sum = 0;
  for (const Real part : a) largest = std::max(largest, std::abs(part));
  if (!(largest > 0)) return largest;
  for (const Real part : a) sum += (part / largest) * (part / largest);
  return largest * std::sqrt(sum);
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

  JointSlip(SlipCorrection correction, std::vector<System> systems)
      : correction_(correction), systems_(std::move(systems)) {}
  std::size_t systems() const { return systems_.size(); }
  /// Numbers kept for a cell from step to step, zero before the first: what begin() takes off s first.
  int kept() const {
    const int components = Stress<D, Real>::components;
    return correction_ == SlipCorrection::first         ? 0
           : correction_ == SlipCorrection::exponential ? components
                                                        : components + int(systems_.size());
  }
  /// Of one cell at the end of an elastic step: `s` is its stress, `total` that with the static part, `creep`
  /// and `open` (whether its planes stand apart) are by system; `kept` numbers stand `pitch` apart.
  void slip(Stress<D, Real>& s, Stress<D, Real> total, const Real* creep, const bool* open, Real* kept,
            std::int64_t pitch) const {
    const Stress<D, Real> before = total;
    Stress<D, Real> take{};
    if (correction_ == SlipCorrection::exponential) {
      for (std::size_t n = systems_.size(); n-- > 0;) crept(n, creep[n], open[n], total);
      Stress<D, Real> later = total;
      for (std::size_t n = 0; n < systems_.size(); ++n) crept(n, creep[n], open[n], later);
      for (std::size_t c = 0; c < take.values.size(); ++c) take.values[c] = total.values[c] - later.values[c];
    } else {
      relax(total, creep, open, kept + std::int64_t(take.values.size()) * pitch, pitch, take);
    }
    for (std::size_t c = 0; c < take.values.size(); ++c) {
      s.values[c] += total.values[c] - before.values[c];
      if (correction_ != SlipCorrection::first) kept[std::int64_t(c) * pitch] = take.values[c];
    }
  }
  /// What the next step begins with.
  void begin(Stress<D, Real>& s, const Real* kept, std::int64_t pitch) const {
    if (correction_ == SlipCorrection::first) return;
    for (std::size_t c = 0; c < s.values.size(); ++c) s.values[c] -= kept[std::int64_t(c) * pitch];
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
  void relax(Stress<D, Real>& s, const Real* creep, const bool* open, Real* more, std::int64_t pitch,
             Stress<D, Real>& take) const {
    const std::size_t count = systems_.size();
    std::array<Real, most_systems> strengths{}, weighted{}, over{};
    std::array<Traction<D, Real>, most_systems> off{};
    const bool second = correction_ == SlipCorrection::second;
    for (std::size_t n = 0; n < count; ++n) {
      strengths[n] = strength(n, open[n], s);
      weighted[n] = second ? creep[n] * Real(0.5) + more[std::int64_t(n) * pitch] : creep[n];
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
        const Real now = slip::relaxed(size, strengths[n], weighted[n], over[n]);
        const Real share = now < size ? 1 - now / size : Real(0);
        for (std::size_t i = 0; i < D; ++i) {
          moved = std::max(moved, std::abs(share * tau[i] - off[n][i]));
          off[n][i] = share * tau[i];
        }
        add_shear<D, Real>(s, -1, off[n], systems_[n].normal);
      }
      if (!(moved > std::numeric_limits<Real>::epsilon() * scale)) break;
    }
    for (std::size_t n = 0; second && n < count; ++n) {
      const Real beginning = slip::creep_of_beginning(creep[n], strengths[n], int(count));
      more[std::int64_t(n) * pitch] = creep[n] * Real(0.5) - beginning;
      const Real size = length<D, Real>(off[n]);
      if (size > 0) add_shear<D, Real>(take, beginning * over[n] / size, off[n], systems_[n].normal);
    }
  }

  static constexpr std::size_t most_systems = 8;
  SlipCorrection correction_;
  std::vector<System> systems_;
};

}  // namespace slipwave
