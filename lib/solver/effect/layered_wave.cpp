#include "solver/effect/layered_wave.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/fft.hpp"
#include "model/plane_motion.hpp"

namespace slipwave::solver {
namespace {

using Complex = std::complex<double>;
using Fields = std::array<Complex, 5>;

/// Equations reach so many unknowns to either side of the diagonal, at most.
constexpr std::size_t half_band = 8, band = 3 * half_band + 1;

/// A system of linear equations with a narrow band, solved by Gauss with pivots.
class BandSystem {
 public:
  explicit BandSystem(std::size_t count) : count_(count), matrix_(count * band), right_(count) {}
  Complex& at(std::size_t row, std::size_t column) { return matrix_[row * band + column + half_band - row]; }
  Complex& right(std::size_t row) { return right_[row]; }
  std::vector<Complex> solve() {
    for (std::size_t n = 0; n < count_; ++n) {
      const auto last_row = std::min(n + half_band + 1, count_),
                 last = std::min(n + 2 * half_band + 1, count_);
      std::size_t best = n;
      for (auto row = n + 1; row < last_row; ++row)
        if (std::norm(at(row, n)) > std::norm(at(best, n))) best = row;
      if (best != n) {
        for (auto column = n; column < last; ++column) std::swap(at(n, column), at(best, column));
        std::swap(right_[n], right_[best]);
      }
      for (auto row = n + 1; row < last_row; ++row) {
        if (at(row, n) == 0.) continue;
        const auto factor = at(row, n) / at(n, n);
        for (auto column = n; column < last; ++column) at(row, column) -= factor * at(n, column);
        right_[row] -= factor * right_[n];
      }
    }
    for (auto n = count_; n-- > 0;) {
      for (auto column = n + 1; column < std::min(n + 2 * half_band + 1, count_); ++column)
        right_[n] -= at(n, column) * right_[column];
      right_[n] /= at(n, n);
    }
    return std::move(right_);
  }

 private:
  std::size_t count_;
  std::vector<Complex> matrix_, right_;
};

/// The slowness across the layers of a wave of speed c: down it decays, or travels down.
Complex across(double c, double along) {
  const double square = 1 / (c * c) - along * along, least = 1e-7 / c;
  // Where waves turn, up and down are one: kept apart by a hair.
  if (square >= 0) return std::max(std::sqrt(square), least);
  return {0, -std::max(std::sqrt(-square), least)};
}

}  // namespace

double PlaneStackResponse::reference_of(std::size_t layer, bool down) const {
  const double bottom = stack_.depths_m[layer + 1], top = stack_.depths_m[layer];
  const bool first = layer == 0 && stack_.ends[0] == EdgeLaw::absorbing,
             last = layer + 1 == stack_.layers.size() && stack_.ends[1] == EdgeLaw::absorbing;
  return first ? bottom : last ? top : down ? top : bottom;
}

PlaneStackResponse::Wave PlaneStackResponse::make_in_anisotropic(std::size_t layer, bool shear,
                                                                 bool down) const {
  const auto& rock = stack_.layers[layer];
  const auto wave = layer_waves(rock, stack_.slowness, down)[shear];
  const auto [sxx, szz, sxz] = stress_of_motion(rock, stack_.slowness, wave.down, wave.x, wave.z);
  return {layer, reference_of(layer, down), wave.down, {wave.x, wave.z, sxx, szz, sxz}};
}

PlaneStackResponse::Wave PlaneStackResponse::make_incident() const {
  const std::size_t layer = stack_.from_top ? 0 : stack_.layers.size() - 1;
  const auto& rock = stack_.layers[layer];
  if (!rock.is_anisotropic()) return make(layer, stack_.shear, stack_.from_top);
  const double p = stack_.slowness, q = stack_.down, size = std::hypot(p, q);
  const auto motion = plane_motion(rock, p / size, q / size, stack_.shear);
  const auto [sxx, szz, sxz] = stress_of_motion(rock, p, q, motion.x, motion.z);
  return {layer, reference_of(layer, stack_.from_top), q, {motion.x, motion.z, sxx, szz, sxz}};
}

PlaneStackResponse::Wave PlaneStackResponse::make(std::size_t layer, bool shear, bool down) const {
  const auto& rock = stack_.layers[layer];
  if (rock.is_anisotropic()) return make_in_anisotropic(layer, shear, down);
  const double p = stack_.slowness, c = shear ? rock.vs : rock.vp;
  const Complex q = (down ? 1. : -1.) * across(c, p);
  // Velocity along the slowness, or across it.
  const Complex vx = c * (shear ? q : Complex(p)), vz = c * (shear ? Complex(-p) : q);
  const double mu = rock.rho * rock.vs * rock.vs, lambda = rock.rho * rock.vp * rock.vp - 2 * mu;
  const Complex spread = p * vx + q * vz;
  return {layer,
          reference_of(layer, down),
          q,
          {vx, vz, -(lambda * spread + 2 * mu * p * vx), -(lambda * spread + 2. * mu * q * vz),
           -mu * (p * vz + q * vx)}};
}

void PlaneStackResponse::list_waves() {
  const auto count = stack_.layers.size();
  for (std::size_t layer = 0; layer < count; ++layer) {
    first_wave_.push_back(waves_.size());
    for (const bool down : {true, false})
      for (const bool shear : {false, true}) {
        const bool comes_from_outside = down ? layer == 0 && stack_.ends[0] == EdgeLaw::absorbing
                                             : layer + 1 == count && stack_.ends[1] == EdgeLaw::absorbing;
        if (!comes_from_outside && (!shear || stack_.layers[layer].vs > 0))
          waves_.push_back(make(layer, shear, down));
      }
  }
  first_wave_.push_back(waves_.size());
  waves_.push_back(make_incident());
}

std::vector<Complex> PlaneStackResponse::solve(Complex omega) const {
  const auto unknowns = waves_.size() - 1, count = stack_.layers.size();
  BandSystem equations(unknowns);
  std::size_t row = 0;
  const double unit = stack_.layers.front().rho * stack_.layers.front().vp;
  const auto value = [&](const Wave& wave, std::size_t field, double z) {
    const auto decay = std::exp(Complex(0, -1) * omega * wave.slowness * (z - wave.reference_m));
    return wave.fields[field] * decay / (field < 2 ? 1 : unit);
  };
  // One field at a depth, of a layer and less that of another: zero.
  const auto add = [&](std::size_t field, double z,
                       std::initializer_list<std::pair<std::size_t, double>> of) {
    for (const auto& [layer, sign] : of) {
      for (auto n = first_wave_[layer]; n < first_wave_[layer + 1]; ++n)
        equations.at(row, n) += sign * value(waves_[n], field, z);
      if (waves_.back().layer == layer) equations.right(row) -= sign * value(waves_.back(), field, z);
    }
    ++row;
  };
  const auto solid = [&](std::size_t layer) { return stack_.layers[layer].vs > 0; };
  const auto add_end = [&](std::size_t layer, EdgeLaw law, double z) {
    if (law == EdgeLaw::absorbing) return;
    add(law == EdgeLaw::free ? plane_szz : plane_vz, z, {{layer, 1}});
    if (solid(layer)) add(law == EdgeLaw::rigid ? plane_vx : plane_sxz, z, {{layer, 1}});
  };
  add_end(0, stack_.ends[0], stack_.depths_m.front());
  for (std::size_t n = 0; n + 1 < count; ++n) {
    const double z = stack_.depths_m[n + 1];
    for (const auto field : {plane_vz, plane_szz}) add(field, z, {{n, 1}, {n + 1, -1}});
    if (solid(n) && solid(n + 1)) {
      for (const auto field : {plane_vx, plane_sxz}) add(field, z, {{n, 1}, {n + 1, -1}});
    } else {
      for (const auto layer : {n, n + 1})
        if (solid(layer)) add(plane_sxz, z, {{layer, 1}});
    }
  }
  add_end(count - 1, stack_.ends[1], stack_.depths_m.back());
  auto amplitudes = equations.solve();
  amplitudes.emplace_back(1);
  return amplitudes;
}

namespace {

/// The spectra of the stack's fields as functions of t - slowness (x - x_s), on bins of frequency.
class StackSeries {
 public:
  StackSeries(const PlaneStack& stack, const Wavelet& wavelet, double amplitude, double arrival_s,
              double first_s, double last_s);
  /// The waves along x of a depth, which lies in that layer.
  std::array<TimeSeries, std::size_t(along_x_count)> at(double z, std::size_t layer);
  /// The fields there, as spectra.
  std::array<std::vector<Complex>, 5> fields_at(double z, std::size_t layer) const;
  TimeSeries series_of(const std::vector<Complex>& spectrum);
  std::size_t bins() const { return bins_; }
  Complex omega(std::size_t bin) const {
    return {2 * std::numbers::pi * double(bin) / (double(length_) * interval_s_), -decay_};
  }

 private:
  /// Calls `see(bin, amplitude)` of a wave at a depth.
  template <class See>
  void each_bin(std::size_t wave, double z, const See& see) const;
  std::vector<float> samples_of(const std::vector<Complex>& spectrum, double& first_s);

  const PlaneStack& stack_;
  PlaneStackResponse response_;
  double interval_s_, first_s_, last_s_, decay_;
  std::size_t length_, bins_;
  std::vector<Complex> source_;                   // [bin]
  std::vector<std::vector<Complex>> amplitudes_;  // [bin][wave]
  RealTransform transform_;
  double largest_;
};

/// What comes later than the window has decayed by this.
constexpr double left_over = 1e-3;

double interval_for(const Wavelet& wavelet) {
  constexpr double per_shortest_period = 14;
  return 1 / (per_shortest_period * wavelet.highest_frequency_hz(0.01));
}

StackSeries::StackSeries(const PlaneStack& stack, const Wavelet& wavelet, double amplitude, double arrival_s,
                         double first_s, double last_s)
    : stack_(stack),
      response_(stack),
      interval_s_(interval_for(wavelet)),
      first_s_(first_s),
      last_s_(last_s),
      length_(fast_transform_length(
          std::size_t((2 * (last_s - first_s) + 2 * wavelet.duration_s()) / interval_s_) + 16)),
      bins_(length_ / 2 + 1),
      transform_(length_),
      largest_(std::abs(amplitude)) {
  const double window_s = double(length_) * interval_s_;
  decay_ = -std::log(left_over) / window_s;
  std::vector<double> samples;
  for (double t = 0; t <= wavelet.duration_s() && samples.size() < length_; t += interval_s_)
    samples.push_back(wavelet(t) * std::exp(-decay_ * t));
  const auto spectrum = transform_.forward(samples);
  source_.assign(spectrum.begin(), spectrum.end());
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    const Complex omega(2 * std::numbers::pi * double(bin) / window_s, -decay_);
    source_[bin] *= amplitude * std::exp(Complex(0, -1) * omega * (arrival_s - first_s_));
    amplitudes_.push_back(response_.solve(omega));
  }
}

/// From bin to bin the phase grows by the same factor.
template <class See>
void StackSeries::each_bin(std::size_t wave, double z, const See& see) const {
  const double step = 2 * std::numbers::pi / (double(length_) * interval_s_);
  const auto& of = response_.waves()[wave];
  const auto way = Complex(0, -1) * of.slowness * (z - of.reference_m);
  const auto factor = std::exp(way * step);
  auto phase = std::exp(way * Complex(0, -decay_));
  for (std::size_t bin = 0; bin < bins_; ++bin, phase *= factor)
    see(bin, phase * amplitudes_[bin][wave] * source_[bin]);
}

std::array<std::vector<Complex>, 5> StackSeries::fields_at(double z, std::size_t layer) const {
  std::array<std::vector<Complex>, 5> spectra;
  for (auto& spectrum : spectra) spectrum.assign(bins_, 0);
  for (std::size_t n = 0; n < response_.waves().size(); ++n) {
    const auto& wave = response_.waves()[n];
    if (wave.layer != layer) continue;
    each_bin(n, z, [&](std::size_t bin, const Complex& here) {
      for (std::size_t f = 0; f < spectra.size(); ++f) spectra[f][bin] += here * wave.fields[f];
    });
  }
  return spectra;
}

TimeSeries StackSeries::series_of(const std::vector<Complex>& spectrum) {
  double first_s = 0;
  auto samples = samples_of(spectrum, first_s);
  return {std::move(samples), first_s, interval_s_};
}

std::array<TimeSeries, std::size_t(along_x_count)> StackSeries::at(double z, std::size_t layer) {
  const auto& rock = stack_.layers[layer];
  const MotionAlongX medium(rock);
  std::array<std::vector<Complex>, std::size_t(along_x_count)> spectra;
  for (auto& spectrum : spectra) spectrum.assign(bins_, 0);
  for (std::size_t n = 0; n < response_.waves().size(); ++n) {
    const auto& wave = response_.waves()[n];
    if (wave.layer != layer) continue;
    PlaneFields real{}, imaginary{};
    for (std::size_t f = 0; f < 5; ++f) real[f] = wave.fields[f].real(), imaginary[f] = wave.fields[f].imag();
    const auto of_real = waves_along_x(medium, real), of_imaginary = waves_along_x(medium, imaginary);
    each_bin(n, z, [&](std::size_t bin, const Complex& here) {
      for (std::size_t k = 0; k < spectra.size(); ++k)
        spectra[k][bin] += here * Complex(of_real[k], of_imaginary[k]);
    });
  }
  std::array<TimeSeries, std::size_t(along_x_count)> series;
  for (std::size_t k = 0; k < spectra.size(); ++k) series[k] = series_of(spectra[k]);
  return series;
}

/// Up to the last time needed, without what is next to nothing before and after.
std::vector<float> StackSeries::samples_of(const std::vector<Complex>& spectrum, double& first_s) {
  constexpr double nothing = 1e-8;
  constexpr std::size_t beside = 6;
  const auto all = transform_.backward(spectrum);
  const auto count = std::min(length_, std::size_t((last_s_ - first_s_) / interval_s_) + 2 * beside);
  std::vector<float> samples;
  double largest = 0;
  for (std::size_t n = 0; n < count; ++n) {
    samples.push_back(float(all[n] * std::exp(decay_ * double(n) * interval_s_)));
    largest = std::max(largest, std::abs(double(samples.back())));
  }
  const auto counts = [&](float value) {
    return std::abs(double(value)) > nothing * std::max(largest, largest_);
  };
  const auto first = std::find_if(samples.begin(), samples.end(), counts);
  const auto last = std::find_if(samples.rbegin(), std::make_reverse_iterator(first), counts).base();
  const auto skipped = std::max<std::int64_t>(first - samples.begin() - std::int64_t(beside), 0);
  const auto end =
      std::min<std::int64_t>(last - samples.begin() + std::int64_t(beside), std::int64_t(samples.size()));
  first_s = first_s_ + double(skipped) * interval_s_;
  if (first == samples.end()) return {};
  return {samples.begin() + skipped, samples.begin() + end};
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

/// The layers of the column, and which each row of the computed grid is in.
template <int D>
PlaneStack stack_of(const Scene<D>& scene, const PlaneWave<D>& wave, const Domain<D>& domain,
                    const PlaneWaveWay<D>& way, std::vector<std::size_t>& layer_of_row) {
  constexpr int z = D - 1;
  const auto& medium = scene.model.medium;
  PlaneStack stack;
  stack.ends = {scene.edges[z][0], scene.edges[z][1]};
  stack.from_top = way.entry_side == 0;
  stack.shear = wave.shear;
  const auto entry = material_of(medium, std::size_t(medium.grid().flat(way.entry)));
  const double speed = plane_motion(entry, wave.across(), wave.direction[z], wave.shear).speed;
  stack.slowness = wave.across() / speed;
  stack.down = wave.direction[z] / speed;
  double depth = 0;
  for (std::int64_t k = 0; k < domain.grid.shape[z]; ++k) {
    auto cell = way.column;
    cell[z] = std::clamp<std::int64_t>(k - domain.low_zone[z], 0, domain.model_grid.shape[z] - 1);
    const double top = top_of_row(domain, k);
    depth = top_of_row(domain, k + 1);
    const auto layer = material_of(medium, std::size_t(medium.grid().flat(cell)));
    if (stack.layers.empty() || !(stack.layers.back() == layer)) {
      stack.layers.push_back(layer);
      stack.depths_m.push_back(top);
    }
    layer_of_row.push_back(stack.layers.size() - 1);
  }
  stack.depths_m.push_back(depth);
  return stack;
}

}  // namespace

template <int D>
struct LayeredSeries<D>::Impl {
  Impl(const Scene<D>& scene, const Source<D>& source, const PlaneForm<D>& form, const Domain<D>& domain,
       const PlaneWaveWay<D>& way)
      : stack(stack_of(scene, std::get<PlaneWave<D>>(source.mechanism), domain, way, layer_of_row)),
        depths(depths_of_rows(domain)) {
    // Slowness times the way along the layers, of any cell; and when the wave comes to the first row.
    const auto& plane = std::get<PlaneWave<D>>(source.mechanism);
    double least = 0, most = 0;
    for (int axis = 0; axis < D - 1; ++axis) {
      const double slowness = form.slowness()[0] * plane.along[std::size_t(axis)],
                   at = source.position_m[std::size_t(axis)];
      const double low = slowness * (domain.grid.origin_m[axis] - at),
                   high = slowness * (domain.grid.end(axis) - at);
      least += std::min(low, high);
      most += std::max(low, high);
    }
    const double latest_s = scene.recording.duration_s + 0.1 * source.wavelet.duration_s() - least;
    const double reference = PlaneStackResponse(stack).reference_m(), x = form.origin()[0];
    const double arrival_s = form.arrival_s(x, reference);
    double first_s = std::min(arrival_s, -most);
    for (const double z : {depths.front(), depths.back()}) first_s = std::min(first_s, form.arrival_s(x, z));
    first_s -= source.wavelet.duration_s();
    series.emplace(stack, source.wavelet, source.amplitude, arrival_s, first_s, latest_s);
  }

  std::vector<std::size_t> layer_of_row;
  PlaneStack stack;
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
  return MotionAlongX(impl_->stack.layers[impl_->layer_of_row[row]]);
}

template <int D>
std::array<TimeSeries, std::size_t(along_x_count)> LayeredSeries<D>::waves_at(std::size_t row) const {
  return impl_->series->at(impl_->depths[row], impl_->layer_of_row[row]);
}

template <int D>
std::array<std::vector<Complex>, 5> LayeredSeries<D>::fields_at(std::size_t row) const {
  return impl_->series->fields_at(impl_->depths[row], impl_->layer_of_row[row]);
}

template <int D>
TimeSeries LayeredSeries<D>::sum_of(const std::array<std::vector<Complex>, 5>& spectra,
                                    const std::vector<std::array<double, 5>>& factors,
                                    const std::vector<double>& earlier_s) const {
  std::vector<Complex> sum(impl_->series->bins());
  // From bin to bin the phase of a part grows by the same factor.
  const Complex first = Complex(0, 1) * impl_->series->omega(0),
                step = Complex(0, 1) * impl_->series->omega(1) - first;
  for (std::size_t part = 0; part < factors.size(); ++part) {
    const auto& of = factors[part];
    if (std::all_of(of.begin(), of.end(), [](double factor) { return factor == 0; })) continue;
    auto phase = std::exp(first * earlier_s[part]);
    const auto turn = std::exp(step * earlier_s[part]);
    for (std::size_t bin = 0; bin < sum.size(); ++bin, phase *= turn) {
      Complex here = 0;
      for (std::size_t field = 0; field < of.size(); ++field) here += of[field] * spectra[field][bin];
      sum[bin] += here * phase;
    }
  }
  return impl_->series->series_of(sum);
}

template class LayeredSeries<2>;
template class LayeredSeries<3>;

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

template std::unique_ptr<IncidentWave<2, float>> make_layered_wave(const Scene<2>&, const Source<2>&,
                                                                   const PlaneForm<2>&, const Domain<2>&,
                                                                   const PlaneWaveWay<2>&);
template std::unique_ptr<IncidentWave<2, double>> make_layered_wave(const Scene<2>&, const Source<2>&,
                                                                    const PlaneForm<2>&, const Domain<2>&,
                                                                    const PlaneWaveWay<2>&);
template std::unique_ptr<IncidentWave<3, float>> make_layered_wave(const Scene<3>&, const Source<3>&,
                                                                   const PlaneForm<3>&, const Domain<3>&,
                                                                   const PlaneWaveWay<3>&);
template std::unique_ptr<IncidentWave<3, double>> make_layered_wave(const Scene<3>&, const Source<3>&,
                                                                    const PlaneForm<3>&, const Domain<3>&,
                                                                    const PlaneWaveWay<3>&);

}  // namespace slipwave::solver
