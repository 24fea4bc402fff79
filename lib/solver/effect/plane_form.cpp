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

template <int D>
void add_up(const MotionAlongX& medium, const WavesAlongX& waves,
            std::array<double, FieldRows<D>::count>& fields) {
  using Rows = FieldRows<D>;
  constexpr int z = D - 1;
  const double sxx = medium.zp * (waves[p_back] - waves[p_forth]),
               across = waves[at_rest] + medium.passive * sxx;
  fields.fill(0);
  fields[Rows::velocity(0)] = waves[p_forth] + waves[p_back];
  fields[Rows::velocity(z)] = waves[s_forth] + waves[s_back];
  fields[Rows::normal_stress(0)] = sxx;
  fields[Rows::normal_stress(z)] = across;
  fields[Rows::shear_stress(0, z)] = medium.zs * (waves[s_back] - waves[s_forth]);
  // Plane strain: lambda (e_xx + e_zz).
  if (D == 3) fields[Rows::normal_stress(1)] = medium.passive / (1 + medium.passive) * (sxx + across);
}

template <int D>
std::vector<double> depths_of_rows(const Domain<D>& domain) {
  std::vector<double> depths;
  for (std::int64_t k = 0; k < domain.grid.shape[D - 1]; ++k) {
    Index<D> upper{}, lower{};
    upper[D - 1] = k, lower[D - 1] = k + 1;
    depths.push_back(domain.row_heights.empty()
                         ? domain.grid.centre(D - 1, k)
                         : (corner_depth(domain, upper) + corner_depth(domain, lower)) / 2 *
                               domain.grid.spacing_m);
  }
  return depths;
}

double TimeSeries::operator()(double t_s) const {
  constexpr std::int64_t before = 2, points = 6;
  const double place = (t_s - first_s_) / interval_s_;
  const auto count = std::int64_t(samples_.size());
  if (!(place > -points) || !(place < double(count + points))) return 0;
  const auto first = std::int64_t(std::floor(place)) - before;
  if (first < 0 || first + points > count) return 0;
  const double x = place - double(first);
  // Lagrange, by the distances to the six samples.
  const double d0 = x, d1 = x - 1, d2 = x - 2, d3 = x - 3, d4 = x - 4, d5 = x - 5;
  const double d01 = d0 * d1, d23 = d2 * d3, d45 = d4 * d5;
  const float* const u = samples_.data() + first;
  return (d23 * d45 * (d0 * u[1] / 24 - d1 * u[0] / 120) + d01 * d45 * (d2 * u[3] - d3 * u[2]) / 12 +
          d01 * d23 * (d4 * u[5] / 120 - d5 * u[4] / 24));
}

template <int D>
PlaneForm<D>::PlaneForm(const Source<D>& source, double vp, double vs, double rho)
    : wavelet_(source.wavelet),
      table_(table_of(source.wavelet)),
      origin_{source.position_m[0], source.position_m[D - 1]},
      medium_(vp, vs, rho) {
  const auto& wave = std::get<PlaneWave<D>>(source.mechanism);
  const double across = wave.direction[0], down = wave.direction[D - 1], c = wave.speed(vp, vs);
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
               apart = std::abs(slowness_[0] * medium_.vp * ahead_s) + beside_s;
  return time_s + apart >= std::min(one, other) &&
         time_s - apart <= std::max(one, other) + wavelet_.duration_s();
}

template <int D>
bool PlaneForm<D>::fields(double x, double z, double time_s, double ahead_s,
                          std::array<double, FieldRows<D>::count>& fields) const {
  if (!is_there({x, x}, z, time_s, ahead_s)) return false;
  const double arrival = arrival_s(x, z);
  const PlaneMoment moment{time_s, ahead_s, slowness_[0]};
  WavesAlongX waves;
  const double here = ahead_s == 0 ? table_(time_s - arrival) : 0;
  for (int n = 0; n < along_x_count; ++n)
    waves[std::size_t(n)] =
        waves_[std::size_t(n)] * (ahead_s == 0 ? here : table_(moment.time_of(medium_, n) - arrival));
  add_up<D>(medium_, waves, fields);
  return true;
}

template void add_up<2>(const MotionAlongX&, const WavesAlongX&, std::array<double, FieldRows<2>::count>&);
template void add_up<3>(const MotionAlongX&, const WavesAlongX&, std::array<double, FieldRows<3>::count>&);
template std::vector<double> depths_of_rows(const Domain<2>&);
template std::vector<double> depths_of_rows(const Domain<3>&);
template class PlaneForm<2>;
template class PlaneForm<3>;

}  // namespace slipwave::solver
