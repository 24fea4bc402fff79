// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/layered_wave.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/instantiate.hpp"
#include "rock/plane_motion.hpp"

namespace slipwave::solver {
namespace {

using Complex = std::complex<double>;

/// The waves along x of a depth, which lies in that layer.
std::array<TimeSeries, std::size_t(along_x_count)> waves_along_x_at(StackSeries& series,
                                                                    const StackResponse<2>& response,
                                                                    const Material& rock, double z,
                                                                    std::size_t layer) {
  const MotionAlongX medium(rock);
  constexpr auto count = std::size_t(along_x_count);
  const auto spectra = series.sums_at<count>(z, layer, [&](std::size_t n) {
    const auto& wave = response.waves()[n];
    PlaneFields real{}, imaginary{};
    for (std::size_t f = 0; f < 5; ++f) real[f] = wave.fields[f].real(), imaginary[f] = wave.fields[f].imag();
    const auto of_real = waves_along_x(medium, real), of_imaginary = waves_along_x(medium, imaginary);
    std::array<Complex, count> of;
    for (std::size_t k = 0; k < count; ++k) of[k] = {of_real[k], of_imaginary[k]};
    return of;
  });
  std::array<TimeSeries, count> all;
  for (std::size_t k = 0; k < count; ++k) all[k] = series.series_of(spectra[k]);
  return all;
}

/// An oblique wave in layers that are the same along all absorbing sides.
template <int D, class Real>
class LayeredWave : public IncidentWave<D, Real> {
 public:
  LayeredWave(const Grid<D>& grid, double x_m, double slowness)
      : grid_(grid), x_m_(x_m), slowness_(slowness) {}
  void add_row(const MotionAlongX& medium, std::array<TimeSeries, std::size_t(along_x_count)> series) {
    media_.push_back(medium);
    series_.push_back(std::move(series));
  }
  void begin(State<D, Real>& state) override {
    set_cells<D>(state, [&](const Index<D>& at, std::int64_t first, std::int64_t count, Real* to,
                            std::int64_t pitch) { return values({}, 0, 0, at, first, count, to, pitch); });
  }
  bool enters(int, int) const override { return true; }
  bool reaches(const StepTime& time, const Index<D>& line) const override {
    const auto row = std::size_t(line[D - 1]);
    const double apart = (3 + 3 * std::abs(slowness_) * media_[row].vp) * time.dt_s;
    const double one = slowness_ * (grid_.origin_m[0] - x_m_), other = slowness_ * (grid_.end(0) - x_m_);
    for (const auto& series : series_[row])
      if (!series.is_zero(time.end_s() - std::max(one, other) - apart,
                          time.end_s() - std::min(one, other) + apart))
        return true;
    return false;
  }
  bool values(const Clocks<D>& clocks, int, int, const Index<D>& line, std::int64_t x_first,
              std::int64_t count, Real* to, std::int64_t pitch) const override {
    const auto row = std::size_t(line[D - 1]);
    const auto& series = series_[row];
    const auto& medium = media_[row];
    const PlaneMoment moment{clocks.axis_s[D - 1], clocks.axis_s[0] - clocks.axis_s[D - 1], slowness_};
    const double step_s = -slowness_ * grid_.spacing_m, of_first_s = -slowness_ * (grid_.centre(0, 0) - x_m_);
    CellsAlongX<Real> waves;
    bool any = false;
    for (int n = 0; n < along_x_count; ++n) {
      const auto& one = series[std::size_t(n)];
      const double t_s = moment.time_of(medium, n) + of_first_s, begin_s = t_s + double(x_first) * step_s,
                   end_s = t_s + double(x_first + count - 1) * step_s;
      if (one.is_zero(std::min(begin_s, end_s), std::max(begin_s, end_s))) {
        std::fill(waves.wave[n], waves.wave[n] + count, Real(0));
        continue;
      }
      any = true;
      one.values(t_s, step_s, x_first, count, 1, waves.wave[n]);
    }
    if (any) add_up<D>(medium, waves, count, to, pitch);
    return any;
  }
  std::int64_t memory_bytes() const override {
    std::int64_t bytes = 0;
    for (const auto& row : series_)
      for (const auto& one : row) bytes += one.memory_bytes();
    return bytes;
  }

 private:
  Grid<D> grid_;
  double x_m_, slowness_;
  std::vector<MotionAlongX> media_;                                         // [row]
  std::vector<std::array<TimeSeries, std::size_t(along_x_count)>> series_;  // [row]
};

/// The layers of the column, and the wave that falls on them in its plane of travel.
template <int D>
LayerStack<2> stack_of(const Scene<D>& scene, const PlaneWave<D>& wave, const Domain<D>& domain,
                       const PlaneWaveWay<D>& way) {
  constexpr int z = D - 1;
  const auto& medium = scene.model.medium;
  const auto entry = material_of(medium, std::size_t(medium.grid().flat(way.entry)));
  const auto motion = plane_motion(entry, wave.across(), wave.direction[z], wave.shear);
  return {layers_of(scene, domain, way),
          {scene.edges[z][0], scene.edges[z][1]},
          way.entry_side == 0,
          {wave.across() / motion.speed, wave.direction[z] / motion.speed},
          {motion.x, motion.z}};
}

}  // namespace

template <int D>
ColumnOfLayers layers_of(const Scene<D>& scene, const Domain<D>& domain, const PlaneWaveWay<D>& way) {
  constexpr int z = D - 1;
  const auto& medium = scene.model.medium;
  ColumnOfLayers column;
  double depth = 0;
  for (std::int64_t k = 0; k < domain.grid.shape[z]; ++k) {
    auto cell = way.column;
    cell[z] = std::clamp<std::int64_t>(k - domain.low_zone[z], 0, domain.model_grid.shape[z] - 1);
    const double top = top_of_row(domain, k);
    depth = top_of_row(domain, k + 1);
    const auto layer = material_of(medium, std::size_t(medium.grid().flat(cell)));
    if (column.layers.empty() || !(column.layers.back() == layer)) {
      column.layers.push_back(layer);
      column.depths_m.push_back(top);
    }
    column.of_row.push_back(column.layers.size() - 1);
  }
  column.depths_m.push_back(depth);
  return column;
}

/// Slowness times the way along the layers, of any cell; and when the wave comes to the first row.
template <int D>
SeriesWindow window_of(const Scene<D>& scene, const Source<D>& source, const Domain<D>& domain,
                       const std::array<double, 2>& slowness, double down, double reference_m) {
  double least = 0, most = 0;
  for (int axis = 0; axis < D - 1; ++axis) {
    const double at = source.position_m[std::size_t(axis)], along = slowness[std::size_t(axis)];
    const double low = along * (domain.grid.origin_m[axis] - at), high = along * (domain.grid.end(axis) - at);
    least += std::min(low, high);
    most += std::max(low, high);
  }
  const auto depths = depths_of_rows(domain);
  const auto arrival_s = [&](double z) { return down * (z - source.position_m[D - 1]); };
  SeriesWindow window{arrival_s(reference_m), 0,
                      scene.recording.duration_s + 0.1 * source.wavelet.duration_s() - least};
  window.first_s = std::min(window.arrival_s, -most);
  for (const double z : {depths.front(), depths.back()})
    window.first_s = std::min(window.first_s, arrival_s(z));
  window.first_s -= source.wavelet.duration_s();
  return window;
}
template SeriesWindow window_of(const Scene<3>&, const Source<3>&, const Domain<3>&,
                                const std::array<double, 2>&, double, double);
template ColumnOfLayers layers_of(const Scene<3>&, const Domain<3>&, const PlaneWaveWay<3>&);

template <int D>
struct LayeredSeries<D>::Impl {
  Impl(const Scene<D>& scene, const Source<D>& source, const PlaneForm<D>& form, const Domain<D>& domain,
       const PlaneWaveWay<D>& way)
      : response(stack_of(scene, std::get<PlaneWave<D>>(source.mechanism), domain, way)),
        depths(depths_of_rows(domain)) {
    const double slowness = form.slowness()[0];
    const auto& along = std::get<PlaneWave<D>>(source.mechanism).along;
    const auto window = window_of(scene, source, domain, {slowness * along[0], slowness * along[1]},
                                  form.slowness()[1], response.reference_m());
    series.emplace(
        std::vector<StackWave>(response.waves().begin(), response.waves().end()),
        [&](const Complex& omega) { return response.solve(omega); }, source.wavelet, source.amplitude,
        window);
  }

  std::size_t layer_of(std::size_t row) const { return response.stack().column.of_row[row]; }
  const Material& rock_of(std::size_t row) const { return response.stack().column.layers[layer_of(row)]; }

  StackResponse<2> response;
  std::vector<double> depths;
  std::optional<StackSeries> series;
};

template <int D>
LayeredSeries<D>::LayeredSeries(const Scene<D>& scene, const Source<D>& source, const PlaneForm<D>& form,
                                const Domain<D>& domain, const PlaneWaveWay<D>& way)
    : impl_(std::make_unique<Impl>(scene, source, form, domain, way)) {}

template <int D>
LayeredSeries<D>::~LayeredSeries() = default;

template <int D>
MotionAlongX LayeredSeries<D>::medium(std::size_t row) const {
  return MotionAlongX(impl_->rock_of(row));
}

template <int D>
std::array<TimeSeries, std::size_t(along_x_count)> LayeredSeries<D>::waves_at(std::size_t row) const {
  return waves_along_x_at(*impl_->series, impl_->response, impl_->rock_of(row), impl_->depths[row],
                          impl_->layer_of(row));
}

template <int D>
std::array<std::vector<Complex>, 5> LayeredSeries<D>::fields_at(std::size_t row) const {
  return impl_->series->template sums_at<5>(impl_->depths[row], impl_->layer_of(row), [&](std::size_t wave) {
    return impl_->response.waves()[wave].fields;
  });
}

template <int D>
TimeSeries LayeredSeries<D>::sum_of(const std::array<std::vector<Complex>, 5>& spectra,
                                    const std::vector<std::array<double, 5>>& factors,
                                    const std::vector<double>& earlier_s) const {
  return impl_->series->sum_of(spectra, factors, earlier_s);
}

SLIPWAVE_INSTANTIATE_D(TYPE, class LayeredSeries);

template <int D, class Real>
std::unique_ptr<IncidentWave<D, Real>> make_layered_wave(const Scene<D>& scene, const Source<D>& source,
                                                         const PlaneForm<D>& form, const Domain<D>& domain,
                                                         const PlaneWaveWay<D>& way) {
  const LayeredSeries<D> series(scene, source, form, domain, way);
  auto layered = std::make_unique<LayeredWave<D, Real>>(domain.grid, form.origin()[0], form.slowness()[0]);
  for (std::size_t row = 0; row < std::size_t(domain.grid.shape[D - 1]); ++row)
    layered->add_row(series.medium(row), series.waves_at(row));
  return layered;
}

SLIPWAVE_INSTANTIATE_D_REAL(FUNCTION, make_layered_wave);

}  // namespace slipwave::solver
