// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cube.hpp"
#include "viscoelastic.hpp"

// Attenuation in three dimensions against the closed form with complex speeds.
namespace slipwave::solver::attenuation_cube_test {
namespace {

constexpr double peak_hz = 20;
constexpr Rock rock{3000, 1600, 2200};

TEST(AttenuationOfACube, IsThatOfComplexModuli) {
  constexpr double h = 5, distance = 100;
  constexpr std::int64_t n = 26;
  Scene<3> scene;
  auto& medium = scene.model.medium;
  // Planes of symmetry along the force stand for three quarters of the space.
  medium = uniform_cube({n, n, 2 * n}, h, rock, {0, 0, -n * h});
  medium[Property::qp] = Field<3>(medium.grid(), 30.F);
  medium[Property::qs] = Field<3>(medium.grid(), 20.F);
  scene.survey.sources = {{{0, 0, 0}, parse_mechanism<3>("force:0,0,1"), parse_wavelet("ricker:20"), 1e6}};
  const std::vector<std::array<double, 3>> offsets = {
      {distance, 0, 0}, {0, 0, distance}, {0.6 * distance, 0.48 * distance, 0.64 * distance}};
  scene.survey.receivers_m = offsets;
  scene.edges = edges_all_3d(EdgeLaw::absorbing);
  scene.edges[0][0] = scene.edges[1][0] = EdgeLaw::mirror;
  scene.numerics.order = 7;
  scene.numerics.zone_cells = 12;
  scene.recording = {{Component::vz}, 0.19, 0.001};
  set_attenuation(scene);
  check(scene);
  auto gather = shoot(scene, 1);
  for (auto& trace : gather.traces)
    for (auto& sample : trace.samples) sample /= 4;
  const Mechanisms mechanisms(3, peak_hz / 5, 2.5 * peak_hz);
  const auto p = standard_linear(mechanisms, 30, peak_hz), s = standard_linear(mechanisms, 20, peak_hz);
  for (std::size_t r = 0; r < offsets.size(); ++r) {
    const auto exact = ricker_response(peak_hz, 0.001, gather.axis.count, [&](double omega) -> Motion {
      if (omega == 0) return {};
      return {1e6 * lossy_force<3>(LossyRock(rock, omega, p, s), omega, offsets[r], 2)[2]};
    });
    EXPECT_LT(relative_error(gather.traces[r].samples, exact[0]), 0.03) << r;
    // An elastic cube would not do.
    const auto elastic = ricker_response(peak_hz, 0.001, gather.axis.count, [&](double omega) -> Motion {
      if (omega == 0) return {};
      const auto none = constant_q(PropertyRow::infinite, peak_hz);
      return {1e6 * lossy_force<3>(LossyRock(rock, omega, none, none), omega, offsets[r], 2)[2]};
    });
    EXPECT_GT(relative_error(gather.traces[r].samples, elastic[0]), 0.1) << r;
  }
}

}  // namespace
}  // namespace slipwave::solver::attenuation_cube_test
