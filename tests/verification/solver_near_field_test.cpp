// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "half_space.hpp"
#include "layer_stack.hpp"
#include "solver/simulation.hpp"

// Point sources a few cells from a receiver, a free surface or an interface, against closed forms.
namespace slipwave::solver::solver_near_field_test {
namespace {

constexpr Rock rock{4500, 2250, 2500}, soft{2500, 1200, 2000};
constexpr double peak_hz = 30, interval_s = 0.0005, amplitude = 1e6;

/// A box of cells of `over` above z = 0 and of `under` below it, with the middle of that plane at (0, 0).
Scene<2> scene_round(const Rock& over, const Rock& under, std::int64_t rows_over, std::int64_t rows_under,
                     std::int64_t columns, double h) {
  const Grid<2> grid{
      {columns, rows_over + rows_under}, h, {-double(columns) * h / 2, -double(rows_over) * h}};
  Scene<2> scene;
  scene.model.medium = {Field<2>(grid), Field<2>(grid), Field<2>(grid)};
  for (std::int64_t n = 0; n < grid.size(); ++n)
    put(scene.model.medium, grid.index(n), grid.index(n)[1] < rows_over ? over : under);
  scene.model.fracture = Field<2, std::uint8_t>(grid);
  scene.edges = edges_all(EdgeLaw::absorbing);
  return scene;
}

/// vx and vz at the places, by place, of a source of unit strength; its wavelet is later by `delay_s`.
std::vector<SurfaceMotion> shoot_from(Scene<2> scene, const Point<2>& source,
                                      const std::vector<Point<2>>& places, double duration_s,
                                      const std::string& mechanism = "explosion",
                                      const std::string& wavelet = "ricker:30", double delay_s = 0) {
  scene.survey.sources = {{source, parse_mechanism<2>(mechanism), parse_wavelet(wavelet), amplitude}};
  scene.survey.sources[0].delay_s = delay_s;
  scene.survey.receivers_m = places;
  scene.recording = {{Component::vx, Component::vz}, duration_s, interval_s};
  check(scene);
  const Gather gather = shoot(scene, 1);
  std::vector<SurfaceMotion> found;
  for (std::size_t n = 0; n < places.size(); ++n) {
    found.push_back({gather.traces[n].samples, gather.traces[places.size() + n].samples});
    for (auto& trace : found.back())
      for (double& sample : trace) sample /= amplitude;
  }
  return found;
}

double error_of(const SurfaceMotion& found, const SurfaceMotion& exact) {
  std::vector<double> both = found[0], both_exact = exact[0];
  both.insert(both.end(), found[1].begin(), found[1].end());
  both_exact.insert(both_exact.end(), exact[1].begin(), exact[1].end());
  return relative_error(both, both_exact);
}

/// Largest error at a distance of `cells` cells of 1 m along the axes and between them, for sources anywhere
/// in a cell. S waves are 75 m long: all there is moves with the source.
double error_in_a_full_space(double cells, int order) {
  double largest = 0;
  for (const auto& at : {Point<2>{0.5, 0.5}, {0, 0}, {0.3, -0.1}}) {
    Scene<2> scene = scene_round(rock, rock, 40, 40, 80, 1);
    scene.numerics.order = order;
    std::vector<Point<2>> places;
    for (const double angle : {0., 0.4, 0.8, std::numbers::pi / 2})
      places.push_back({at[0] + cells * std::cos(angle), at[1] + cells * std::sin(angle)});
    const auto found = shoot_from(scene, at, places, 0.11);
    for (std::size_t n = 0; n < places.size(); ++n) {
      const auto exact =
          ricker_response(peak_hz, interval_s, std::int64_t(found[n][0].size()), [&](double omega) {
            return explosion_motion(rock, omega, places[n][0] - at[0], places[n][1] - at[1]);
          });
      largest = std::max(largest, error_of(found[n], {exact[0], exact[1]}));
    }
  }
  return largest;
}

// Proves (A8).
TEST(NearField, OfAnExplosionStandsTenCellsAway) {
  EXPECT_LT(error_in_a_full_space(10, 5), 0.03);
  EXPECT_LT(error_in_a_full_space(10, 7), 0.015);
  EXPECT_LT(error_in_a_full_space(20, 5), 0.005);
}

// Proves (A8).
TEST(NearField, OfAShallowExplosionMovesTheSurfaceAboveIt) {
  // 24 cells per dominant S wavelength, source 3 to 6 cells deep.
  const double h = 3.125, offsets[] = {0, 5, 10, 20, 40};
  for (const auto& [depth, bound] : {std::pair(10., 0.06), {15., 0.045}, {20., 0.03}}) {
    Scene<2> scene = scene_round(rock, rock, 0, 60, 100, h);
    scene.edges[1][0] = EdgeLaw::free;
    std::vector<Point<2>> places;
    for (const double x : offsets) places.push_back({x, 0});
    const auto found = shoot_from(scene, {0, depth}, places, 0.15);
    for (std::size_t n = 0; n < places.size(); ++n)
      EXPECT_LT(error_of(found[n], garvin(rock, offsets[n], depth, {peak_hz}, interval_s,
                                          std::int64_t(found[n][0].size()))),
                n == 1 ? 1.5 * bound : bound)  // the least move
          << depth << " m deep, at " << offsets[n] << " m";
  }
}

// Proves (A8).
TEST(PointSource, BesideAnInterfaceStaysInItsRock) {
  const double h = 2;
  const std::vector<LayerStack::Receiver> at = {{20, -40}, {60, -40}, {20, 40}, {60, 40}};
  for (const auto& [over, under] : {std::pair{rock, soft}, {soft, rock}})
    for (const double cells : {1., 2., 3.4}) {
      std::vector<Point<2>> places;
      for (const auto& place : at) places.push_back({place.a, place.b});
      const auto found = shoot_from(scene_round(over, under, 50, 50, 110, h), {0, -cells * h}, places, 0.14);
      const auto exact = LayerStack{{over, under}, {0}, false, -cells * h}.ricker(peak_hz, interval_s,
                                                                                  found[0][0].size(), at);
      for (std::size_t n = 0; n < places.size(); ++n)
        EXPECT_LT(error_of(found[n], exact[n]), 0.03) << over.vp << ", " << cells << " cells, receiver " << n;
    }
}

// Proves (A8a). Without it a sixth of the peak keeps moving in the rows and columns through the source.
TEST(PointSource, WhoseMomentLastsLeavesTheRockAtRest) {
  std::vector<Point<2>> places;
  for (double x = -30.5; x < 31; ++x) places.insert(places.end(), {{x, -30.5}, {-30.5, x}});
  for (const char* mechanism : {"double-couple:30", "moment:1,0,0"}) {
    const auto found =
        shoot_from(scene_round(rock, rock, 60, 60, 120, 1), {0, 0}, places, 0.4, mechanism, "gauss:30");
    double peak = 0, late = 0;
    for (const auto& motion : found)
      for (const auto& trace : motion)
        for (std::size_t n = 0; n < trace.size(); ++n) {
          peak = std::max(peak, std::abs(trace[n]));
          if (n >= trace.size() / 2) late = std::max(late, std::abs(trace[n]));
        }
    EXPECT_LT(late, 0.004 * peak) << mechanism;
  }
}

// Proves (A8a): a Gaussian bends as a Ricker wavelet, whose moment passes, does: r = -w'' / (2 pi^2 F^2).
TEST(PointSource, WhoseMomentLastsSendsOutTheWavesOfOneWhoseMomentPasses) {
  const std::vector<Point<2>> places = {{55, 20}, {30, 50}, {-45, 35}};
  for (const char* mechanism : {"double-couple:30", "moment:1,0.3,0.2", "explosion"}) {
    const auto shot = [&](const char* wavelet) {
      return shoot_from(scene_round(rock, rock, 90, 90, 180, 1), {0.3, 0.2}, places, 0.15, mechanism, wavelet,
                        0.05 - parse_wavelet(wavelet).delay_s());
    };
    const auto lasts = shot("gauss:30"), passes = shot("ricker:30");
    const double over = 2 * std::pow(std::numbers::pi * peak_hz * interval_s, 2);
    double off = 0, all = 0;
    for (std::size_t p = 0; p < places.size(); ++p)
      for (const int of : {0, 1}) {
        const auto& w = lasts[p][std::size_t(of)];
        for (std::size_t n = 2; n + 2 < w.size(); ++n) {
          const double bend = (-w[n - 2] + 16 * w[n - 1] - 30 * w[n] + 16 * w[n + 1] - w[n + 2]) / 12;
          const double wanted = passes[p][std::size_t(of)][n];
          off += std::pow(-bend / over - wanted, 2), all += wanted * wanted;
        }
      }
    EXPECT_LT(std::sqrt(off / all), 0.005) << mechanism;
  }
}

}  // namespace
}  // namespace slipwave::solver::solver_near_field_test
