// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of attenuation, compiled once for each instruction set as kernels_level.cpp is, under the
// same rules.
#include <utility>

#include "solver/kernels/relaxation_tables.hpp"

namespace slipwave::solver {
namespace {

/// What one part of the stress loses: each mechanism comes nearer to its share of the stress that the strain
/// would make at once, which is the stress and all that has relaxed of it.
template <int Mechanisms, int Parts, class Real>
[[gnu::always_inline]] inline Real loss(Real stress, Real* memory, const Real* shares, const Real* decays) {
  constexpr std::int64_t block = relaxation_block;
  Real relaxed[Mechanisms], at_once = stress, sum = 0;
#pragma GCC unroll 5
  for (int l = 0; l < Mechanisms; ++l) {
    relaxed[l] = memory[block * l * Parts];
    at_once += relaxed[l];
  }
#pragma GCC unroll 5
  for (int l = 0; l < Mechanisms; ++l) {
    const Real change = shares[l * block] * at_once - decays[l] * relaxed[l];
    memory[block * l * Parts] = relaxed[l] + change;
    sum += change;
  }
  return sum;
}

/// Block after block, whose memory lies together: rows of their own would be as many streams, a page apart.
template <int D, Relaxing What, int Mechanisms, class Real>
[[gnu::noinline]] void relax(std::int64_t n, const RelaxationRows<Real>& rows) {
  constexpr std::int64_t block = relaxation_block;
  constexpr int parts = relaxing_parts(D, What);
  constexpr bool one = What == Relaxing::pressure;
  const std::int64_t pitch = rows.pitch;
  Real decays[Mechanisms];
  for (int l = 0; l < Mechanisms; ++l) decays[l] = rows.decays[l];
  constexpr Real of_mean = D == 2 ? Real(0.5) : Real(1) / 3;
  Real* __restrict stress = rows.stress;
  Real* __restrict memory = rows.memory;
  const Real* __restrict bulk = rows.shares;
  for (std::int64_t first = 0; first < n; first += block) {
    const Real* const shear = bulk + Mechanisms * block;
#pragma omp simd
    for (std::int64_t i = 0; i < block; ++i) {
      const Real xx = stress[i], yy = one ? xx : stress[pitch + i];
      const Real zz = one || D == 2 ? yy : stress[2 * pitch + i];
      const Real mean = of_mean * (D == 2 ? xx + zz : xx + yy + zz);
      const auto lost = [&](int part, Real of, const Real* shares) __attribute__((always_inline)) {
        return loss<Mechanisms, parts>(of, memory + part * block + i, shares + i, decays);
      };
      const Real all = lost(0, mean, bulk);
      if constexpr (one) {
        stress[i] = xx - all;
      } else if constexpr (What == Relaxing::mean) {
        stress[i] = xx - all;
        stress[pitch + i] = yy - all;
        if constexpr (D == 3) stress[2 * pitch + i] = zz - all;
      } else if constexpr (D == 2) {
        const Real half = lost(1, Real(0.5) * (xx - zz), shear);
        stress[i] = xx - (all + half);
        stress[pitch + i] = zz - (all - half);
        const Real xz = stress[2 * pitch + i];
        stress[2 * pitch + i] = xz - lost(2, xz, shear);
      } else {
        const Real of_xx = lost(1, xx - mean, shear), of_yy = lost(2, yy - mean, shear);
        stress[i] = xx - (all + of_xx);
        stress[pitch + i] = yy - (all + of_yy);
        stress[2 * pitch + i] = zz - (all - of_xx - of_yy);
        const Real xy = stress[3 * pitch + i], xz = stress[4 * pitch + i], yz = stress[5 * pitch + i];
        stress[3 * pitch + i] = xy - lost(3, xy, shear);
        stress[4 * pitch + i] = xz - lost(4, xz, shear);
        stress[5 * pitch + i] = yz - lost(5, yz, shear);
      }
    }
    stress += block;
    memory += block * Mechanisms * parts;
    bulk += block * (What == Relaxing::all ? 2 : 1) * Mechanisms;
  }
}

/// In 2-D about the axes of anisotropic rock: stresses are turned to its beds and scaled as its stiffness,
/// and their losses go the way back. Of isotropic rock the same bits as relax().
template <int Mechanisms, class Real>
[[gnu::noinline]] void relax_turned(std::int64_t n, const RelaxationRows<Real>& rows) {
  constexpr std::int64_t block = relaxation_block;
  constexpr int parts = relaxing_parts(2, Relaxing::turned);
  const std::int64_t pitch = rows.pitch;
  Real decays[Mechanisms];
  for (int l = 0; l < Mechanisms; ++l) decays[l] = rows.decays[l];
  Real* __restrict stress = rows.stress;
  Real* __restrict memory = rows.memory;
  const Real* __restrict bulk = rows.shares;
  const Real* __restrict axes = rows.axes;
  for (std::int64_t first = 0; first < n; first += block) {
    const Real* const shear = bulk + Mechanisms * block;
#pragma omp simd
    for (std::int64_t i = 0; i < block; ++i) {
      const auto lost = [&](int part, Real of, const Real* shares) __attribute__((always_inline)) {
        return loss<Mechanisms, parts>(of, memory + part * block + i, shares + i, decays);
      };
      const Real even = axes[i], odd = axes[block + i], cosine = axes[2 * block + i],
                 sine = axes[3 * block + i];
      const Real xx = stress[i], zz = stress[pitch + i], xz = stress[2 * pitch + i];
      const Real mean = Real(0.5) * (xx + zz), half = Real(0.5) * (xx - zz);
      const Real of_beds = cosine * half + sine * xz;
      const Real p = lost(0, even * mean + odd * of_beds, bulk),
                 s = lost(1, even * of_beds + odd * mean, shear),
                 t = lost(2, cosine * xz - sine * half, shear);
      const Real all = even * p - odd * s, of_half = even * s - odd * p, turned = cosine * of_half - sine * t;
      stress[i] = xx - (all + turned);
      stress[pitch + i] = zz - (all - turned);
      stress[2 * pitch + i] = xz - (cosine * t + sine * of_half);
    }
    stress += block;
    memory += block * Mechanisms * parts;
    bulk += block * 2 * Mechanisms;
    axes += axis_values(2, Relaxing::turned) * block;
  }
}

/// In 3-D in anisotropic rock: all of the stress relaxes as the shear modulus does, and its bulk part by what
/// the shares of the bulk differ from those of shear. The memory is of the stress itself.
template <Relaxing What, int Mechanisms, class Real>
[[gnu::noinline]] void relax_in_3d(std::int64_t n, const RelaxationRows<Real>& rows) {
  constexpr std::int64_t block = relaxation_block;
  constexpr int parts = relaxing_parts(3, What), values = axis_values(3, What), of_tensor = values / 2;
  const std::int64_t pitch = rows.pitch;
  Real decays[Mechanisms];
  for (int l = 0; l < Mechanisms; ++l) decays[l] = rows.decays[l];
  Real* __restrict stress = rows.stress;
  Real* __restrict memory = rows.memory;
  const Real* __restrict bulk = rows.shares;
  const Real* __restrict axes = rows.axes;
  for (std::int64_t first = 0; first < n; first += block) {
    const Real* const shear = bulk + Mechanisms * block;
#pragma omp simd
    for (std::int64_t i = 0; i < block; ++i) {
      const auto at_once = [&](int part) __attribute__((always_inline)) {
        Real sum = stress[part * pitch + i];
#pragma GCC unroll 5
        for (int l = 0; l < Mechanisms; ++l) sum += memory[(l * parts + part) * block + i];
        return sum;
      };
      const Real e0 = at_once(0), e1 = at_once(1), e2 = at_once(2), e3 = at_once(3), e4 = at_once(4),
                 e5 = at_once(5);
      Real size = axes[i] * e0 + axes[block + i] * e1 + axes[2 * block + i] * e2;
      if constexpr (What == Relaxing::turned)
        size += axes[3 * block + i] * e3 + axes[4 * block + i] * e4 + axes[5 * block + i] * e5;
      const auto relax_part = [&](int part, Real of_part) __attribute__((always_inline)) {
        const Real even = part < of_tensor ? axes[(of_tensor + part) * block + i] * size : Real(0);
        Real lost = 0;
#pragma GCC unroll 5
        for (int l = 0; l < Mechanisms; ++l) {
          Real& relaxed = memory[(l * parts + part) * block + i];
          Real change = shear[l * block + i] * of_part - decays[l] * relaxed;
          if (part < of_tensor) change += (bulk[l * block + i] - shear[l * block + i]) * even;
          relaxed += change;
          lost += change;
        }
        stress[part * pitch + i] -= lost;
      };
      relax_part(0, e0), relax_part(1, e1), relax_part(2, e2);
      relax_part(3, e3), relax_part(4, e4), relax_part(5, e5);
    }
    stress += block;
    memory += block * Mechanisms * parts;
    bulk += block * 2 * Mechanisms;
    axes += values * block;
  }
}

template <int D, Relaxing What, int Mechanisms, class Real>
constexpr RelaxationKernel<Real> loop() {
  if constexpr (D == 3 && (What == Relaxing::upright || What == Relaxing::turned))
    return relax_in_3d<What, Mechanisms, Real>;
  else if constexpr (What == Relaxing::turned)
    return relax_turned<Mechanisms, Real>;
  else
    return relax<D, What, Mechanisms, Real>;
}

template <int D, Relaxing What, class Real>
RelaxationKernel<Real> of_count(int mechanisms) {
  switch (mechanisms) {
    case 2:
      return loop<D, What, 2, Real>();
    case 3:
      return loop<D, What, 3, Real>();
    case 4:
      return loop<D, What, 4, Real>();
    default:
      return loop<D, What, 5, Real>();
  }
}

template <int D, class Real>
RelaxationKernel<Real> of_what(Relaxing what, int mechanisms) {
  if (what == Relaxing::pressure) return of_count<D, Relaxing::pressure, Real>(mechanisms);
  if (what == Relaxing::mean) return of_count<D, Relaxing::mean, Real>(mechanisms);
  if (what == Relaxing::turned) return of_count<D, Relaxing::turned, Real>(mechanisms);
  if constexpr (D == 3)
    if (what == Relaxing::upright) return of_count<D, Relaxing::upright, Real>(mechanisms);
  return of_count<D, Relaxing::all, Real>(mechanisms);
}

template <class Real>
RelaxationKernel<Real> of(int dimensions, Relaxing what, int mechanisms) {
  return dimensions == 2 ? of_what<2, Real>(what, mechanisms) : of_what<3, Real>(what, mechanisms);
}

template <class Real>
constexpr RelaxationTables<Real> tables = {of<Real>};

}  // namespace

const RelaxationTables<float>& SLIPWAVE_RELAXATION_LEVEL(float) { return tables<float>; }
const RelaxationTables<double>& SLIPWAVE_RELAXATION_LEVEL(double) { return tables<double>; }

}  // namespace slipwave::solver
