// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "long_form.hpp"
#include "slip_layer.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::solver_slip_shot_test {
namespace {

/// A whole shot: a plane P wave, slip planes at 45 degrees, a strip between planes of symmetry. Waves are
/// those at the faces of the layer, read 60 m from them.
Waves shot(const Setup& setup, double h, const std::vector<double>& times_s) {
  constexpr double top_m = 600, source_m = 440, away_m = 60;
  Scene<2> scene;
  scene.model.medium = uniform_medium(4, std::int64_t(900 / h), h, rock);
  scene.model.fracture = Field<2, std::uint8_t>(scene.model.grid());
  for (std::int64_t n = 0; n < scene.model.grid().size(); ++n) {
    const double z = scene.model.grid().centre(1, scene.model.grid().index(n)[1]);
    scene.model.fracture[std::size_t(n)] = z > top_m && z < top_m + setup.thickness_m;
  }
  scene.model.fracture_sets = {
      {"bed", {{{std::sqrt(0.5), std::sqrt(0.5)}, 0, viscosity_s(setup.thickness_m, setup.r), strength_pa}}}};
  scene.survey.sources = {{{2 * h, source_m},
                           parse_mechanism<2>("plane:0"),
                           parse_wavelet("ricker:30"),
                           peak_pa / (mu * rock.rho * rock.vp / modulus_p)}};
  scene.survey.receivers_m = {{2 * h, top_m - away_m}, {2 * h, top_m + setup.thickness_m + away_m}};
  scene.edges[0] = {EdgeLaw::mirror, EdgeLaw::mirror};
  scene.edges[1] = {EdgeLaw::absorbing, EdgeLaw::absorbing};
  // The wavelet peaks 1.5 periods after it starts.
  const double way_s = (top_m - source_m + away_m) / rock.vp + 1.5 / peak_hz;
  scene.recording = {{Component::szz, Component::vz}, 0.19, times_s[1] - times_s[0]};
  scene.numerics.correction = setup.correction;
  scene.numerics.double_precision = true;
  check(scene);
  const auto gather = shoot(scene, 1);
  Waves waves;
  for (const double t : times_s) {
    const auto sample = std::size_t(std::lround((t + way_s) / scene.recording.interval_s));
    const auto wave = [&](std::size_t receiver, double direction) {
      return (gather.traces[receiver].samples[sample] -
              direction * rock.rho * rock.vp * gather.traces[2 + receiver].samples[sample]) /
             2;
    };
    waves.through.push_back(wave(1, 1));
    waves.back.push_back(wave(0, -1));
  }
  return waves;
}

// Proves (S8).
TEST(SlipLayer, PassesAndReflectsPWavesAsInOneDimension) {
  // 30 to 120 cells per dominant wavelength, 8 to 32 in the layer.
  std::vector<double> times_s;  // those of samples
  const double way_s = 220 / rock.vp + 1.5 / peak_hz;
  for (int n = 110; n <= 380; ++n) times_s.push_back(5e-4 * n - way_s);
  constexpr auto first = SlipCorrection::first, second = SlipCorrection::second;
  const Bounds all[] = {{first, 0.1, {{0.027, 0.70}, {0.0089, 0.27}, {0.0040, 0.13}}, 0.9},
                        {first, 1, {{0.35, 4.2}, {0.17, 2.3}, {0.085, 1.2}}, 0.9},
                        {first, 10, {{3.5, 10.4}, {1.83, 5.3}, {0.93, 2.7}}, 0.9},
                        {second, 0.1, {{0.028, 0.75}, {0.0087, 0.23}, {0.0039, 0.056}}, 1.8},
                        {second, 1, {{0.19, 1.2}, {0.080, 0.29}, {0.032, 0.073}}, 1.8},
                        {second, 10, {{0.97, 2.3}, {0.32, 0.62}, {0.105, 0.15}}, 1.8}};
  for (const auto& bounds : all) {
    // In the short form one is of the first order.
    if (!long_form() && (bounds.r == 1) != (bounds.correction == first)) continue;
    Errors found[3];
    const auto exact = Layer(pressure, 40 / rock.vp, relaxation_s(40, bounds.r), 400).at(times_s);
    for (const int n : {0, 1, 2}) {
      found[n] = errors(shot({40, bounds.r, bounds.correction}, 5 / std::exp2(n), times_s), exact);
      EXPECT_LT(found[n].through, bounds.at[n].through) << bounds.r << ' ' << n;
      EXPECT_LT(found[n].back, bounds.at[n].back) << bounds.r << ' ' << n;
    }
    EXPECT_GT(observed_order(found[1].back, found[2].back), bounds.order) << bounds.r;
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_slip_shot_test
