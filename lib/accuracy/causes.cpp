#include "accuracy/causes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "accuracy/local_stack.hpp"
#include "base/error.hpp"

namespace slipwave {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t shots_followed = 2, receivers_followed = 12;
/// Directions of travel, over a quarter circle, that dispersion is taken for.
constexpr std::size_t directions = 6;

/// By how much an interface seems to be moved, as a share of a cell: `cells`^-power of it, with the cells per
/// wavelength of the slowest wave beside it. Fitted to measured errors (docs/accuracy.md).
struct Shift {
  double share, power;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Shift shift_of(const LocalInterface& interface) {
  using enum Representation;
  using Kind = LocalInterface::Kind;
  const double steep = std::abs(std::sin(2 * radians(interface.steepest_deg)));
  switch (interface.representation) {
    case on_faces:
    case fitted:
      return interface.kind == Kind::inner ? Shift{0.5, 1} : Shift{0.5, 1};
    case averaged:
      return {0.14, 0};
    case staircase:
      return {0.8 + 0.7 * steep, 0};
  }
  return {1, 0};
}

double slowest_beside(const LayeredPlaces& places, std::size_t face) {
  const auto below = places.free_surface ? face : face + 1;
  const auto slowest = [](const UniformMedium& rock) { return rock.vs > 0 ? rock.vs : rock.vp; };
  double speed = slowest(places.layers[below]);
  if (below > 0) speed = std::min(speed, slowest(places.layers[below - 1]));
  return speed;
}

/// Errors beyond some tens of percent do not grow as small ones do: waves that are shifted by more than half
/// a period are as wrong as can be.
double saturated(double error) { return error / std::sqrt(1 + error * error / 2); }

}  // namespace

struct ErrorSources::Shot {
  LocalStack stack;
  StackResponse response;
  double nominal_hz;
  double energy = 0;
  std::vector<double> by_face;  // squared error per squared metre, at nominal_hz

  Shot(LocalStack of, const Wavelet& wavelet)
      : stack(std::move(of)),
        response(stack.places, wavelet, wavelet.highest_frequency_hz(0.01)),
        nominal_hz(wavelet.nominal_hz()) {
    const auto receivers = stack.places.receivers.size();
    for (std::size_t r = 0; r < receivers; ++r) energy += response.energy(response.motion(r));
    for (std::size_t face = 0; face < stack.interfaces.size(); ++face) {
      double sum = 0;
      for (std::size_t r = 0; r < receivers; ++r) {
        auto change = response.by_face(face, r);
        for (std::size_t bin = 0; bin < change.size(); ++bin) {
          const double hz = response.omega(bin).real() / (2 * std::numbers::pi);
          const double by = std::pow(hz / nominal_hz, shift_of(stack.interfaces[face]).power);
          for (auto& part : change[bin]) part *= by;
        }
        sum += response.energy(change);
      }
      by_face.push_back(sum);
    }
  }

  /// Squared errors by dispersion of P, of S, and of both.
  std::array<double, 3> dispersion(const Discretisation& cells) const;
  double face_error(std::size_t face, const Discretisation& cells) const {
    const auto shift = shift_of(stack.interfaces[face]);
    const double per_wave = slowest_beside(stack.places, face) / nominal_hz / cells.spacing_m;
    const double by = shift.share * cells.spacing_m * std::pow(per_wave, -shift.power);
    return by_face[face] * by * by;
  }

 private:
  Complex lateness(const Discretisation& cells, const UniformMedium& rock, WaveKind kind, Complex omega,
                   double angle, double way_m) const;
};

/// By which share a wave is slower, as a complex number: its imaginary part is loss.
Complex ErrorSources::Shot::lateness(const Discretisation& cells, const UniformMedium& rock, WaveKind kind,
                                     Complex omega, double angle, double way_m) const {
  const double speed = kind == WaveKind::p ? rock.vp : rock.vs, w = omega.real();
  const double per_wave = 2 * std::numbers::pi * speed / w / cells.spacing_m;
  const double steps = way_m / speed / cells.time_step_s, dt = cells.time_step_s;
  const UniformScheme scheme{cells.order, rock.vp * dt / cells.spacing_m, rock.vs * dt / cells.spacing_m,
                             cells.time_order};
  // Waves shorter than two cells are not on the grid at all: they are lost.
  const auto a_step =
      per_wave <= 2.05 ? Complex(-1, 0) : std::conj(step_error(scheme, kind, per_wave, angle));
  const auto all = steps * a_step;
  const auto limited = std::abs(all) < 1e-6 ? all : all * std::abs(std::exp(all) - 1.) / std::abs(all);
  return limited / steps / dt * Complex(0, 1) / w;
}

std::array<double, 3> ErrorSources::Shot::dispersion(const Discretisation& cells) const {
  const auto& places = stack.places;
  std::array<double, 3> sum{};
  for (std::size_t n = 0; n < directions; ++n) {
    const double angle = (double(n) + 0.5) / directions * std::numbers::pi / 2;
    for (std::size_t r = 0; r < places.receivers.size(); ++r) {
      const auto& at = places.receivers[r];
      const double way = std::max(std::hypot(at.a_m, at.b_m), cells.spacing_m);
      // Directions from the vertical, of the direct wave and of its mirror image.
      const double own = std::atan2(at.a_m, at.b_m) - radians(stack.dip_deg);
      const double folded = std::asin(std::min(1., std::abs(std::sin(own))));
      const bool direct =
          n == std::min(directions - 1, std::size_t(folded / (std::numbers::pi / 2) * directions));
      const double weight = 0.5 / directions + (direct ? 0.5 : 0);
      std::array<MotionSpectrum, 3> wrong;
      wrong.fill(MotionSpectrum(response.bins()));
      for (std::size_t layer = 0; layer < places.layers.size(); ++layer)
        for (const int wave : {0, 1}) {
          const auto& rock = places.layers[layer];
          if (wave == 1 && !(rock.vs > 0)) continue;
          const auto& change = response.by_speed(layer, wave, r);
          for (std::size_t bin = 0; bin < response.bins(); ++bin) {
            const auto late = -lateness(cells, rock, wave == 0 ? WaveKind::p : WaveKind::s,
                                        response.omega(bin), angle, way);
            for (const std::size_t of : {std::size_t(wave), std::size_t(2)})
              for (std::size_t c = 0; c < 2; ++c) wrong[of][bin][c] += late * change[bin][c];
          }
        }
      for (std::size_t of = 0; of < 3; ++of) sum[of] += weight * response.energy(wrong[of]);
    }
  }
  return sum;
}

ErrorSources::ErrorSources(const Scene<2>& scene) : own_spacing_m_(scene.model.grid().spacing_m) {
  const auto& sources = scene.survey.sources;
  const std::size_t stride = std::max<std::size_t>(1, (sources.size() + shots_followed - 1) / shots_followed);
  for (std::size_t n = stride / 2; n < sources.size(); n += stride)
    if (point_injection(sources[n]) && !scene.survey.receivers_m.empty())
      shots_.push_back(std::make_unique<Shot>(local_stack(scene, n, receivers_followed), sources[n].wavelet));
}
ErrorSources::~ErrorSources() = default;
ErrorSources::ErrorSources(ErrorSources&&) noexcept = default;
ErrorSources& ErrorSources::operator=(ErrorSources&&) noexcept = default;

PromisedError ErrorSources::promised(const Discretisation& cells) const {
  PromisedError promise;
  double energy = 0;
  std::array<double, 3> dispersion{};
  std::vector<double> faces;
  for (const auto& shot : shots_) {
    energy += shot->energy;
    const auto of = shot->dispersion(cells);
    for (std::size_t n = 0; n < 3; ++n) dispersion[n] += of[n];
    for (std::size_t face = 0; face < shot->by_face.size(); ++face) {
      const double squared = shot->face_error(face, cells);
      promise.causes.push_back({shot->stack.interfaces[face].name(), "", squared, true, false});
    }
  }
  double sum = dispersion[2];
  for (auto& cause : promise.causes) {
    sum += cause.error;
    cause.error = saturated(std::sqrt(cause.error / energy));
  }
  promise.causes.push_back({"P waves", "", saturated(std::sqrt(dispersion[0] / energy)), true, true});
  promise.causes.push_back({"S waves", "", saturated(std::sqrt(dispersion[1] / energy)), true, true});
  promise.error = saturated(std::sqrt(sum / energy));
  std::stable_sort(promise.causes.begin(), promise.causes.end(),
                   [](const ErrorCause& a, const ErrorCause& b) { return a.error > b.error; });
  return promise;
}

}  // namespace slipwave
