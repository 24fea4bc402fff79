// SPDX-License-Identifier: BSD-3-Clause
// Waves in attenuating rock and fluid against closed forms with complex moduli.
#include <gtest/gtest.h>

#include "layer_stack.hpp"
#include "long_form.hpp"
#include "solver/simulation.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver::attenuation_test {
namespace {

constexpr double peak_hz = 20, infinite = PropertyRow::infinite;
constexpr Rock rock{3000, 1600, 2200}, water{1500, 0, 1000};

struct Qualities {
  double p, s;
};

void attenuate(Scene<2>& scene, const Qualities& q, const AttenuationChoice& choice = {}) {
  auto& medium = scene.model.medium;
  medium[Property::qp] = Field<2>(medium.grid(), float(q.p));
  medium[Property::qs] = Field<2>(medium.grid(), float(q.s));
  set_attenuation(scene, choice);
}

/// Samples at t = n interval of one component of a velocity with this spectrum.
std::vector<double> exact_trace(const Gather& gather, const std::function<Complex(double omega)>& motion) {
  return ricker_response(peak_hz, gather.axis.interval_s, gather.axis.count,
                         [&](double omega) { return Motion{motion(omega)}; })[0];
}

/// A strip between mirrors, so narrow that only plane P waves travel along it: a wave from the source at its
/// middle to receivers 2 and 20 wavelengths away, along z or x, by an explosion.
struct Strip {
  Rock of = rock;
  bool along_x = false;
  Qualities q{50, 50};
  int time_order = 2;
  double cells = 40;  // per wavelength at the peak
  double cfl = 0.9;
  std::int64_t width = 4;

  double speed() const { return of.vp; }
  double wavelength() const { return speed() / peak_hz; }

  Scene<2> scene(const AttenuationChoice& choice) const {
    const double h = wavelength() / cells;
    const auto length = std::int64_t(26 * cells);
    Scene<2> scene;
    scene.model.medium =
        along_x ? uniform_medium(length, width, h, of) : uniform_medium(width, length, h, of);
    const auto place = [&](double along, double across) {
      return along_x ? Point<2>{along, across} : Point<2>{across, along};
    };
    const double middle = double(width) * h / 2, from = (2 * cells + 0.5) * h;
    scene.survey.sources = {
        {place(from, middle), parse_mechanism<2>("explosion"), parse_wavelet("ricker:20"), 1e6}};
    for (const double waves : {2., 20.})
      scene.survey.receivers_m.push_back(place(from + waves * wavelength(), middle));
    scene.edges[along_x ? 0 : 1] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
    scene.edges[along_x ? 1 : 0] = {EdgeLaw::mirror, EdgeLaw::mirror};
    scene.numerics.order = 7;
    scene.numerics.time_order = time_order;
    scene.numerics.cfl = cfl;
    scene.recording = {{along_x ? Component::vx : Component::vz}, 22 * wavelength() / of.vp + 0.15, 0.001};
    attenuate(scene, q, choice);
    check(scene);
    return scene;
  }

  /// Relative errors at the receivers.
  std::array<double, 2> errors(const AttenuationChoice& choice, const ModulusOf& modulus) const {
    const auto shot = scene(choice);
    const auto gather = shoot(shot, 1);
    std::array<double, 2> errors{};
    for (std::size_t n = 0; n < 2; ++n) {
      const double r = (n == 0 ? 2 : 20) * wavelength(), wide = double(width) * shot.model.grid().spacing_m;
      const auto exact = exact_trace(gather, [&](double omega) -> Complex {
        if (omega == 0) return 0;
        const auto m = of.rho * speed() * speed() * modulus(omega / (2 * std::numbers::pi));
        const Outgoing wave(1, omega / std::sqrt(m / of.rho), r);
        return -1e6 / wide * wave.slope / m;
      });
      errors[n] = relative_error(gather.traces[n].samples, exact);
    }
    return errors;
  }
  /// Against the moduli that mechanisms make, and against constant Q at all frequencies.
  std::array<double, 2> errors_of_solver(const AttenuationChoice& choice = {}) const {
    const Mechanisms mechanisms(choice.mechanisms, peak_hz / 5, 2.5 * peak_hz);
    return errors(choice, standard_linear(mechanisms, q.p, choice.reference_hz.value_or(peak_hz)));
  }
  std::array<double, 2> errors_of_all(const AttenuationChoice& choice = {}) const {
    return errors(choice, constant_q(q.p, choice.reference_hz.value_or(peak_hz)));
  }
};

// Proves (Q8).
TEST(Attenuation, OfPlaneWavesIsThatOfComplexModuliOverTwentyWavelengths) {
  for (const double q : {20., 50., 200.}) {
    Strip strip;
    strip.q = {q, q};
    strip.along_x = q == 50;
    for (const double error : strip.errors_of_solver()) EXPECT_LT(error, 0.003) << q;
  }
  Strip sea;
  sea.of = water, sea.q = {30, infinite};
  for (const double error : sea.errors_of_solver()) EXPECT_LT(error, 0.003);
}

// Proves (Q8).
TEST(Attenuation, IsThatOfConstantQAtAllFrequencies) {
  AttenuationChoice choice;
  Strip strip;
  strip.q = {50, 50};
  for (const double error : strip.errors_of_all(choice)) EXPECT_LT(error, 0.01);
  // Speeds hold at another frequency, too.
  choice.reference_hz = 12, choice.mechanisms = 5;
  for (const double error : strip.errors_of_all(choice)) EXPECT_LT(error, 0.01);
}

// Proves (Q8).
TEST(Attenuation, ConvergesWithSecondOrderInTime) {
  // Half the step on the same grid; without loss, sweeps along the strip are nearly exact.
  Strip coarse;
  coarse.q = {20, 20}, coarse.cells = 14;
  auto fine = coarse;
  fine.cfl /= 2;
  EXPECT_GT(observed_order(coarse.errors_of_solver()[1], fine.errors_of_solver()[1]), 1.8);
  Strip long_steps;
  long_steps.q = {20, 20}, long_steps.cells = 28, long_steps.time_order = 4, long_steps.cfl = 1.6;
  for (const double error : long_steps.errors_of_solver()) EXPECT_LT(error, 0.01);
}

/// A force along z, 5 S wavelengths from receivers in several directions, or 10 in the long form.
// Proves (Q8).
TEST(Attenuation, OfSWavesIsThatOfComplexModuli) {
  const double waves = long_form() ? 10 : 5, wavelength = rock.vs / peak_hz, h = wavelength / 25,
               distance = waves * wavelength;
  for (const double q : {20., 80.}) {
    if (waves == 5 && q == 80) continue;
    Scene<2> scene;
    const auto n = std::int64_t((2 * distance + 3 * wavelength) / h);
    scene.model.medium = uniform_medium(n, n, h, rock);
    const double middle = double(n / 2) * h + h / 2;
    scene.survey.sources = {
        {{middle, middle}, parse_mechanism<2>("force:0,1"), parse_wavelet("ricker:20"), 1e6}};
    std::vector<std::array<double, 2>> offsets;
    for (const double degrees : {0., 25., 55., 90.}) {
      const double angle = degrees * std::numbers::pi / 180;
      offsets.push_back({distance * std::cos(angle), distance * std::sin(angle)});
      scene.survey.receivers_m.push_back({middle + offsets.back()[0], middle + offsets.back()[1]});
    }
    scene.edges = edges_all(EdgeLaw::absorbing);
    scene.numerics.order = 7;
    // Over so many wavelengths splittings of second order have errors of some percent as derived (E16),
    // without attenuation, too.
    if (long_form()) scene.numerics.time_order = 4;
    scene.recording = {{Component::vz}, distance / rock.vs + 0.2, 0.001};
    attenuate(scene, {1.5 * q, q});
    const auto gather = shoot(scene, 1);
    const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
    const auto p = standard_linear(mechanisms, 1.5 * q, peak_hz), s = standard_linear(mechanisms, q, peak_hz);
    std::vector<double> found, exact;
    for (std::size_t r = 0; r < offsets.size(); ++r) {
      const auto trace = exact_trace(gather, [&](double omega) -> Complex {
        if (omega == 0) return 0;
        return 1e6 * lossy_force<2>(LossyRock(rock, omega, p, s), omega, offsets[r], 1)[1];
      });
      const auto& samples = gather.traces[r].samples;
      found.insert(found.end(), samples.begin(), samples.end());
      exact.insert(exact.end(), trace.begin(), trace.end());
      if (offsets[r][0] > distance / 2) {
        EXPECT_LT(relative_error(samples, trace), 0.01) << q << ' ' << r;
      }
    }
    EXPECT_LT(relative_error(found, exact), 0.01);
  }
}

/// Reflection and transmission at an interface of two attenuating rocks, the waves' reference being their
/// complex impedances.
// Proves (Q8).
TEST(Attenuation, GivesTheReflectionOfComplexImpedances) {
  const Rock below{3600, 1900, 2400};
  Strip strip;
  auto scene = strip.scene({});
  const double h = scene.model.grid().spacing_m, face = 8 * strip.cells * h;
  auto medium = uniform_medium(strip.width, scene.model.grid().shape[1], h, rock);
  medium[Property::qp] = Field<2>(medium.grid(), 25.F);
  for (std::int64_t k = std::int64_t(8 * strip.cells); k < medium.grid().shape[1]; ++k)
    for (std::int64_t i = 0; i < strip.width; ++i) {
      put(medium, {i, k}, below);
      medium[Property::qp]({i, k}) = 80;
    }
  scene.model.medium = std::move(medium);
  set_attenuation(scene);
  const double from = scene.survey.sources[0].position_m[1];
  const double middle = double(strip.width) * h / 2;
  scene.survey.receivers_m = {{middle, face - 2 * strip.wavelength()},
                              {middle, face + 3 * strip.wavelength()}};
  scene.recording.duration_s = 0.8;
  const auto gather = shoot(scene, 1);
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto upper = standard_linear(mechanisms, 25, peak_hz),
             lower = standard_linear(mechanisms, 80, peak_hz);
  for (const bool through : {false, true}) {
    const auto exact = exact_trace(gather, [&](double omega) -> Complex {
      if (omega == 0) return 0;
      const Complex i(0, 1);
      const double hz = omega / (2 * std::numbers::pi);
      const auto m1 = rock.rho * rock.vp * rock.vp * upper(hz),
                 m2 = below.rho * below.vp * below.vp * lower(hz);
      const auto k1 = omega / std::sqrt(m1 / rock.rho), k2 = omega / std::sqrt(m2 / below.rho);
      const auto z1 = std::sqrt(m1 * rock.rho), z2 = std::sqrt(m2 * below.rho);
      const auto incident = [&](double way) {
        return 0.5 * std::exp(-i * k1 * way) / m1 * 1e6 / (2 * middle);
      };
      if (through)
        return 2. * z1 / (z1 + z2) * incident(face - from) * std::exp(-i * k2 * 3. * strip.wavelength());
      const double there = 2 * strip.wavelength();
      return incident(face - from - there) + (z1 - z2) / (z1 + z2) * incident(face - from + there);
    });
    EXPECT_LT(relative_error(gather.traces[through].samples, exact), 0.01) << through;
  }
}

/// Water over attenuating mud over rock, the f-k sum with complex speeds.
TEST(Attenuation, InALayeredSeaFloorIsThatOfComplexSpeeds) {
  const Rock mud{1900, 700, 1800};
  const double h = 1.75;
  const std::int64_t nx = 460, nz = 300, floor = 100, base = 200;
  Scene<2> scene;
  auto& medium = scene.model.medium;
  medium = uniform_medium(nx, nz, h, water);
  medium[Property::qp] = Field<2>(medium.grid(), float(infinite));
  medium[Property::qs] = Field<2>(medium.grid(), float(infinite));
  for (std::int64_t k = floor; k < nz; ++k)
    for (std::int64_t i = 0; i < nx; ++i) {
      put(medium, {i, k}, k < base ? mud : rock);
      medium[Property::qp]({i, k}) = k < base ? 40 : 100;
      medium[Property::qs]({i, k}) = k < base ? 20 : 60;
    }
  const double x = 150.5 * h, z = 50.5 * h;
  scene.survey.sources = {{{x, z}, parse_mechanism<2>("explosion"), parse_wavelet("ricker:20"), 1e6}};
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.order = 7;
  scene.recording = {{Component::vx, Component::vz}, 0.5, 0.001};
  LayerStack stack;
  stack.layers = {water, mud, rock};
  stack.faces_m = {double(floor) * h, double(base) * h};
  stack.source_m = z;
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto of = [&](double q) { return standard_linear(mechanisms, q, peak_hz); };
  const auto none = constant_q(infinite, peak_hz);
  stack.losses = {{none, none}, {of(40), of(20)}, {of(100), of(60)}};
  std::vector<LayerStack::Receiver> receivers;
  for (const auto& [a, b] : {std::pair{100, 70}, {180, 150}, {90, 230}}) {
    receivers.push_back({a * h, (b + 0.5) * h});
    scene.survey.receivers_m.push_back({x + a * h, (b + 0.5) * h});
  }
  set_attenuation(scene);
  const auto gather = shoot(scene, 1);
  const auto exact = stack.ricker(peak_hz, 0.001, std::size_t(gather.axis.count), receivers);
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      auto found = gather.traces[row * receivers.size() + r].samples;
      for (auto& value : found) value /= 1e6;
      EXPECT_LT(relative_error(found, exact[r][row]), 0.01) << row << ' ' << r;
    }
}

}  // namespace
}  // namespace slipwave::solver::attenuation_test
