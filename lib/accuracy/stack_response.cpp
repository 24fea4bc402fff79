#include "accuracy/stack_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipwave {
namespace {

using Complex = std::complex<double>;
/// Displacements along a and b and the tractions bb and ab.
using Quantities = std::array<Complex, 4>;
/// Systems of equations solved for a response at most, before its record is cut.
constexpr double most_systems = 25000;
/// What comes after the window has decayed by exp(-5).
constexpr double damping = 5;

/// One plane-wave problem: the layers, an angular frequency and a wave number along them.
class PlaneProblem {
 public:
  PlaneProblem(const LayeredPlaces& places, Complex omega, double k)
      : places_(places), omega_(omega), k_(k), source_(places.source_layer()) {
    for (std::size_t layer = 0; layer < places.layers.size(); ++layer) {
      const auto& rock = places.layers[layer];
      const auto factor = [&](std::size_t wave) {
        return places.losses.empty() ? Complex(1)
                                     : places.losses[layer][wave](omega.real() / (2 * std::numbers::pi));
      };
      speeds_.push_back({rock.vp * factor(0), rock.vs > 0 ? rock.vs * factor(1) : Complex()});
      decay_.push_back({decay(speeds_.back()[0]), rock.vs > 0 ? decay(speeds_.back()[1]) : Complex()});
    }
    const auto count = places.layers.size();
    for (std::size_t layer = 0; layer < count; ++layer)
      for (const bool shear : {false, true})
        for (const bool down : {true, false})
          if ((!shear || !fluid(layer)) && (down ? has_top(layer) : layer + 1 < count))
            waves_.push_back({layer, shear, down});
    solve();
  }
  /// Displacement along a and b; the direct wave times `share`.
  std::array<Complex, 2> motion(const LayeredPlaces::Receiver& at, double direct_share) const {
    std::array<Complex, 2> sum{};
    if (at.layer == source_) {
      const auto own = direct(at.b_m);
      for (std::size_t n = 0; n < 2; ++n) sum[n] = direct_share * own[n];
    }
    for (std::size_t m = 0; m < waves_.size(); ++m) {
      if (waves_[m].layer != at.layer) continue;
      const auto of = wave(waves_[m], at.b_m);
      for (std::size_t n = 0; n < 2; ++n) sum[n] += solution_[m] * of[n];
    }
    return sum;
  }

 private:
  struct Wave {
    std::size_t layer;
    bool shear, down;
  };
  Complex decay(Complex c) const { return std::sqrt(k_ * k_ - omega_ * omega_ / (c * c)); }
  bool fluid(std::size_t layer) const { return !(places_.layers[layer].vs > 0); }
  bool has_top(std::size_t layer) const { return places_.free_surface || layer > 0; }
  double top(std::size_t layer) const { return places_.faces_m[places_.free_surface ? layer : layer - 1]; }

  /// Of potentials p and s and their derivatives along b.
  Quantities of_potentials(std::size_t layer, Complex p, Complex dp, Complex s, Complex ds) const {
    const Complex i(0, 1);
    const auto& rock = places_.layers[layer];
    if (fluid(layer)) return {-i * k_ * p, dp, -rock.rho * omega_ * omega_ * p, 0};
    const auto vs = speeds_[layer][1], mu = rock.rho * vs * vs;
    const auto q = 2 * k_ * k_ - omega_ * omega_ / (vs * vs);
    return {-i * k_ * p - ds, dp - i * k_ * s, mu * (q * p - 2. * i * k_ * ds),
            mu * (-2. * i * k_ * dp - q * s)};
  }
  /// A wave of potential 1 at the face that it leaves.
  Quantities wave(const Wave& of, double b) const {
    const auto m = decay_[of.layer][of.shear];
    const auto value = std::exp(-m * (of.down ? b - top(of.layer) : top(of.layer + 1) - b));
    const auto slope = (of.down ? -1. : 1.) * m * value;
    return of.shear ? of_potentials(of.layer, 0, 0, value, slope)
                    : of_potentials(of.layer, value, slope, 0, 0);
  }
  /// What the source sends out in its own layer, per k dk/2 pi; of its force and its moment.
  Quantities direct(double b) const {
    const Complex i(0, 1);
    const auto& rock = places_.layers[source_];
    const double sign = b >= 0 ? 1 : -1;
    const auto m = decay_[source_][0], g = std::exp(-m * std::abs(b)) / (2. * m);
    const auto c = 1. / (rock.rho * omega_ * omega_);
    // The moment as a force: the divergence of it is ik along a, and across as its waves decay.
    const auto force = [&](Complex decays) -> std::array<Complex, 2> {
      const auto& moment = places_.moment_rate;
      const auto rate = i * omega_;
      return {rate * places_.force[0] + i * k_ * moment(0, 0) + sign * decays * moment(0, 1),
              rate * places_.force[1] + i * k_ * moment(0, 1) + sign * decays * moment(1, 1)};
    };
    const auto of_p = force(m);
    const auto p = c * (of_p[1] * sign * m * g + of_p[0] * i * k_ * g);
    if (fluid(source_)) return of_potentials(source_, p, -sign * m * p, 0, 0);
    const auto l = decay_[source_][1], gs = std::exp(-l * std::abs(b)) / (2. * l);
    const auto of_s = force(l);
    const auto s = c * (of_s[1] * i * k_ * gs - of_s[0] * sign * l * gs);
    return of_potentials(source_, p, -sign * m * p, s, -sign * l * s);
  }

  void add_row(std::size_t quantity, double b, std::initializer_list<std::pair<std::size_t, double>> sides) {
    const auto& last = places_.layers.back();
    const double scale = quantity < 2 ? 1 : 1 / (last.rho * last.vp * std::abs(omega_));
    Complex* row = &matrix_[rows_++ * (waves_.size() + 1)];
    for (const auto& [layer, sign] : sides) {
      for (std::size_t n = 0; n < waves_.size(); ++n)
        if (waves_[n].layer == layer) row[n] += sign * scale * wave(waves_[n], b)[quantity];
      if (layer == source_) row[waves_.size()] -= sign * scale * direct(b)[quantity];
    }
  }
  /// The same at a free surface: inertia of the solid itself.
  void add_drag_of_surface() {
    if (places_.drag_m.empty() || places_.drag_m[0] == 0) return;
    const auto& last = places_.layers.back();
    const auto load =
        omega_ * omega_ * places_.layers[0].rho * places_.drag_m[0] / (last.rho * last.vp * std::abs(omega_));
    Complex* row = &matrix_[(rows_ - 1) * (waves_.size() + 1)];
    for (std::size_t n = 0; n < waves_.size(); ++n)
      if (waves_[n].layer == 0) row[n] += load * wave(waves_[n], top(0))[0];
    if (source_ == 0) row[waves_.size()] -= load * direct(top(0))[0];
  }
  /// To the last row, which says that no shear traction acts on a solid: inertia of fluid that resists its
  /// motion along the face.
  void add_drag(std::size_t solid, std::size_t other, double b, double sign) {
    const auto face = places_.free_surface ? std::max(solid, other) : std::max(solid, other) - 1;
    if (places_.drag_m.empty() || places_.drag_m[face] == 0 || !fluid(other)) return;
    const auto& last = places_.layers.back();
    const auto load = sign * omega_ * omega_ * places_.layers[other].rho * places_.drag_m[face] /
                      (last.rho * last.vp * std::abs(omega_));
    Complex* row = &matrix_[(rows_ - 1) * (waves_.size() + 1)];
    for (const auto& [layer, way] : {std::pair{solid, 1.}, std::pair{other, -1.}}) {
      for (std::size_t n = 0; n < waves_.size(); ++n)
        if (waves_[n].layer == layer) row[n] += way * load * wave(waves_[n], b)[0];
      if (layer == source_) row[waves_.size()] -= way * load * direct(b)[0];
    }
  }
  void solve() {
    const auto count = waves_.size();
    matrix_.assign(count * (count + 1), 0);
    if (places_.free_surface) {
      add_row(2, top(0), {{0, 1}});
      if (!fluid(0)) add_row(3, top(0), {{0, 1}});
      if (!fluid(0)) add_drag_of_surface();
    }
    for (std::size_t n = 0; n + 1 < places_.layers.size(); ++n) {
      const double b = top(n + 1);
      add_row(1, b, {{n, 1}, {n + 1, -1}});
      add_row(2, b, {{n, 1}, {n + 1, -1}});
      const bool slides = fluid(n) || fluid(n + 1);
      if (!slides) add_row(0, b, {{n, 1}, {n + 1, -1}});
      if (!slides) add_row(3, b, {{n, 1}, {n + 1, -1}});
      if (slides && !fluid(n)) add_row(3, b, {{n, 1}});
      if (slides && !fluid(n)) add_drag(n, n + 1, b, -1);
      if (slides && !fluid(n + 1)) add_row(3, b, {{n + 1, 1}});
      if (slides && !fluid(n + 1)) add_drag(n + 1, n, b, 1);
    }
    eliminate(count);
  }
  /// Gauss with pivots.
  void eliminate(std::size_t count) {
    const auto at = [&](std::size_t row, std::size_t column) -> Complex& {
      return matrix_[row * (count + 1) + column];
    };
    for (std::size_t column = 0; column < count; ++column) {
      std::size_t best = column;
      for (std::size_t row = column + 1; row < count; ++row)
        if (std::norm(at(row, column)) > std::norm(at(best, column))) best = row;
      if (best != column)
        for (std::size_t n = column; n <= count; ++n) std::swap(at(best, n), at(column, n));
      const auto inverse = 1. / at(column, column);
      for (std::size_t row = column + 1; row < count; ++row) {
        if (at(row, column) == 0.) continue;
        const auto factor = at(row, column) * inverse;
        for (std::size_t n = column; n <= count; ++n) at(row, n) -= factor * at(column, n);
      }
    }
    solution_.assign(count, 0);
    for (std::size_t row = count; row-- > 0;) {
      auto value = at(row, count);
      for (std::size_t n = row + 1; n < count; ++n) value -= at(row, n) * solution_[n];
      solution_[row] = value / at(row, row);
    }
  }

  const LayeredPlaces& places_;
  Complex omega_;
  double k_;
  std::size_t source_, rows_ = 0;
  std::vector<std::array<Complex, 2>> speeds_, decay_;  // of P and S waves by layer
  std::vector<Wave> waves_;
  std::vector<Complex> matrix_, solution_;
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

}  // namespace

std::size_t LayeredPlaces::source_layer() const {
  std::size_t layer = 0;
  for (std::size_t n = free_surface ? 1 : 0; n < faces_m.size(); ++n) layer += faces_m[n] <= 0;
  return layer;
}

StackResponse::StackResponse(const LayeredPlaces& places, const Wavelet& wavelet, double band_hz) {
  constexpr double pi = std::numbers::pi;
  const double slowest = slowest_of(places), fastest = fastest_of(places);
  const double evanescent = 6 / least_way(places);
  const auto largest_k = [&](double omega) {
    return std::clamp(1.2 * omega / slowest + evanescent, 2 * omega / slowest, 2.5 * omega / slowest);
  };
  const auto period_m = [&](double seconds) { return 1.25 * fastest * seconds; };
  const auto systems = [&](double seconds) {
    return band_hz * seconds * (1 + largest_k(pi * band_hz) * period_m(seconds) / pi) *
           double(1 + places.faces_m.size() + 2 * places.layers.size());
  };
  seconds_ = places.duration_s;
  while (systems(1.1 * seconds_) > most_systems * double(4 + places.layers.size()) && seconds_ * band_hz > 8)
    seconds_ *= 0.9;
  const double window_s = 1.1 * seconds_, dk = 2 * pi / period_m(window_s);
  const auto bins = std::size_t(std::max(4., band_hz * window_s));
  const MotionSpectrum none(bins);
  motion_.assign(places.receivers.size(), none);
  by_face_.assign(places.faces_m.size(), motion_);
  by_drag_ = by_face_;
  by_speed_.assign(2 * places.layers.size(), motion_);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const Complex omega(2 * pi * (double(bin) + 0.5) / window_s, -damping / window_s);
    omega_.push_back(omega);
    const Complex source = wavelet.amplitude_spectrum(omega.real() / (2 * pi)) *
                           std::exp(Complex(0, -1.5 / wavelet.nominal_hz()) * omega) *
                           (places.point_source ? std::sqrt(omega.real()) : 1);
    const auto most = std::int64_t(largest_k(std::max(std::abs(omega), 1.)) / dk);
    for (std::int64_t n = -most; n <= most; ++n)
      add_wave_number(places, bin, double(n) * dk, source / period_m(window_s), slowest);
  }
  times_ = std::size_t(std::ceil(2.2 * band_hz * seconds_)) + 1;
  for (const auto& omega : omega_)
    for (std::size_t n = 0; n < times_; ++n)
      phases_.push_back(std::exp(Complex(0, seconds_ * double(n) / double(times_ - 1)) * omega));
}

void StackResponse::add_wave_number(const LayeredPlaces& places, std::size_t bin, double k, Complex scale,
                                    double slowest) {
  const auto omega = omega_[bin];
  // The direct wave does not decay with k where receivers lie as deep as the source: it is tapered.
  const double at = std::abs(k) * slowest / std::abs(omega);
  const double share = at < 1.3 ? 1 : at > 2 ? 0 : 0.5 + 0.5 * std::cos(std::numbers::pi * (at - 1.3) / 0.7);
  const PlaneProblem base(places, omega, k);
  std::vector<std::array<Complex, 2>> of_base;
  for (std::size_t r = 0; r < places.receivers.size(); ++r) {
    of_base.push_back(base.motion(places.receivers[r], share));
    const auto phase = scale * std::exp(Complex(0, -k * places.receivers[r].a_m));
    for (std::size_t n = 0; n < 2; ++n) motion_[r][bin][n] += phase * of_base[r][n];
  }
  const auto add_change = [&](const LayeredPlaces& changed, double by, std::vector<MotionSpectrum>& into) {
    const PlaneProblem problem(changed, omega, k);
    for (std::size_t r = 0; r < places.receivers.size(); ++r) {
      const auto found = problem.motion(places.receivers[r], share);
      const auto phase = scale / by * std::exp(Complex(0, -k * places.receivers[r].a_m));
      for (std::size_t n = 0; n < 2; ++n) into[r][bin][n] += phase * (found[n] - of_base[r][n]);
    }
  };
  constexpr double small = 1e-5;
  auto changed = places;
  for (std::size_t face = 0; face < places.faces_m.size(); ++face) {
    const double by = small * slowest / std::abs(omega);
    changed.faces_m[face] += by;
    add_change(changed, by, by_face_[face]);
    changed.faces_m[face] = places.faces_m[face];
    if (places.drags.empty() || !places.drags[face]) continue;
    changed.drag_m.assign(places.faces_m.size(), 0);
    changed.drag_m[face] = by;
    add_change(changed, by, by_drag_[face]);
    changed.drag_m.clear();
  }
  for (std::size_t layer = 0; layer < places.layers.size(); ++layer)
    for (const std::size_t wave : {0, 1}) {
      auto& rock = changed.layers[layer];
      auto& speed = wave == 0 ? rock.vp : rock.vs;
      if (!(speed > 0)) continue;
      speed *= 1 + small;
      add_change(changed, small, by_speed_[2 * layer + wave]);
      rock = places.layers[layer];
    }
}

double StackResponse::energy(const MotionSpectrum& spectrum) const {
  double sum = 0;
  for (std::size_t n = 0; n < times_; ++n) {
    std::array<double, 2> value{};
    for (std::size_t bin = 0; bin < spectrum.size(); ++bin) {
      const auto& phase = phases_[bin * times_ + n];
      for (std::size_t c = 0; c < 2; ++c) value[c] += (spectrum[bin][c] * phase).real();
    }
    sum += value[0] * value[0] + value[1] * value[1];
  }
  return sum;
}

}  // namespace slipwave
