// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/plane_form.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "rock/anisotropy.hpp"
#include "rock/plane_motion.hpp"

namespace slipwave::solver {
namespace {

/// Returns a table of the wavelet, at the intervals of its fine_interval_s().
TimeSeries table_of(const Wavelet& wavelet) {
  const double interval_s =
      std::visit([](const auto& shape) { return shape.fine_interval_s(); }, wavelet.shape());
  constexpr std::int64_t beside = 3;
  const auto count = std::int64_t(std::ceil(wavelet.duration_s() / interval_s)) + 2 * beside + 1;
  std::vector<float> samples;
  for (std::int64_t n = 0; n < count; ++n) samples.push_back(float(wavelet(double(n - beside) * interval_s)));
  return {std::move(samples), -double(beside) * interval_s, interval_s};
}

}  // namespace

MotionAlongX::MotionAlongX(const Material& rock) : vp(rock.vp), vs(rock.vs) {
  passive = 1 - 2 * vs * vs / (vp * vp);
  if (rock.is_anisotropic()) {
    const auto c = elasticity_of<2>(rock);
    const auto waves = slipwave::waves_along<2>(c, {1, 0});
    vp = std::sqrt(waves.values[0] / rock.rho), vs = std::sqrt(waves.values[1] / rock.rho);
    cosine = waves.vectors[0][0], sine = rock.tilt == 0 && !rock.constants ? 0 : waves.vectors[0][1];
    passive = (c(1, 3) * cosine + c(3, 5) * sine) / (rock.rho * vp * vp);
    passive_s = (c(3, 5) * cosine - c(1, 3) * sine) / (rock.rho * vs * vs);
  }
  zp = rock.rho * vp, zs = rock.rho * vs;
}

namespace {

/// Resolves fields into the waves along x in rock whose axis is tilted.
WavesAlongX turned_waves_along_x(const MotionAlongX& medium, const PlaneFields& fields) {
  const double c = medium.cosine, s = medium.sine;
  const double fast = c * fields[plane_vx] + s * fields[plane_vz],
               slow = c * fields[plane_vz] - s * fields[plane_vx],
               of_fast = c * fields[plane_sxx] + s * fields[plane_sxz],
               of_slow = c * fields[plane_sxz] - s * fields[plane_sxx];
  return {(fast - of_fast / medium.zp) / 2, (fast + of_fast / medium.zp) / 2,
          (slow - of_slow / medium.zs) / 2, (slow + of_slow / medium.zs) / 2,
          fields[plane_szz] - medium.passive * of_fast - medium.passive_s * of_slow};
}

/// The rows of 2-D of it.
template <class Real>
void add_up_turned(const MotionAlongX& medium, const CellsAlongX<Real>& waves, std::int64_t count, Real* to,
                   std::int64_t pitch) {
  using Rows = FieldRows<2>;
  const auto c = Real(medium.cosine), s = Real(medium.sine), zp = Real(medium.zp), zs = Real(medium.zs),
             passive = Real(medium.passive), passive_s = Real(medium.passive_s);
  for (std::int64_t i = 0; i < count; ++i) {
    const auto of = [&](int number) { return waves.wave[number][i]; };
    const Real fast = of(p_forth) + of(p_back), slow = of(s_forth) + of(s_back),
               of_fast = zp * (of(p_back) - of(p_forth)), of_slow = zs * (of(s_back) - of(s_forth));
    to[Rows::velocity(0) * pitch + i] = c * fast - s * slow;
    to[Rows::velocity(1) * pitch + i] = s * fast + c * slow;
    to[Rows::normal_stress(0) * pitch + i] = c * of_fast - s * of_slow;
    to[Rows::shear_stress(0, 1) * pitch + i] = s * of_fast + c * of_slow;
    to[Rows::normal_stress(1) * pitch + i] = of(at_rest) + passive * of_fast + passive_s * of_slow;
  }
}

}  // namespace

WavesAlongX waves_along_x(const MotionAlongX& medium, const PlaneFields& fields) {
  if (medium.turned()) return turned_waves_along_x(medium, fields);
  const double p = fields[plane_sxx] / medium.zp, s = medium.zs > 0 ? fields[plane_sxz] / medium.zs : 0;
  return {(fields[plane_vx] - p) / 2, (fields[plane_vx] + p) / 2, (fields[plane_vz] - s) / 2,
          (fields[plane_vz] + s) / 2, fields[plane_szz] - medium.passive * fields[plane_sxx]};
}

template <int D, class Real>
void add_up(const MotionAlongX& medium, const CellsAlongX<Real>& waves, std::int64_t count, Real* to,
            std::int64_t pitch) {
  if constexpr (D == 2)
    if (medium.turned()) return add_up_turned(medium, waves, count, to, pitch);
  using Rows = FieldRows<D>;
  constexpr int z = D - 1;
  const auto zp = Real(medium.zp), zs = Real(medium.zs), passive = Real(medium.passive);
  // Plane strain: lambda (e_xx + e_zz).
  const auto along_y = Real(medium.passive / (1 + medium.passive));
  const auto row = [&](int number) { return to + number * pitch; };
  if (D == 3)
    for (int number = 0; number < Rows::count; ++number) std::fill(row(number), row(number) + count, Real(0));
  for (std::int64_t i = 0; i < count; ++i) {
    const auto of = [&](int number) { return waves.wave[number][i]; };
    const Real sxx = zp * (of(p_back) - of(p_forth)), szz = of(at_rest) + passive * sxx;
    row(Rows::velocity(0))[i] = of(p_forth) + of(p_back);
    row(Rows::velocity(z))[i] = of(s_forth) + of(s_back);
    row(Rows::normal_stress(0))[i] = sxx;
    row(Rows::normal_stress(z))[i] = szz;
    row(Rows::shear_stress(0, z))[i] = zs * (of(s_back) - of(s_forth));
    if (D == 3) row(Rows::normal_stress(1))[i] = along_y * (sxx + szz);
  }
}

template <int D>
double top_of_row(const Domain<D>& domain, std::int64_t row) {
  const double h = domain.grid.spacing_m;
  if (!domain.model_grid.rows) return domain.grid.centre(D - 1, row) - h / 2;
  Index<D> corner{};
  corner[D - 1] = row;
  return corner_depth(domain, corner) * h;
}

template <int D>
std::vector<double> depths_of_rows(const Domain<D>& domain) {
  std::vector<double> depths;
  for (std::int64_t k = 0; k < domain.grid.shape[D - 1]; ++k)
    depths.push_back(domain.model_grid.rows ? (top_of_row(domain, k) + top_of_row(domain, k + 1)) / 2
                                            : domain.grid.centre(D - 1, k));
  return depths;
}

template <class Real>
void TimeSeries::values(double t_s, double step_s, std::int64_t first, std::int64_t count, double factor,
                        Real* to) const {
  if (samples_.size() < 6 || factor == 0) {
    std::fill(to, to + count, Real(0));
    return;
  }
  // Whole blocks, whatever the piece: its last cells would round differently.
  constexpr std::int64_t block = 16;
  const double place = (t_s - first_s_) / interval_s_, step = step_s / interval_s_;
  for (auto from = first / block * block; from < first + count; from += block) {
    Real values[block];
    interpolation_kernel<Real>()(block, samples_.data(), std::int64_t(samples_.size()), place, step, from,
                                 values);
    const auto begin = std::max(from, first), end = std::min(from + block, first + count);
    std::copy(values + (begin - from), values + (end - from), to + (begin - first));
  }
  for (std::int64_t i = 0; i < count && factor != 1; ++i) to[i] *= Real(factor);
}

template <int D>
PlaneForm<D>::PlaneForm(const Source<D>& source, const Material& rock)
    : wavelet_(source.wavelet),
      table_(table_of(source.wavelet)),
      origin_{source.position_m[0], source.position_m[D - 1]},
      medium_(rock) {
  const auto& wave = std::get<PlaneWave<D>>(source.mechanism);
  const double across = wave.across(), down = wave.direction[D - 1],
               c = plane_motion(rock, across, down, wave.shear).speed;
  slowness_ = {across / c, down / c};
  const double mu = rock.rho * rock.vs * rock.vs, lambda = rock.rho * rock.vp * rock.vp - 2 * mu;
  const double strain = -source.amplitude / c;  // grad v = -d v'/c
  const double a = source.amplitude;
  if (rock.is_anisotropic()) {
    const auto motion = plane_motion(rock, across, down, wave.shear);
    const double vx = a * motion.x, vz = a * motion.z;
    const auto [sxx, szz, sxz] = stress_of_motion<2, double>(elasticity_of<2>(rock), slowness_, {vx, vz});
    factors_ = {vx, vz, sxx, szz, sxz};
  } else if (wave.shear)
    factors_ = {a * down, -a * across, strain * 2 * mu * across * down, -strain * 2 * mu * across * down,
                strain * mu * (down * down - across * across)};
  else
    factors_ = {a * across, a * down, strain * (lambda + 2 * mu * across * across),
                strain * (lambda + 2 * mu * down * down), strain * 2 * mu * across * down};
  waves_ = waves_along_x(medium_, factors_);
}

template <int D>
bool PlaneForm<D>::is_there(const std::array<double, 2>& x, double z, double time_s, double ahead_s,
                            double beside_s) const {
  const double one = arrival_s(x[0], z), other = arrival_s(x[1], z),
               apart = std::abs(slowness_[0] * medium_.vp * ahead_s) + beside_s + table_.beside_s();
  return time_s + apart >= std::min(one, other) &&
         time_s - apart <= std::max(one, other) + wavelet_.duration_s();
}

template <int D>
template <class Real>
bool PlaneForm<D>::cells(double x, double spacing, std::int64_t first, std::int64_t count, double z,
                         double time_s, double ahead_s, Real* to, std::int64_t pitch) const {
  const double begin = x + double(first) * spacing, end = x + double(first + count - 1) * spacing;
  if (!is_there({begin, end}, z, time_s, ahead_s)) return false;
  const double arrival = arrival_s(x, z), step_s = -slowness_[0] * spacing;
  const PlaneMoment moment{time_s, ahead_s, slowness_[0]};
  CellsAlongX<Real> waves;
  for (int n = 0; n < along_x_count; ++n)
    table_.values(moment.time_of(medium_, n) - arrival, step_s, first, count, waves_[std::size_t(n)],
                  waves.wave[n]);
  add_up<D>(medium_, waves, count, to, pitch);
  return true;
}

SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, add_up);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, TimeSeries::values);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, PlaneForm<2>::cells);
SLIPWAVE_INSTANTIATE_REAL(FUNCTION, PlaneForm<3>::cells);
SLIPWAVE_INSTANTIATE_D(FUNCTION, top_of_row);
SLIPWAVE_INSTANTIATE_D(FUNCTION, depths_of_rows);
SLIPWAVE_INSTANTIATE_D(TYPE, class PlaneForm);

}  // namespace slipwave::solver
