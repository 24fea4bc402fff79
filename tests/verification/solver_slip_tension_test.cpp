// A plane P wave straight through a layer of planes at 45 degrees whose strength is friction under the wave's
// own pressure: none while the wave pulls. The rules of a step then differ by when the waves feel what slip
// takes off.
#include <gtest/gtest.h>

#include <complex>

#include "slip_layer.hpp"
#include "solver/effect/slip.hpp"
#include "whole_effect.hpp"

namespace slipwave::solver {
namespace {

constexpr double depth_m = 1500, wave_at_m = 300, layer_at_m = 600, thickness_m = 50, end_s = 0.2;
constexpr double friction = 0.1, viscosity = 450;  // s: relaxes within 2.6 ms under the peak of 1 MPa
const double z_p = rock.rho * rock.vp, lambda_share = 1 - 2 * mu / modulus_p;

/// Stress of the waves that leave the layer at its faces, and when.
struct Outgoing {
  std::vector<double> times_s, through, back;
};

/// The spectrum from 5 to 60 Hz.
std::vector<std::complex<double>> spectrum(const std::vector<double>& times_s,
                                           const std::vector<double>& values) {
  std::vector<std::complex<double>> all;
  const double dt_s = times_s[1] - times_s[0];
  for (double hz = 5; hz <= 60; hz += 1) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < values.size(); ++n)
      sum += values[n] * std::polar(dt_s, -2 * std::numbers::pi * hz * times_s[n]);
    all.push_back(sum);
  }
  return all;
}

/// Relative L2 error of a spectrum, in percent.
double error_of(const std::vector<std::complex<double>>& found,
                const std::vector<std::complex<double>>& exact) {
  double wrong = 0, all = 0;
  for (std::size_t n = 0; n < exact.size(); ++n)
    wrong += std::norm(found[n] - exact[n]), all += std::norm(exact[n]);
  return 100 * std::sqrt(wrong / all);
}

/// Waves carried from node to node exactly in one step of time, between two of which the traction on the
/// planes relaxes without them (S3). Where the planes have no strength that is of first order in the step: it
/// wants many nodes, and knows nothing of the rules of a step.
Outgoing reference(int nodes) {
  const double dt_s = thickness_m / rock.vp / nodes, start_s = (layer_at_m - wave_at_m) / rock.vp;
  struct Node {
    double down = 0, up = 0, sxx = 0;
  };
  std::vector<Node> all(std::size_t(nodes), Node{});
  const auto relax = [&](Node& node) {
    const double szz = node.down + node.up, tau = (node.sxx - szz) / 2;
    const double strength = friction * std::max(-(node.sxx + szz) / 2, 0.);
    const double excess = std::max(std::abs(tau) - strength, 0.);
    const double left = strength > 0 ? std::exp(-mu * dt_s / 2 / (viscosity * strength)) : 0;
    const double change = -std::copysign(excess * (1 - left), tau);
    node.sxx += change;
    node.down -= change / 2;
    node.up -= change / 2;
  };
  Outgoing waves;
  for (double t = -0.06; t < end_s - start_s; t += dt_s) {
    for (auto& node : all) relax(node);
    waves.times_s.push_back(t + dt_s / 2 + start_s);
    waves.through.push_back(all.back().down);
    waves.back.push_back(all.front().up);
    double down = incident(t + dt_s / 2);
    for (std::size_t n = 0; n < all.size(); ++n) {
      const double was = all[n].down + all[n].up;
      std::swap(down, all[n].down);
      all[n].up = n + 1 < all.size() ? all[n + 1].up : 0;
      all[n].sxx += lambda_share * (all[n].down + all[n].up - was);
    }
    for (auto& node : all) relax(node);
  }
  return waves;
}

/// The same by the solver; times are when the waves were at the faces.
Outgoing solved(SlipCorrection correction, double h, double courant) {
  Scene<2> scene;
  const auto cells = std::int64_t(depth_m / h);
  scene.model.medium = uniform_medium(2, cells, h, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  const auto first = std::int64_t(layer_at_m / h), last = first + std::int64_t(thickness_m / h) - 1;
  for (std::int64_t k = first; k <= last; ++k)
    for (const std::int64_t i : {0, 1}) scene.model.fracture({i, k}) = 1;
  const double half = std::sqrt(0.5);
  scene.model.fracture_sets = {{"bed", {{{half, half}, friction, viscosity, 0}}}};
  scene.numerics.correction = correction;
  const double dt_s = courant * h / rock.vp;
  using L = Lab<double>;
  L lab(scene.model.medium, edges_all(EdgeLaw::rigid), 7, dt_s);
  const auto slip = std::make_unique<Slip<2, double>>(lab.state(), lab.domain(), scene, dt_s);
  for (std::int64_t k = 0; k < cells; ++k)
    for (const std::int64_t i : {0, 1}) {
      const double szz = incident((wave_at_m - lab.grid().centre(1, k)) / rock.vp);
      lab(L::szz, i, k) = szz;
      lab(L::sxx, i, k) = lambda_share * szz;
      lab(L::vz, i, k) = -szz / z_p;
    }
  const auto away = std::int64_t(20 / h);
  const double way_s = (double(away) - 0.5) * h / rock.vp;
  Outgoing waves;
  for (std::int64_t n = 0; double(n + 1) * dt_s < end_s; ++n) {
    lab.sweep(1, 1);
    run_everywhere(*slip, {n, dt_s}, lab.state());
    const auto wave = [&](std::int64_t k, double direction) {
      return (lab(L::szz, 1, k) - direction * z_p * lab(L::vz, 1, k)) / 2;
    };
    waves.times_s.push_back(double(n + 1) * dt_s - way_s);
    waves.through.push_back(wave(last + away, 1));
    waves.back.push_back(wave(first - away, -1));
    run_after_everywhere(*slip, {n, dt_s}, lab.state());
  }
  return waves;
}

/// Errors of the reflected wave and of what slip changes in the transmitted one.
Errors errors_below_60_hz(const Outgoing& found, const Outgoing& exact) {
  return {error_of(spectrum(found.times_s, found.through), spectrum(exact.times_s, exact.through)),
          error_of(spectrum(found.times_s, found.back), spectrum(exact.times_s, exact.back))};
}

TEST(SlipInTension, IsFeltByTheWavesWithSecondOrderByTheCentredCorrectionAlone) {
  const auto exact = reference(1200);
  ASSERT_LT(errors_below_60_hz(reference(300), exact).back, 0.5);
  double centred[3], second[3];
  for (const int n : {0, 1, 2}) {
    const double h = 5 / std::exp2(n);
    const auto of = errors_below_60_hz(solved(SlipCorrection::centred, h, 0.9), exact);
    second[n] = errors_below_60_hz(solved(SlipCorrection::second, h, 0.9), exact).back;
    centred[n] = of.back;
    EXPECT_LT(of.through, centred[n]);
  }
  EXPECT_LT(centred[0], 3.5);
  EXPECT_LT(centred[2], 0.3);
  EXPECT_GT(observed_order(centred[0], centred[1]), 1.8);
  EXPECT_GT(observed_order(centred[1], centred[2]), 1.7);
  EXPECT_LT(observed_order(second[1], second[2]), 1.2);
  for (const int n : {0, 1, 2}) EXPECT_LT(centred[n], second[n] / 2) << n;
}

}  // namespace
}  // namespace slipwave::solver
