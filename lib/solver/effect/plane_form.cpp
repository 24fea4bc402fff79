#include "solver/effect/plane_form.hpp"

#include <algorithm>
#include <cmath>

namespace slipwave::solver {
namespace {

/// Of the wavelet, over as many intervals per fine_interval_s().
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

MotionAlongX::MotionAlongX(double vp, double vs, double rho) : vp(vp), vs(vs), zp(rho * vp), zs(rho * vs) {
  passive = 1 - 2 * vs * vs / (vp * vp);
}

WavesAlongX waves_along_x(const MotionAlongX& medium, const PlaneFields& fields) {
  const double p = fields[plane_sxx] / medium.zp, s = medium.zs > 0 ? fields[plane_sxz] / medium.zs : 0;
  return {(fields[plane_vx] - p) / 2, (fields[plane_vx] + p) / 2, (fields[plane_vz] - s) / 2,
          (fields[plane_vz] + s) / 2, fields[plane_szz] - medium.passive * fields[plane_sxx]};
}

template <int D, class Real>
void add_up(const MotionAlongX& medium, const CellsAlongX<Real>& waves, std::int64_t count, Real* to,
            std::int64_t pitch) {
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
PlaneForm<D>::PlaneForm(const Source<D>& source, double vp, double vs, double rho)
    : wavelet_(source.wavelet),
      table_(table_of(source.wavelet)),
      origin_{source.position_m[0], source.position_m[D - 1]},
      medium_(vp, vs, rho) {
  const auto& wave = std::get<PlaneWave<D>>(source.mechanism);
  const double across = wave.across(), down = wave.direction[D - 1], c = wave.speed(vp, vs);
  slowness_ = {across / c, down / c};
  const double mu = rho * vs * vs, lambda = rho * vp * vp - 2 * mu;
  const double strain = -source.amplitude / c;  // grad v = -d v'/c
  const double a = source.amplitude;
  if (wave.shear)
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

template void add_up<2>(const MotionAlongX&, const CellsAlongX<float>&, std::int64_t, float*, std::int64_t);
template void add_up<2>(const MotionAlongX&, const CellsAlongX<double>&, std::int64_t, double*, std::int64_t);
template void add_up<3>(const MotionAlongX&, const CellsAlongX<float>&, std::int64_t, float*, std::int64_t);
template void add_up<3>(const MotionAlongX&, const CellsAlongX<double>&, std::int64_t, double*, std::int64_t);
template void TimeSeries::values(double, double, std::int64_t, std::int64_t, double, float*) const;
template void TimeSeries::values(double, double, std::int64_t, std::int64_t, double, double*) const;
template bool PlaneForm<2>::cells(double, double, std::int64_t, std::int64_t, double, double, double, float*,
                                  std::int64_t) const;
template bool PlaneForm<2>::cells(double, double, std::int64_t, std::int64_t, double, double, double, double*,
                                  std::int64_t) const;
template bool PlaneForm<3>::cells(double, double, std::int64_t, std::int64_t, double, double, double, float*,
                                  std::int64_t) const;
template bool PlaneForm<3>::cells(double, double, std::int64_t, std::int64_t, double, double, double, double*,
                                  std::int64_t) const;
template double top_of_row(const Domain<2>&, std::int64_t);
template double top_of_row(const Domain<3>&, std::int64_t);
template std::vector<double> depths_of_rows(const Domain<2>&);
template std::vector<double> depths_of_rows(const Domain<3>&);
template class PlaneForm<2>;
template class PlaneForm<3>;

}  // namespace slipwave::solver
