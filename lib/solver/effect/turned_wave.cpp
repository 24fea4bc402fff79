// SPDX-License-Identifier: BSD-3-Clause
#include "solver/effect/turned_wave.hpp"

#include <algorithm>
#include <cmath>

#include "base/instantiate.hpp"
#include "rock/space_motion.hpp"
#include "scene/subdomains.hpp"
#include "solver/effect/layered_wave.hpp"

namespace slipwave::solver {
namespace {

using Rows = FieldRows<3>;
constexpr std::size_t field_count = std::size_t(Rows::count);

/// The waves along an axis that fields are made of, and their velocities.
std::vector<std::pair<WaveFields<3>, double>> waves_along(int axis, const MotionAlongX& medium,
                                                          const WaveFields<3>& fields) {
  std::vector<std::pair<WaveFields<3>, double>> waves;
  const auto of = [&](int row) { return fields[std::size_t(row)]; };
  WaveFields<3> rest = fields;
  for (const double sign : {1., -1.}) {
    WaveFields<3> p{}, s{};
    const auto set = [&](WaveFields<3>& wave, int row, double value) {
      wave[std::size_t(row)] = value;
      rest[std::size_t(row)] -= value;
    };
    const double v = (of(axis) - sign * of(Rows::normal_stress(axis)) / medium.zp) / 2;
    set(p, axis, v);
    set(p, Rows::normal_stress(axis), -sign * medium.zp * v);
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      set(p, Rows::normal_stress(other), -sign * medium.zp * medium.passive * v);
      if (medium.zs == 0) continue;
      const double across = (of(other) - sign * of(Rows::shear_stress(axis, other)) / medium.zs) / 2;
      set(s, other, across);
      set(s, Rows::shear_stress(axis, other), -sign * medium.zs * across);
    }
    waves.emplace_back(p, sign * medium.vp);
    if (medium.zs > 0) waves.emplace_back(s, sign * medium.vs);
  }
  waves.emplace_back(rest, 0);
  return waves;
}

/// Returns the waves along an axis in a rock of any symmetry, and their velocities, in m/s.
std::vector<std::pair<WaveFields<3>, double>> waves_along(int axis, const Elasticity<3>& stiffness,
                                                          double rho, const WaveFields<3>& fields) {
  std::vector<std::pair<WaveFields<3>, double>> waves;
  WaveFields<3> rest = fields;
  const auto all = slipwave::waves_along<3>(stiffness, unit_vector<3>(std::size_t(axis)));
  for (std::size_t n = 0; n < 3; ++n) {
    constexpr double rounding = 1e-12;
    if (all.values[n] < rounding * all.values[0]) continue;
    const auto& motion = all.vectors[n];
    const double c = std::sqrt(all.values[n] / rho);
    double v = 0, t = 0;
    for (int i = 0; i < 3; ++i) {
      const int row = Rows::stress(axis, i);
      v += motion[std::size_t(i)] * fields[std::size_t(i)];
      t += motion[std::size_t(i)] * fields[std::size_t(row)];
    }
    for (const double sign : {1., -1.}) {
      const double size = (v - sign * t / (rho * c)) / 2;
      Point<3> slowness{}, velocity = motion;
      slowness[std::size_t(axis)] = sign / c;
      for (auto& part : velocity) part *= size;
      const auto wave = fields_of_motion<3, double>(stiffness, slowness, velocity);
      for (std::size_t row = 0; row < field_count; ++row) rest[row] -= wave[row];
      waves.emplace_back(wave, sign * c);
    }
  }
  waves.emplace_back(rest, 0);
  return waves;
}

/// Returns how far sweeps are ahead at every stage between the sweeps of a step.
std::vector<SweepsAhead> all_ahead(int time_order, double dt_s) {
  const auto sweeps = splitting(3, time_order);
  const SweepClocks<3> clocks(sweeps, dt_s);
  std::vector<SweepsAhead> all;
  for (std::size_t n = 0; n < sweeps.size(); ++n) {
    const auto at = clocks.before({0, n}).axis_s;
    all.push_back({at[0] - at[2], at[1] - at[2]});
  }
  return all;
}

using SpaceSeries = std::array<TimeSeries, field_count>;

template <class Real>
class TurnedWave : public IncidentWave<3, Real> {
 public:
  TurnedWave(const Domain<3>& domain, const Source<3>& source, const std::array<double, 2>& slowness,
             double vp, std::vector<SweepsAhead> stages, double dt_s)
      : grid_(domain.grid),
        at_m_{source.position_m[0], source.position_m[1]},
        slowness_(slowness),
        beside_(3 * (1 + (std::abs(slowness[0]) + std::abs(slowness[1])) * vp)),
        stages_(std::move(stages)),
        rounding_s_(1e-6 * dt_s),
        later_s_(std::size_t(domain.grid.shape[2]), 0) {}

  /// Known in the zone of that side of z alone.
  void enters_only(int side) { only_ = side; }
  /// Sets by how much a row is later than its series say, in s.
  void set_delay(std::size_t row, double later_s) { later_s_[row] = later_s; }
  /// Adds the series of a stage: one for all rows, or that of the next row.
  void add(std::size_t stage, SpaceSeries series) {
    series_.resize(stages_.size());
    series_[stage].push_back(std::move(series));
  }

  void begin(State<3, Real>& state) override {
    for (std::int64_t line = 0; line < state.layout.lines(); ++line)
      values({}, 0, 0, state.layout.line_index(line), 0, grid_.shape[0],
             state.field_row(state.layout.line_index(line), 0), state.layout.row_pitch());
  }
  bool enters(int axis, int side) const override { return only_ < 0 || (axis == 2 && side == only_); }
  bool reaches(const StepTime& time, const Index<3>& line) const override {
    const double apart = beside_ * time.dt_s, later = later_by(line);
    const double one = slowness_[0] * (grid_.origin_m[0] - at_m_[0]),
                 other = slowness_[0] * (grid_.end(0) - at_m_[0]);
    for (std::size_t stage = 0; stage < series_.size(); ++stage)
      for (const auto& series : series_of(stage, line))
        if (!series.is_zero(time.end_s() - later - std::max(one, other) - apart,
                            time.end_s() - later - std::min(one, other) + apart))
          return true;
    return false;
  }
  bool values(const Clocks<3>& clocks, int, int, const Index<3>& line, std::int64_t x_first,
              std::int64_t count, Real* to, std::int64_t pitch) const override {
    const auto& series = series_of(stage_of(clocks), line);
    const double step_s = -slowness_[0] * grid_.spacing_m,
                 t_s = clocks.axis_s[2] - later_by(line) - slowness_[0] * (grid_.centre(0, 0) - at_m_[0]),
                 begin_s = t_s + double(x_first) * step_s, end_s = begin_s + double(count - 1) * step_s;
    bool any = false;
    for (const auto& one : series)
      any = any || !one.is_zero(std::min(begin_s, end_s), std::max(begin_s, end_s));
    if (!any) return false;
    for (std::size_t row = 0; row < field_count; ++row)
      series[row].values(t_s, step_s, x_first, count, 1, to + std::int64_t(row) * pitch);
    return true;
  }
  std::int64_t memory_bytes() const override {
    std::int64_t bytes = 0;
    for (const auto& stage : series_)
      for (const auto& row : stage)
        for (const auto& one : row) bytes += one.memory_bytes();
    return bytes;
  }

 private:
  double later_by(const Index<3>& line) const {
    return later_s_[std::size_t(line[2])] + slowness_[1] * (grid_.centre(1, line[1]) - at_m_[1]);
  }
  std::size_t stage_of(const Clocks<3>& clocks) const {
    const double x_s = clocks.axis_s[0] - clocks.axis_s[2], y_s = clocks.axis_s[1] - clocks.axis_s[2];
    for (std::size_t n = 0; n < stages_.size(); ++n)
      if (std::abs(stages_[n].x_s - x_s) < rounding_s_ && std::abs(stages_[n].y_s - y_s) < rounding_s_)
        return n;
    return 0;
  }
  const SpaceSeries& series_of(std::size_t stage, const Index<3>& line) const {
    const auto& rows = series_[stage];
    return rows[rows.size() == 1 ? 0 : std::size_t(line[2])];
  }

  Grid<3> grid_;
  std::array<double, 2> at_m_, slowness_;
  double beside_;  // steps
  std::vector<SweepsAhead> stages_;
  double rounding_s_;
  std::vector<double> later_s_;                   // of each row
  std::vector<std::vector<SpaceSeries>> series_;  // [stage][row]
  int only_ = -1;
};

/// The wavelet's sum over parts, in closed form.
SpaceSeries series_of_wavelet(const Wavelet& wavelet, const std::vector<ShiftedFields>& parts) {
  const double interval_s =
      std::visit([](const auto& shape) { return shape.fine_interval_s(); }, wavelet.shape());
  double longest_s = 0;
  for (const auto& part : parts) longest_s = std::max(longest_s, std::abs(part.earlier_s));
  const auto beside = std::int64_t(std::ceil(longest_s / interval_s)) + 3;
  const auto count = std::int64_t(std::ceil(wavelet.duration_s() / interval_s)) + 2 * beside + 1;
  std::array<std::vector<float>, field_count> samples;
  for (std::int64_t n = 0; n < count; ++n) {
    WaveFields<3> sum{};
    for (const auto& part : parts) {
      const double w = wavelet(double(n - beside) * interval_s + part.earlier_s);
      for (std::size_t row = 0; row < field_count; ++row) sum[row] += part.fields[row] * w;
    }
    for (std::size_t row = 0; row < field_count; ++row) samples[row].push_back(float(sum[row]));
  }
  SpaceSeries series;
  for (std::size_t row = 0; row < field_count; ++row) {
    const bool none =
        std::all_of(samples[row].begin(), samples[row].end(), [](float sample) { return sample == 0; });
    if (!none) series[row] = {std::move(samples[row]), -double(beside) * interval_s, interval_s};
  }
  return series;
}

/// Returns the series of a row in layers; `parts_of` says what becomes of its N fields.
template <std::size_t N, class Layers, class PartsOf>
SpaceSeries series_of_layers(Layers& layers, const std::array<std::vector<std::complex<double>>, N>& spectra,
                             const PartsOf& parts_of) {
  std::vector<double> earlier_s;
  std::array<std::vector<std::array<double, N>>, field_count> factors;  // [row][part][field]
  for (std::size_t field = 0; field < N; ++field) {
    std::array<double, N> one{};
    one[field] = 1;
    const auto parts = parts_of(one);
    earlier_s.resize(parts.size());
    for (auto& of_row : factors) of_row.resize(parts.size());
    for (std::size_t part = 0; part < parts.size(); ++part) {
      earlier_s[part] = parts[part].earlier_s;
      for (std::size_t row = 0; row < field_count; ++row) factors[row][part][field] = parts[part].fields[row];
    }
  }
  SpaceSeries series;
  for (std::size_t row = 0; row < field_count; ++row)
    series[row] = layers.sum_of(spectra, factors[row], earlier_s);
  return series;
}

/// What becomes of fields whose waves along an axis `waves_of` says.
template <class WavesOf>
std::vector<ShiftedFields> split_ahead(const WaveFields<3>& fields, const std::array<double, 2>& slowness,
                                       const SweepsAhead& ahead, const WavesOf& waves_of) {
  std::vector<ShiftedFields> parts = {{fields, 0}};
  for (const int axis : {0, 1}) {
    const double ahead_s = axis == 0 ? ahead.x_s : ahead.y_s;
    if (ahead_s == 0 || slowness[std::size_t(axis)] == 0) continue;
    std::vector<ShiftedFields> split;
    for (const auto& part : parts)
      for (const auto& [wave, velocity] : waves_of(axis, part.fields))
        split.push_back({wave, part.earlier_s + slowness[std::size_t(axis)] * velocity * ahead_s});
    parts = std::move(split);
  }
  return parts;
}

}  // namespace

std::vector<ShiftedFields> parts_ahead(const MotionAlongX& medium, const WaveFields<3>& fields,
                                       const std::array<double, 2>& slowness, const SweepsAhead& ahead) {
  return split_ahead(fields, slowness, ahead,
                     [&](int axis, const WaveFields<3>& of) { return waves_along(axis, medium, of); });
}

std::vector<ShiftedFields> parts_ahead(const Elasticity<3>& stiffness, double rho,
                                       const WaveFields<3>& fields, const std::array<double, 2>& slowness,
                                       const SweepsAhead& ahead) {
  return split_ahead(fields, slowness, ahead, [&](int axis, const WaveFields<3>& of) {
    return waves_along(axis, stiffness, rho, of);
  });
}

WaveFields<3> turned(const MotionAlongX& medium, const PlaneFields& fields,
                     const std::array<double, 2>& along) {
  const auto [x, y] = along;
  // Plane strain: lambda (e_rr + e_zz).
  const double srr = fields[plane_sxx], szz = fields[plane_szz],
               across = medium.passive / (1 + medium.passive) * (srr + szz);
  WaveFields<3> space{};
  const auto set = [&](int row, double value) { space[std::size_t(row)] = value; };
  set(Rows::velocity(0), fields[plane_vx] * x);
  set(Rows::velocity(1), fields[plane_vx] * y);
  set(Rows::velocity(2), fields[plane_vz]);
  set(Rows::normal_stress(0), srr * x * x + across * y * y);
  set(Rows::normal_stress(1), srr * y * y + across * x * x);
  set(Rows::normal_stress(2), szz);
  set(Rows::shear_stress(0, 1), (srr - across) * x * y);
  set(Rows::shear_stress(0, 2), fields[plane_sxz] * x);
  set(Rows::shear_stress(1, 2), fields[plane_sxz] * y);
  return space;
}

bool travels_in_anisotropic_rock(const Scene<3>& scene, const Domain<3>& domain, const PlaneWaveWay<3>& way) {
  const auto& medium = scene.model.medium;
  if (way.kind != PlaneWaveKind::layered)
    return material_of(medium, std::size_t(medium.grid().flat(way.entry))).is_anisotropic_in_3d();
  const auto layers = layers_of(scene, domain, way).layers;
  return std::any_of(layers.begin(), layers.end(),
                     [](const Material& layer) { return layer.is_anisotropic_in_3d(); });
}

namespace {

/// The motion and slowness that a plane wave has where it comes from.
struct Incident {
  Point<3> slowness{}, motion{};
  double depth_m = 0;  // of the source
  Incident(const Source<3>& source, const Material& rock) : depth_m(source.position_m[2]) {
    const auto& plane = std::get<PlaneWave<3>>(source.mechanism);
    const auto of = space_motion(rock, plane.direction, plane.along, plane.shear);
    motion = of.motion;
    for (std::size_t axis = 0; axis < 3; ++axis) slowness[axis] = plane.direction[axis] / of.speed;
  }
  std::array<double, 2> along() const { return {slowness[0], slowness[1]}; }
};

/// Series of all stages, of each row of layers.
template <class Real>
void add_layers(const Scene<3>& scene, const Source<3>& source, const Domain<3>& domain,
                const PlaneWaveWay<3>& way, const Incident& incident, const std::vector<SweepsAhead>& stages,
                TurnedWave<Real>& wave) {
  const StackResponse<3> response({layers_of(scene, domain, way),
                                   {scene.edges[2][0], scene.edges[2][1]},
                                   way.entry_side == 0,
                                   incident.slowness,
                                   incident.motion});
  const auto window =
      window_of(scene, source, domain, incident.along(), incident.slowness[2], response.reference_m());
  StackSeries series(
      {response.waves().begin(), response.waves().end()},
      [&](std::complex<double> omega) { return response.solve(omega); }, source.wavelet, source.amplitude,
      window);
  const auto& column = response.stack().column;
  const auto depths = depths_of_rows(domain);
  for (std::size_t row = 0; row < depths.size(); ++row) {
    const auto& rock = column.layers[column.of_row[row]];
    const auto stiffness = elasticity_of<3>(rock);
    const auto spectra = series.sums_at<field_count>(
        depths[row], column.of_row[row], [&](std::size_t n) { return response.waves()[n].fields; });
    for (std::size_t stage = 0; stage < stages.size(); ++stage)
      wave.add(stage, series_of_layers(series, spectra, [&](const WaveFields<3>& fields) {
                 return parts_ahead(stiffness, rock.rho, fields, incident.along(), stages[stage]);
               }));
  }
}

template <class Real>
std::unique_ptr<IncidentWave<3, Real>> make_anisotropic_wave(const Scene<3>& scene, const Source<3>& source,
                                                             const Domain<3>& domain,
                                                             const PlaneWaveWay<3>& way, double dt_s) {
  const auto& medium = scene.model.medium;
  const auto rock = material_of(medium, std::size_t(medium.grid().flat(way.entry)));
  const Incident incident(source, rock);
  const auto stages = all_ahead(scene.numerics.time_order, dt_s);
  auto wave = std::make_unique<TurnedWave<Real>>(domain, source, incident.along(),
                                                 fastest_speed(medium, scene.subdomain), stages, dt_s);
  if (way.kind == PlaneWaveKind::layered) {
    add_layers(scene, source, domain, way, incident, stages, *wave);
    return wave;
  }
  if (way.by_entry_only) wave->enters_only(way.entry_side);
  const auto depths = depths_of_rows(domain);
  for (std::size_t row = 0; row < depths.size(); ++row)
    wave->set_delay(row, incident.slowness[2] * (depths[row] - incident.depth_m));
  const auto stiffness = elasticity_of<3>(rock);
  auto velocity = incident.motion;
  for (auto& part : velocity) part *= source.amplitude;
  const auto fields = fields_of_motion<3, double>(stiffness, incident.slowness, velocity);
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    wave->add(stage, series_of_wavelet(source.wavelet, parts_ahead(stiffness, rock.rho, fields,
                                                                   incident.along(), stages[stage])));
  return wave;
}

}  // namespace

template <class Real>
std::unique_ptr<IncidentWave<3, Real>> make_turned_wave(const Scene<3>& scene, const Source<3>& source,
                                                        const PlaneForm<3>& form, const Domain<3>& domain,
                                                        const PlaneWaveWay<3>& way, double dt_s) {
  if (travels_in_anisotropic_rock(scene, domain, way))
    return make_anisotropic_wave<Real>(scene, source, domain, way, dt_s);
  const auto& plane = std::get<PlaneWave<3>>(source.mechanism);
  const std::array<double, 2> slowness = {form.slowness()[0] * plane.along[0],
                                          form.slowness()[0] * plane.along[1]};
  const auto stages = all_ahead(scene.numerics.time_order, dt_s);
  auto wave = std::make_unique<TurnedWave<Real>>(
      domain, source, slowness, fastest_speed(scene.model.medium, scene.subdomain), stages, dt_s);
  const auto depths = depths_of_rows(domain);
  if (way.kind == PlaneWaveKind::layered) {
    const LayeredSeries<3> layers(scene, source, form, domain, way);
    for (std::size_t row = 0; row < depths.size(); ++row) {
      const auto medium = layers.medium(row);
      const auto spectra = layers.fields_at(row);
      for (std::size_t stage = 0; stage < stages.size(); ++stage)
        wave->add(stage, series_of_layers(layers, spectra, [&](const PlaneFields& fields) {
                    return parts_ahead(medium, turned(medium, fields, plane.along), slowness, stages[stage]);
                  }));
    }
    return wave;
  }
  if (way.by_entry_only) wave->enters_only(way.entry_side);
  for (std::size_t row = 0; row < depths.size(); ++row)
    wave->set_delay(row, form.slowness()[1] * (depths[row] - form.origin()[1]));
  const auto fields = turned(form.medium(), form.factors(), plane.along);
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    wave->add(stage,
              series_of_wavelet(source.wavelet, parts_ahead(form.medium(), fields, slowness, stages[stage])));
  return wave;
}

SLIPWAVE_INSTANTIATE_REAL(FUNCTION, make_turned_wave);

}  // namespace slipwave::solver
