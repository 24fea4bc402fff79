// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/layered_wave.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/instantiate.hpp"
#include "rock/coefficients.hpp"
#include "rock/space_motion.hpp"
#include "scene/subdomains.hpp"

namespace slipwave::solver {
namespace {

/// The unit motion and the slowness that a plane wave has where it comes from.
template <int D>
struct Incident {
  Point<D> slowness{}, motion{};
  Incident(const PlaneWave<D>& wave, const Material& rock) {
    double speed = 0;
    if constexpr (D == 2) {
      const auto of = plane_motion(rock, wave.direction[0], wave.direction[1], wave.shear);
      speed = of.speed, motion = {of.x, of.z};
    } else {
      const auto of = space_motion(rock, wave.direction, wave.along, wave.shear);
      speed = of.speed, motion = of.motion;
    }
    for (std::size_t axis = 0; axis < D; ++axis) slowness[axis] = wave.direction[axis] / speed;
  }
};

/// Depths of the centres of rows of the computed grid, m; all rows are level.
template <int D>
std::vector<double> depths_of_rows(const Domain<D>& domain) {
  std::vector<double> depths_m;
  for (std::int64_t k = 0; k < domain.grid.shape[D - 1]; ++k) {
    Index<D> above{}, below{};
    above[D - 1] = k, below[D - 1] = k + 1;
    depths_m.push_back(domain.model_grid.rows ? (corner_depth(domain, above) + corner_depth(domain, below)) *
                                                    domain.grid.spacing_m / 2
                                              : domain.grid.centre(D - 1, k));
  }
  return depths_m;
}

/// The times that a wave in layers is asked for: of any cell, and when it comes to the first row. Its
/// amplitude is counted at the depth reference_m.
template <int D>
SeriesWindow window_of(const Scene<D>& scene, const Source<D>& source, const Grid<D>& grid,
                       const Point<D>& slowness, const std::vector<double>& depths_m, double reference_m) {
  double least = 0, most = 0;
  for (int axis = 0; axis < D - 1; ++axis) {
    const double at = source.position_m[std::size_t(axis)], along = slowness[std::size_t(axis)];
    const double low = along * (grid.origin_m[axis] - at), high = along * (grid.end(axis) - at);
    least += std::min(low, high);
    most += std::max(low, high);
  }
  const auto arrival_s = [&](double z) { return slowness[D - 1] * (z - source.position_m[D - 1]); };
  SeriesWindow window{arrival_s(reference_m), -most,
                      scene.recording.duration_s + 0.1 * source.wavelet.duration_s() - least};
  for (const double z : {reference_m, depths_m.front(), depths_m.back()})
    window.first_s = std::min(window.first_s, arrival_s(z));
  window.first_s -= source.wavelet.duration_s();
  return window;
}

/// The wavelet, at the intervals of its fine_interval_s().
TimeSeries series_of_wavelet(const Wavelet& wavelet) {
  const double interval_s =
      std::visit([](const auto& shape) { return shape.fine_interval_s(); }, wavelet.shape());
  constexpr std::int64_t beside = 3;
  const auto count = std::int64_t(std::ceil(wavelet.duration_s() / interval_s)) + 2 * beside + 1;
  std::vector<float> samples;
  for (std::int64_t n = 0; n < count; ++n) samples.push_back(float(wavelet(double(n - beside) * interval_s)));
  return {std::move(samples), -double(beside) * interval_s, interval_s};
}

}  // namespace

template <int D, class Real>
LayeredWave<D, Real>::LayeredWave(const Scene<D>& scene, const Source<D>& source, const Domain<D>& domain,
                                  PlaneWaveGround<D> ground, double dt_s)
    : grid_(domain.grid), at_m_(source.position_m), rounding_s_(1e-6 * dt_s) {
  const auto& way = ground.way;
  const Incident<D> incident(std::get<PlaneWave<D>>(source.mechanism), ground.rock);
  slowness_ = incident.slowness;
  if (way.by_entry_only) only_ = way.entry_side;
  beside_steps_ = 1;
  for (std::size_t axis = 0; axis + 1 < D; ++axis)
    beside_steps_ += std::abs(slowness_[axis]) * fastest_speed(scene.model.medium, scene.subdomain);
  // Sweeps of a step advance fields by more than a step nowhere.
  beside_steps_ *= 3;
  const auto sweeps = splitting(D, scene.numerics.time_order);
  const SweepClocks<D> clocks(sweeps, dt_s);
  for (std::size_t n = 0; n < sweeps.size(); ++n) {
    const auto ahead = ahead_of(clocks.before({0, n}));
    if (!stage_of(ahead)) stages_.push_back(ahead);
  }
  reads_.resize(stages_.size());
  const auto depths_m = depths_of_rows(domain);
  if (way.kind == PlaneWaveKind::layered)
    set_in_layers({std::move(ground.layers),
                   {scene.edges[D - 1][0], scene.edges[D - 1][1]},
                   way.entry_side == 0,
                   slowness_,
                   incident.motion},
                  scene, source, depths_m);
  else
    set_in_one_medium(ground.rock, source, incident.motion, depths_m);
  sum_long_reads();
}

template <int D, class Real>
double LayeredWave<D, Real>::AxisWave::size(const WaveFields<D>& all) const {
  double sum = 0;
  for (std::size_t row = 0; row < all.size(); ++row) sum += weights[row] * all[row];
  return sum;
}

/// As many as there are fields, so that fields are the sum of them all: those that travel, and what sweeps
/// along the axis leave alone (theory.md (A19)).
template <int D, class Real>
auto LayeredWave<D, Real>::axis_waves(const Elasticity<D>& stiffness, double rho, std::size_t axis)
    -> std::vector<AxisWave> {
  using Rows = FieldRows<D>;
  constexpr double rounding = 1e-12;
  std::vector<AxisWave> waves;
  // Of each row what travelling waves leave of each field, and the largest term in it.
  std::array<WaveFields<D>, std::size_t(Rows::count)> rest{}, largest{};
  for (std::size_t row = 0; row < rest.size(); ++row) rest[row][row] = largest[row][row] = 1;
  const auto moving = waves_along<D>(stiffness, unit_vector<D>(axis));
  for (std::size_t n = 0; n < D; ++n) {
    if (moving.values[n] < rounding * moving.values[0]) continue;
    const double c = std::sqrt(moving.values[n] / rho);
    for (const double sign : {1., -1.}) {
      AxisWave wave;
      wave.velocity = sign * c;
      Point<D> slowness{};
      slowness[axis] = sign / c;
      wave.fields = fields_of_motion<D, double>(stiffness, slowness, moving.vectors[n]);
      for (int i = 0; i < D; ++i) {
        wave.weights[std::size_t(Rows::velocity(i))] = moving.vectors[n][std::size_t(i)] / 2;
        wave.weights[std::size_t(Rows::stress(int(axis), i))] =
            -sign * moving.vectors[n][std::size_t(i)] / (2 * rho * c);
      }
      for (std::size_t row = 0; row < rest.size(); ++row)
        for (std::size_t k = 0; k < rest.size(); ++k) {
          const double term = wave.fields[row] * wave.weights[k];
          rest[row][k] -= term;
          largest[row][k] = std::max(largest[row][k], std::abs(term));
        }
      waves.push_back(wave);
    }
  }
  for (std::size_t row = 0; row < rest.size(); ++row) {
    AxisWave still;
    still.fields[row] = 1;
    bool any = false;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      if (std::abs(rest[row][k]) <= rounding * largest[row][k]) continue;
      still.weights[k] = rest[row][k];
      any = true;
    }
    if (any) waves.push_back(still);
  }
  return waves;
}

/// What becomes of reads when sweeps along the axes from `first_axis` on, one after the other, go ahead: each
/// moves the waves along its axis that the fields are made of.
template <int D, class Real>
auto LayeredWave<D, Real>::reads_of(std::vector<Read> reads, const Material& rock, const Ahead& ahead,
                                    std::size_t first_axis) const -> std::vector<Read> {
  const auto add = [&](std::vector<Read>& all, const Read& read) {
    const auto alike = std::find_if(all.begin(), all.end(), [&](const Read& other) {
      return other.series == read.series && std::abs(other.earlier_s - read.earlier_s) < rounding_s_;
    });
    if (alike == all.end()) return all.push_back(read);
    for (std::size_t row = 0; row < read.fields.size(); ++row) alike->fields[row] += read.fields[row];
  };
  for (std::size_t axis = first_axis; axis + 1 < D; ++axis) {
    if (ahead[axis] == 0 || slowness_[axis] == 0) continue;
    const auto waves = axis_waves(elasticity_of<D>(rock), rock.rho, axis);
    std::vector<Read> split;
    for (const auto& read : reads)
      for (const auto& wave : waves) {
        auto part = read;
        part.earlier_s += slowness_[axis] * wave.velocity * ahead[axis];
        const double size = wave.size(read.fields);
        if (size == 0) continue;
        for (std::size_t row = 0; row < part.fields.size(); ++row) part.fields[row] = wave.fields[row] * size;
        add(split, part);
      }
    reads = std::move(split);
  }
  return reads;
}

template <int D, class Real>
void LayeredWave<D, Real>::set_in_one_medium(const Material& rock, const Source<D>& source,
                                             const Point<D>& motion, const std::vector<double>& depths_m) {
  auto velocity = motion;
  for (auto& part : velocity) part *= source.amplitude;
  const Read incident{0, 0, fields_of_motion<D, double>(elasticity_of<D>(rock), slowness_, velocity)};
  for (std::size_t stage = 0; stage < stages_.size(); ++stage)
    reads_[stage] = {reads_of({incident}, rock, stages_[stage], 0)};
  series_ = {{series_of_wavelet(source.wavelet)}};
  layers_.assign(depths_m.size(), 0);
  for (const double depth : depths_m) later_s_.push_back(slowness_[D - 1] * (depth - at_m_[D - 1]));
}

template <int D, class Real>
void LayeredWave<D, Real>::set_in_layers(LayerStack<D> stack, const Scene<D>& scene, const Source<D>& source,
                                         const std::vector<double>& depths_m) {
  using Complex = std::complex<double>;
  const StackResponse<D> response(std::move(stack));
  StackSeries series(
      {response.waves().begin(), response.waves().end()},
      [&](Complex omega) { return response.solve(omega); }, source.wavelet, source.amplitude,
      window_of(scene, source, grid_, slowness_, depths_m, response.reference_m()));
  const auto& layers = response.stack().layers;
  for (const double depth : depths_m) layers_.push_back(layers.at(depth));
  later_s_.assign(depths_m.size(), 0);
  std::vector<std::vector<AxisWave>> along_x;
  for (const auto& rock : layers.rocks) {
    along_x.push_back(axis_waves(elasticity_of<D>(rock), rock.rho, 0));
    for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
      std::vector<Read> reads;
      for (std::size_t n = 0; n < along_x.back().size(); ++n) {
        const auto& wave = along_x.back()[n];
        reads.push_back({n, slowness_[0] * wave.velocity * stages_[stage][0], wave.fields});
      }
      reads_[stage].push_back(reads_of(std::move(reads), rock, stages_[stage], 1));
    }
  }
  for (std::size_t row = 0; row < depths_m.size(); ++row) {
    const auto& waves = along_x[layers_[row]];
    constexpr auto count = std::size_t(FieldRows<D>::count);
    const auto spectra = series.template sums_at<count>(depths_m[row], layers_[row], [&](std::size_t n) {
      std::array<Complex, count> sizes{};
      for (std::size_t k = 0; k < waves.size(); ++k)
        for (std::size_t field = 0; field < count; ++field)
          sizes[k] += waves[k].weights[field] * response.waves()[n].fields[field];
      return sizes;
    });
    series_.emplace_back();
    for (std::size_t k = 0; k < waves.size(); ++k) series_.back().push_back(series.series_of(spectra[k]));
  }
}

template <int D, class Real>
TimeSeries LayeredWave<D, Real>::sum_of(const std::vector<Read>& reads, const std::vector<TimeSeries>& series,
                                        std::size_t field) {
  constexpr auto none = std::numeric_limits<double>::infinity();
  double first_s = none, end_s = -none, interval_s = none;
  const auto each = [&](const auto& see) {
    for (const auto& read : reads)
      if (const auto& of = series[read.series]; read.fields[field] != 0 && !of.empty()) see(read, of);
  };
  each([&](const Read& read, const TimeSeries& of) {
    first_s = std::min(first_s, of.first_s() - read.earlier_s);
    end_s = std::max(end_s, of.end_s() - read.earlier_s);
    interval_s = std::min(interval_s, of.interval_s());
  });
  if (end_s <= first_s) return {};
  std::vector<double> one(std::size_t((end_s - first_s) / interval_s) + 1);
  std::vector<double> sum(one.size(), 0);
  each([&](const Read& read, const TimeSeries& of) {
    of.values(first_s + read.earlier_s, interval_s, 0, std::int64_t(one.size()), one.data());
    for (std::size_t n = 0; n < one.size(); ++n) sum[n] += read.fields[field] * one[n];
  });
  return {{sum.begin(), sum.end()}, first_s, interval_s};
}

/// Sums reads beforehand of stages that have more of them than there are fields: where sweeps along x and y
/// are ahead, each wave along x is read at up to seven times.
template <int D, class Real>
void LayeredWave<D, Real>::sum_long_reads() {
  constexpr auto count = std::size_t(FieldRows<D>::count);
  const auto all = reads_;
  for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
    const auto is_long = [&](const std::vector<Read>& reads) { return reads.size() > count; };
    if (std::none_of(all[stage].begin(), all[stage].end(), is_long)) continue;
    const auto first = series_.front().size();
    for (auto& reads : reads_[stage]) {
      reads.assign(count, {});
      for (std::size_t field = 0; field < count; ++field)
        reads[field].series = first + field, reads[field].fields[field] = 1;
    }
    for (std::size_t row = 0; row < series_.size(); ++row)
      for (std::size_t field = 0; field < count; ++field)
        series_[row].push_back(sum_of(all[stage][layers_[row]], series_[row], field));
  }
}

template <int D, class Real>
void LayeredWave<D, Real>::begin(State<D, Real>& state) {
  set_cells<D>(state, [&](const Index<D>& at, std::int64_t first, std::int64_t count, Real* to,
                          std::int64_t pitch) { return values({}, 0, 0, at, first, count, to, pitch); });
}

template <int D, class Real>
double LayeredWave<D, Real>::later_by(const Index<D>& line) const {
  double later_s = later_s_[std::size_t(line[D - 1])];
  for (std::size_t axis = 1; axis + 1 < D; ++axis)
    later_s += slowness_[axis] * (grid_.centre(int(axis), line[axis]) - at_m_[axis]);
  return later_s;
}

template <int D, class Real>
auto LayeredWave<D, Real>::ahead_of(const Clocks<D>& clocks) -> Ahead {
  Ahead ahead;
  for (std::size_t axis = 0; axis + 1 < D; ++axis) ahead[axis] = clocks.axis_s[axis] - clocks.axis_s[D - 1];
  return ahead;
}

template <int D, class Real>
std::optional<std::size_t> LayeredWave<D, Real>::stage_of(const Ahead& ahead) const {
  for (std::size_t n = 0; n < stages_.size(); ++n) {
    bool here = true;
    for (std::size_t axis = 0; axis + 1 < D; ++axis)
      here = here && std::abs(ahead[axis] - stages_[n][axis]) < rounding_s_;
    if (here) return n;
  }
  return std::nullopt;
}

template <int D, class Real>
bool LayeredWave<D, Real>::reaches(const StepTime& time, const Index<D>& line) const {
  const double apart = beside_steps_ * time.dt_s, at_s = time.end_s() - later_by(line);
  const double one = slowness_[0] * (grid_.origin_m[0] - at_m_[0]),
               other = slowness_[0] * (grid_.end(0) - at_m_[0]);
  const auto& series = series_of(line);
  return std::any_of(series.begin(), series.end(), [&](const TimeSeries& of) {
    return !of.is_zero(at_s - std::max(one, other) - apart, at_s - std::min(one, other) + apart);
  });
}

template <int D, class Real>
bool LayeredWave<D, Real>::values(const Clocks<D>& clocks, int, int, const Index<D>& line,
                                  std::int64_t x_first, std::int64_t count, Real* to,
                                  std::int64_t pitch) const {
  constexpr int rows = FieldRows<D>::count;
  const auto& series = series_of(line);
  const double step_s = -slowness_[0] * grid_.spacing_m,
               line_s =
                   clocks.axis_s[D - 1] - later_by(line) - slowness_[0] * (grid_.centre(0, 0) - at_m_[0]);
  std::array<Real, std::size_t(incident_piece)> cells;
  bool any = false;
  for (const auto& read : reads_[stage_of(ahead_of(clocks)).value()][layers_[std::size_t(line[D - 1])]]) {
    const auto& of = series[read.series];
    const double t_s = line_s + read.earlier_s, begin_s = t_s + double(x_first) * step_s,
                 end_s = begin_s + double(count - 1) * step_s;
    if (of.is_zero(std::min(begin_s, end_s), std::max(begin_s, end_s))) continue;
    if (!any)
      for (int row = 0; row < rows; ++row) std::fill_n(to + row * pitch, count, Real(0));
    any = true;
    of.values(t_s, step_s, x_first, count, cells.data());
    for (int row = 0; row < rows; ++row) {
      const auto factor = Real(read.fields[std::size_t(row)]);
      if (factor == 0) continue;
      for (std::int64_t i = 0; i < count; ++i) to[row * pitch + i] += factor * cells[std::size_t(i)];
    }
  }
  return any;
}

template <int D, class Real>
std::int64_t LayeredWave<D, Real>::memory_bytes() const {
  std::int64_t bytes = 0;
  for (const auto& row : series_)
    for (const auto& one : row) bytes += one.memory_bytes();
  return bytes;
}

SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class LayeredWave);

}  // namespace slipwave::solver
