// Waves in attenuating rock and fluid against closed forms with complex moduli.
#include <gtest/gtest.h>

#include <cstdlib>

#include "lab.hpp"
#include "solver/simulation.hpp"
#include "viscoelastic.hpp"

namespace slipwave::solver {
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

/// A strip between mirrors, so narrow that only plane waves travel along it: a wave from the source at its
/// middle to receivers 2 and 20 wavelengths away, along z or x. `shear`: by a force across, else by an
/// explosion.
struct Strip {
  Rock of = rock;
  bool shear = false, along_x = false;
  Qualities q{50, 50};
  int time_order = 2, order = 7;
  double cells = 40;  // per wavelength at the peak
  bool plain = false, double_precision = false;
  double cfl = 0.9;
  std::int64_t width = 8;

  double speed() const { return shear ? of.vs : of.vp; }
  double wavelength() const { return speed() / peak_hz; }

  Scene<2> scene(const AttenuationChoice& choice) const {
    const double h = wavelength() / cells;
    const auto length = std::int64_t(26 * cells);
    Scene<2> scene;
    scene.model.medium = along_x ? uniform_medium(length, width, h, of) : uniform_medium(width, length, h, of);
    const auto place = [&](double along, double across) {
      return along_x ? Point<2>{along, across} : Point<2>{across, along};
    };
    const double middle = double(width) * h / 2, from = (2 * cells + 0.5) * h;
    const char* kind = !shear ? "explosion" : along_x ? "force:0,1" : "force:1,0";
    scene.survey.sources = {{place(from, middle), parse_mechanism<2>(kind), parse_wavelet("ricker:20"), 1e6}};
    for (const double waves : {2., 20.})
      scene.survey.receivers_m.push_back(place(from + waves * wavelength(), middle));
    scene.edges[along_x ? 0 : 1] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
    scene.edges[along_x ? 1 : 0] = {EdgeLaw::mirror, EdgeLaw::mirror};
    scene.numerics.order = order;
    scene.numerics.time_order = time_order;
    scene.numerics.cfl = cfl;
    scene.numerics.double_precision = double_precision;
    scene.numerics.tiling.plain = plain;
    scene.recording = {{shear != along_x ? Component::vx : Component::vz}, 1.25, 0.001};
    if (along_x) scene.recording.components = {shear ? Component::vz : Component::vx};
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
      const double r = (n == 0 ? 2 : 20) * wavelength(),
                   wide = double(width) * shot.model.grid().spacing_m;
      const auto exact = exact_trace(gather, [&](double omega) -> Complex {
        if (omega == 0) return 0;
        const auto m = of.rho * speed() * speed() * modulus(omega / (2 * std::numbers::pi));
        const Outgoing wave(1, omega / std::sqrt(m / of.rho), r);
        return 1e6 / wide * (shear ? Complex(0, omega) * wave.g / m : -wave.slope / m);
      });
      errors[n] = relative_error(gather.traces[n].samples, exact);
    }
    return errors;
  }
  /// Against the moduli that mechanisms make, and against constant Q at all frequencies.
  std::array<double, 2> errors_of_solver(const AttenuationChoice& choice = {}) const {
    const Mechanisms mechanisms(choice.mechanisms, peak_hz / 5, 2.5 * peak_hz);
    return errors(choice,
                  standard_linear(mechanisms, shear ? q.s : q.p, choice.reference_hz.value_or(peak_hz)));
  }
  std::array<double, 2> errors_of_all(const AttenuationChoice& choice = {}) const {
    return errors(choice, constant_q(shear ? q.s : q.p, choice.reference_hz.value_or(peak_hz)));
  }
};

TEST(Attenuation, OfPlaneWavesIsThatOfComplexModuliOverTwentyWavelengths) {
  for (const double q : {20., 50., 200., infinite})
    for (const bool along_x : {false, true})
      for (const bool shear : {false, true}) {
        Strip strip;
        strip.along_x = along_x, strip.shear = shear, strip.q = {q, q};
        const auto [near, far] = strip.errors_of_solver();
        const auto [near_all, far_all] = strip.errors_of_all();
        printf("Q %g x %d s %d: %.4f %.4f   %.4f %.4f\n", q, along_x, shear, near, far, near_all, far_all);
      }
}

}  // namespace
}  // namespace slipwave::solver
