// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/stack_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipwave {
namespace {

using Complex = std::complex<double>;
/// Velocities along a and b, the rates of the tractions bb and ab, and the pressure.
using Quantities = std::array<Complex, 5>;
/// Of them those that receivers record.
constexpr std::array<std::size_t, 3> recorded = {0, 1, 4};
/// Systems of equations solved for a response at most, before its record is cut.
constexpr double most_systems = 200000;
/// By so much waves are taken as longer, at most.
constexpr double most_slower = 3;
/// What comes after the window has decayed by exp(-5).
constexpr double damping = 5;

/// Without the checks for numbers that are not finite.
Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// A square matrix whose rows reach few columns beyond the diagonal.
class SparseRows {
 public:
  explicit SparseRows(std::size_t count)
      : count_(count), matrix_(count * count, 0), ends_(count, 0), rows_(count, 0), pivots_(count) {}
  void add(std::size_t row, std::size_t column, const Complex& value) {
    at(row, column) += value;
    ends_[row] = std::max(ends_[row], column + 1);
    rows_[column] = std::max(rows_[column], row + 1);
  }
  /// Into triangles, with pivots.
  void factorise() {
    for (std::size_t n = 1; n < count_; ++n) rows_[n] = std::max(rows_[n], rows_[n - 1]);
    for (std::size_t column = 0; column < count_; ++column) {
      std::size_t best = column;
      for (std::size_t row = column + 1; row < rows_[column]; ++row)
        if (std::norm(at(row, column)) > std::norm(at(best, column))) best = row;
      pivots_[column] = best;
      std::swap(ends_[best], ends_[column]);
      for (std::size_t n = column; best != column && n < count_; ++n) std::swap(at(best, n), at(column, n));
      const auto inverse = 1. / at(column, column);
      for (std::size_t row = column + 1; row < rows_[column]; ++row) {
        if (at(row, column) == 0.) continue;
        const auto factor = at(row, column) = times(at(row, column), inverse);
        ends_[row] = std::max(ends_[row], ends_[column]);
        for (std::size_t n = column + 1; n < ends_[column]; ++n) at(row, n) -= times(factor, at(column, n));
      }
      at(column, column) = inverse;
    }
  }
  /// The right side becomes the solution.
  void solve(std::vector<Complex>& side) const {
    for (std::size_t column = 0; column < count_; ++column) {
      std::swap(side[column], side[pivots_[column]]);
      for (std::size_t row = column + 1; row < rows_[column]; ++row)
        side[row] -= times(at(row, column), side[column]);
    }
    for (std::size_t row = count_; row-- > 0;) {
      for (std::size_t n = row + 1; n < ends_[row]; ++n) side[row] -= times(at(row, n), side[n]);
      side[row] = times(side[row], at(row, row));
    }
  }

 private:
  Complex& at(std::size_t row, std::size_t column) { return matrix_[row * count_ + column]; }
  const Complex& at(std::size_t row, std::size_t column) const { return matrix_[row * count_ + column]; }

  std::size_t count_;
  std::vector<Complex> matrix_;
  std::vector<std::size_t> ends_, rows_, pivots_;  // behind the last column of a row, row of a column
};

/// One plane-wave problem: the layers, an angular frequency and a wave number along them.
class PlaneProblem {
 public:
  /// `slower` times as slow as at the frequency at which losses are taken.
  PlaneProblem(const LayeredPlaces& places, Complex omega, double k, double slower)
      : places_(&places), omega_(omega), k_(k), slower_(slower), source_(places.source_layer()) {
    const auto count = places.layers.size();
    layers_.resize(count);
    for (std::size_t layer = 0; layer < count; ++layer) {
      first_wave_.push_back(waves_);
      for (const bool down : {true, false})
        if (down ? has_top(layer) : layer + 1 < count) waves_ += fluid(layer) ? 1 : 2;
      describe(layer);
    }
    const auto& last = places.layers.back();
    traction_ = 1 / (last.rho * last.vp * std::abs(omega_));
  }
  /// Its waves, and the matrix that gives them.
  void solve(SparseRows& rows) {
    solution_.assign(waves_, 0);
    equations(
        [&](std::size_t row, std::size_t column, const Complex& value) { rows.add(row, column, value); },
        [&](std::size_t row, const Complex& value) { solution_[row] += value; });
    rows.factorise();
    rows.solve(solution_);
  }
  /// The problem of places that differ a little from those of `base` in the layers [first, end), to first
  /// order, by the factors of its matrix.
  void change(const PlaneProblem& base, const SparseRows& rows, const LayeredPlaces& places,
              std::size_t first, std::size_t end) {
    places_ = &places;
    layers_ = base.layers_;
    for (auto layer = first; layer < end; ++layer) describe(layer);
    residual_.assign(waves_, 0);
    equations([&](std::size_t row, std::size_t column,
                  const Complex& value) { residual_[row] -= times(value, base.solution_[column]); },
              [&](std::size_t row, const Complex& value) { residual_[row] += value; });
    rows.solve(residual_);
    for (std::size_t n = 0; n < waves_; ++n) residual_[n] += base.solution_[n];
    solution_.swap(residual_);
  }
  std::size_t waves() const { return waves_; }
  /// What is recorded; the direct wave times `share`.
  std::array<Complex, 3> records(std::size_t layer, double b, double direct_share) const {
    std::array<Complex, 3> sum{};
    if (layer == source_) {
      const auto own = direct(b);
      for (std::size_t n = 0; n < 3; ++n) sum[n] = direct_share * own[recorded[n]];
    }
    auto wave = first_wave_[layer];
    for_waves(layer, [&](bool shear, bool down) {
      const auto of = quantities(layer, shear, down, b);
      for (std::size_t n = 0; n < 3; ++n) sum[n] += times(solution_[wave], of[recorded[n]]);
      ++wave;
    });
    return sum;
  }

 private:
  /// Quantities of the waves of a layer, in their order, at its upper and at its lower face.
  struct LayerWaves {
    std::array<Complex, 2> speed, decay;  // of P and S
    std::array<std::array<Quantities, 4>, 2> at;
    std::array<Quantities, 2> direct;  // of the source, in its own layer
  };

  bool fluid(std::size_t layer) const { return !(places_->layers[layer].vs > 0); }
  bool has_top(std::size_t layer) const { return places_->free_surface || layer > 0; }
  bool has_bottom(std::size_t layer) const { return layer + 1 < places_->layers.size(); }
  double top(std::size_t layer) const { return places_->faces_m[places_->free_surface ? layer : layer - 1]; }
  /// P and S that go down from the upper face, then those that go up from the lower one.
  template <class Act>
  void for_waves(std::size_t layer, Act&& act) const {
    for (const bool down : {true, false})
      for (const bool shear : {false, true})
        if ((!shear || !fluid(layer)) && (down ? has_top(layer) : has_bottom(layer))) act(shear, down);
  }
  void describe(std::size_t layer) {
    auto& of = layers_[layer];
    const auto& rock = places_->layers[layer];
    for (const std::size_t wave : {0, 1}) {
      const double speed = wave == 0 ? rock.vp : rock.vs;
      if (!(speed > 0)) continue;
      of.speed[wave] = speed;
      if (!places_->losses.empty()) {
        // What is lost in a second is as much as of the true waves.
        const auto factor = places_->losses[layer][wave](omega_.real() * slower_ / (2 * std::numbers::pi));
        of.speed[wave] *= std::polar(std::abs(factor), std::arg(factor) * slower_);
      }
      of.decay[wave] = std::sqrt(k_ * k_ - omega_ * omega_ / (of.speed[wave] * of.speed[wave]));
    }
    for (const std::size_t lower : {0, 1}) {
      if (lower == 0 ? !has_top(layer) : !has_bottom(layer)) continue;
      const double b = top(layer + lower);
      std::size_t n = 0;
      for_waves(layer, [&](bool shear, bool down) { of.at[lower][n++] = quantities(layer, shear, down, b); });
      if (layer == source_) of.direct[lower] = direct(b);
    }
  }

  /// Of potentials p and s and their derivatives along b.
  Quantities of_potentials(std::size_t layer, Complex p, Complex dp, Complex s, Complex ds) const {
    const Complex i(0, 1);
    const auto& rock = places_->layers[layer];
    const auto pressure = -i * rock.rho * times(omega_, p);
    if (fluid(layer)) return {-i * k_ * p, dp, -rock.rho * omega_ * omega_ * p, 0, pressure};
    const auto [vp, vs] = layers_[layer].speed;
    const auto mu = rock.rho * vs * vs;
    const auto q = 2 * k_ * k_ - omega_ * omega_ / (vs * vs);
    return {-i * k_ * p - ds, dp - i * k_ * s, times(mu, times(q, p) - 2. * k_ * times(i, ds)),
            times(mu, -2. * k_ * times(i, dp) - times(q, s)), times(pressure, 1. - vs * vs / (vp * vp))};
  }
  /// A wave of potential 1 at the face that it leaves.
  Quantities quantities(std::size_t layer, bool shear, bool down, double b) const {
    const auto m = layers_[layer].decay[shear];
    const double way = down ? b - top(layer) : top(layer + 1) - b;
    const auto value = way == 0 ? Complex(1) : std::exp(-m * way);
    const auto slope = (down ? -1. : 1.) * times(m, value);
    return shear ? of_potentials(layer, 0, 0, value, slope) : of_potentials(layer, value, slope, 0, 0);
  }
  /// What the source sends out in its own layer, per k dk/2 pi; of its force and its moment.
  Quantities direct(double b) const {
    const Complex i(0, 1);
    const auto& rock = places_->layers[source_];
    const double sign = b >= 0 ? 1 : -1;
    const auto m = layers_[source_].decay[0], g = std::exp(-m * std::abs(b)) / (2. * m);
    const auto c = 1. / (rock.rho * omega_ * omega_);
    // The moment as a force: the divergence of it is ik along a, and across as its waves decay.
    const auto force = [&](Complex decays) -> std::array<Complex, 2> {
      const auto& moment = places_->moment_rate;
      const auto rate = i * omega_;
      return {rate * places_->force[0] + i * k_ * moment(0, 0) + sign * decays * moment(0, 1),
              rate * places_->force[1] + i * k_ * moment(0, 1) + sign * decays * moment(1, 1)};
    };
    const auto of_p = force(m);
    const auto p = c * (of_p[1] * sign * m * g + of_p[0] * i * k_ * g);
    if (fluid(source_)) return of_potentials(source_, p, -sign * m * p, 0, 0);
    const auto l = layers_[source_].decay[1], gs = std::exp(-l * std::abs(b)) / (2. * l);
    const auto of_s = force(l);
    const auto s = c * (of_s[1] * i * k_ * gs - of_s[0] * sign * l * gs);
    return of_potentials(source_, p, -sign * m * p, s, -sign * l * s);
  }

  /// Calls entry(row, column, value) and right(row, value) for all equations of all faces.
  template <class Entry, class Right>
  void equations(Entry&& entry, Right&& right) const {
    std::size_t row = 0;
    const auto term = [&](std::size_t quantity, std::size_t layer, bool lower, Complex factor) {
      const auto& of = layers_[layer];
      const auto count =
          (layer + 1 < first_wave_.size() ? first_wave_[layer + 1] : waves_) - first_wave_[layer];
      for (std::size_t n = 0; n < count; ++n)
        entry(row, first_wave_[layer] + n, times(factor, of.at[lower][n][quantity]));
      if (layer == source_) right(row, -times(factor, of.direct[lower][quantity]));
    };
    const auto drag = [&](std::size_t face) { return places_->drag_m.empty() ? 0. : places_->drag_m[face]; };
    const auto square = omega_ * omega_ * traction_;
    if (places_->free_surface) {
      term(2, 0, false, traction_);
      ++row;
      if (!fluid(0)) {
        term(3, 0, false, traction_);
        // Inertia of the solid itself.
        if (drag(0) != 0) term(0, 0, false, square * places_->layers[0].rho * drag(0));
        ++row;
      }
    }
    for (std::size_t n = 0; n + 1 < places_->layers.size(); ++n) {
      const auto both = [&](std::size_t quantity, double scale) {
        term(quantity, n, true, scale);
        term(quantity, n + 1, false, -scale);
        ++row;
      };
      // No shear traction acts on a solid beside fluid but inertia of fluid that resists its motion along the
      // face.
      const auto alone = [&](std::size_t solid, std::size_t other, double sign) {
        term(3, solid, solid == n, traction_);
        if (const double thick = drag(places_->free_surface ? n + 1 : n); thick != 0 && fluid(other)) {
          const auto load = sign * square * places_->layers[other].rho * thick;
          term(0, solid, solid == n, load);
          term(0, other, other == n, -load);
        }
        ++row;
      };
      both(1, 1);
      both(2, traction_);
      if (!fluid(n) && !fluid(n + 1)) {
        both(0, 1);
        both(3, traction_);
      } else {
        if (!fluid(n)) alone(n, n + 1, -1);
        if (!fluid(n + 1)) alone(n + 1, n, 1);
      }
    }
  }

  const LayeredPlaces* places_;
  Complex omega_;
  double k_, slower_, traction_ = 0;
  std::size_t source_, waves_ = 0;
  std::vector<std::size_t> first_wave_;
  std::vector<LayerWaves> layers_;
  std::vector<Complex> solution_, residual_;
};

/// The least way across the layers of any wave but the direct one, and that only counts where it crosses.
double least_way(const LayeredPlaces& places) {
  double least = 1e30;
  const auto from = places.source_layer();
  for (const auto& at : places.receivers) {
    if (at.layer != from) {
      least = std::min(least, std::abs(at.b_m));
      continue;
    }
    for (const double face : places.faces_m)
      least = std::min(least, std::abs(face) + std::abs(face - at.b_m));
  }
  return std::max(least, 1.);
}

double slowest_of(const LayeredPlaces& places) {
  double slowest = 1e30;
  for (const auto& rock : places.layers) slowest = std::min(slowest, rock.vs > 0 ? rock.vs : rock.vp);
  return slowest;
}

double fastest_of(const LayeredPlaces& places) {
  double fastest = 0;
  for (const auto& rock : places.layers) fastest = std::max(fastest, rock.vp);
  return fastest;
}

/// What a source becomes where the direction along the layers is turned round: 1 the same, -1 the opposite, 0
/// something else.
double mirror_of(const LayeredPlaces& places) {
  const bool along = places.force[0] != 0 || places.moment_rate(0, 1) != 0;
  const bool across = places.force[1] != 0 || places.moment_rate(0, 0) != 0 || places.moment_rate(1, 1) != 0;
  return along && across ? 0 : along ? -1 : 1;
}

}  // namespace

std::size_t LayeredPlaces::source_layer() const {
  std::size_t layer = 0;
  for (std::size_t n = free_surface ? 1 : 0; n < faces_m.size(); ++n) layer += faces_m[n] <= 0;
  return layer;
}

/// What receivers record of one plane wave.
class StackResponse::PlaneWaves {
 public:
  /// With the wave of -k where the source is its own mirror image (1) or the opposite of it (-1).
  PlaneWaves(StackResponse& response, const LayeredPlaces& places, std::size_t bin, double k, Complex scale,
             double mirror)
      : response_(response),
        places_(places),
        bin_(bin),
        slowest_(slowest_of(places)),
        omega_(response.omega_[bin] / response.slower_),
        base_(places, omega_, k, response.slower_),
        problem_(base_),
        rows_(base_.waves()) {
    // The direct wave does not decay with k where receivers lie as deep as the source: it is tapered.
    const double at = std::abs(k) * slowest_ / std::abs(omega_);
    direct_ = at < 1.3 ? 1 : at > 2 ? 0 : 0.5 + 0.5 * std::cos(std::numbers::pi * (at - 1.3) / 0.7);
    base_.solve(rows_);
    of_base_ = records(base_);
    for (std::size_t r = 0; r < of_base_.size(); ++r) {
      const auto phase = scale * std::exp(Complex(0, -k * places.receivers[r].a_m));
      phases_.push_back({phase, phase, phase});
      if (mirror != 0 && k != 0) {
        const auto back = mirror * scale * std::exp(Complex(0, k * places.receivers[r].a_m));
        phases_[r] = {phase - back, phase + back, phase + back};
      }
      for (std::size_t c = 0; c < 3; ++c)
        response.records_[r][bin][c] += times(phases_[r][c], of_base_[r][c]);
    }
  }
  /// `changed` starts and ends as the places.
  void add_changes(LayeredPlaces& changed) {
    for (std::size_t face = 0; face < places_.faces_m.size(); ++face) {
      const double by = small * slowest_ / std::abs(omega_);
      const auto below = places_.free_surface ? face : face + 1;
      changed.faces_m[face] += by;
      add(changed, below > 0 ? below - 1 : 0, below + 1, by, response_.by_face_[face]);
      changed.faces_m[face] = places_.faces_m[face];
      if (places_.drags.empty() || !places_.drags[face]) continue;
      changed.drag_m.assign(places_.faces_m.size(), 0);
      changed.drag_m[face] = by;
      add(changed, 0, 0, by, response_.by_drag_[face]);
      changed.drag_m.clear();
    }
    for (std::size_t layer = 0; layer < places_.layers.size(); ++layer)
      for (const std::size_t wave : {0, 1}) {
        auto& rock = changed.layers[layer];
        auto& speed = wave == 0 ? rock.vp : rock.vs;
        if (!(speed > 0)) continue;
        speed *= 1 + small;
        add(changed, layer, layer + 1, small, response_.by_speed_[2 * layer + wave]);
        rock = places_.layers[layer];
      }
  }

 private:
  static constexpr double small = 1e-5;
  using Records = std::vector<std::array<Complex, 3>>;

  /// Receivers at one depth differ by their phases.
  Records records(const PlaneProblem& problem) const {
    Records found;
    const auto& all = places_.receivers;
    for (std::size_t r = 0; r < all.size(); ++r)
      found.push_back(r > 0 && all[r].layer == all[r - 1].layer && all[r].b_m == all[r - 1].b_m
                          ? found.back()
                          : problem.records(all[r].layer, all[r].b_m, direct_));
    return found;
  }
  /// Of places that differ by `by` in the layers [first, end).
  void add(const LayeredPlaces& changed, std::size_t first, std::size_t end, double by,
           std::vector<RecordSpectrum>& into) {
    problem_.change(base_, rows_, changed, first, std::min(end, places_.layers.size()));
    const auto found = records(problem_);
    for (std::size_t r = 0; r < found.size(); ++r)
      for (std::size_t c = 0; c < 3; ++c)
        into[r][bin_][c] += times(phases_[r][c], (response_.slower_ / by) * (found[r][c] - of_base_[r][c]));
  }

  StackResponse& response_;
  const LayeredPlaces& places_;
  std::size_t bin_;
  double slowest_, direct_ = 1;
  Complex omega_;
  PlaneProblem base_, problem_;
  SparseRows rows_;
  Records of_base_;
  std::vector<std::array<Complex, 3>> phases_;
};

StackResponse::StackResponse(const LayeredPlaces& places, const Wavelet& wavelet, double band_hz) {
  constexpr double pi = std::numbers::pi;
  const double slowest = slowest_of(places), fastest = fastest_of(places);
  const double evanescent = 6 / least_way(places), mirror = mirror_of(places);
  const auto largest_k = [&](double omega) {
    return std::clamp(1.2 * omega / slowest + evanescent, 2 * omega / slowest, 2.5 * omega / slowest);
  };
  const auto period_m = [&](double seconds) { return 1.25 * fastest * seconds; };
  const auto systems = [&](double seconds, double hz) {
    return (mirror == 0 ? 1 : 0.5) * hz * seconds * (1 + largest_k(pi * hz) * period_m(seconds) / pi) *
           double(1 + places.faces_m.size() + 2 * places.layers.size());
  };
  const double most = most_systems * double(4 + places.layers.size());
  seconds_ = places.duration_s;
  while (systems(1.1 * seconds_, band_hz / slower_) > most && slower_ < most_slower) slower_ *= 1.05;
  band_hz /= slower_;
  while (systems(1.1 * seconds_, band_hz) > most && seconds_ * band_hz > 8) seconds_ *= 0.9;
  window_s_ = 1.1 * seconds_;
  const double dk = 2 * pi / period_m(window_s_);
  const auto bins = std::size_t(std::max(4., band_hz * window_s_));
  const RecordSpectrum none(bins);
  records_.assign(places.receivers.size(), none);
  by_face_.assign(places.faces_m.size(), records_);
  by_drag_ = by_face_;
  by_speed_.assign(2 * places.layers.size(), records_);
  auto changed = places;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const Complex omega(2 * pi * (double(bin) + 0.5) / window_s_, -damping / window_s_);
    omega_.push_back(omega * slower_);
    const Complex source = wavelet.amplitude_spectrum(omega_.back().real() / (2 * pi)) *
                           std::exp(Complex(0, -1.5 / wavelet.nominal_hz()) * omega_.back()) *
                           (places.point_source ? std::sqrt(omega.real()) : 1);
    const auto most_k = std::int64_t(largest_k(std::max(std::abs(omega), 1.)) / dk);
    for (std::int64_t n = mirror == 0 ? -most_k : 0; n <= most_k; ++n)
      PlaneWaves(*this, places, bin, double(n) * dk, source / period_m(window_s_), mirror)
          .add_changes(changed);
  }
  transform_ = std::make_unique<RealTransform>(fast_transform_length(2 * bins + bins / 2 + 2));
}

double StackResponse::energy(const RecordSpectrum& spectrum, Recorded what) const {
  const auto length = transform_->length();
  std::vector<Complex> bins(transform_->bins());
  double sum = 0;
  const std::size_t first = what == Recorded::velocity ? 0 : 2, end = what == Recorded::velocity ? 2 : 3;
  for (auto c = first; c < end; ++c) {
    // Bins lie half between those of the transform.
    std::vector<double> real(length);
    for (const bool imaginary : {false, true}) {
      for (std::size_t n = 0; n < spectrum.size(); ++n)
        bins[n] = imaginary ? Complex(spectrum[n][c].imag(), -spectrum[n][c].real()) : spectrum[n][c];
      bins[0] *= 2;
      const auto found = transform_->backward(bins);
      for (std::size_t n = 0; n < length && double(n) * window_s_ <= seconds_ * double(length); ++n) {
        const double part = double(n) / double(length);
        if (!imaginary) {
          real[n] = found[n] * std::cos(std::numbers::pi * part);
          continue;
        }
        const double value =
            std::exp(damping * part) * (real[n] - found[n] * std::sin(std::numbers::pi * part));
        sum += value * value;
      }
    }
  }
  return sum * double(length) * window_s_;
}

}  // namespace slipwave
