// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "accuracy/full_space.hpp"
#include "geology/layers.hpp"
#include "lab.hpp"
#include "long_form.hpp"
#include "plane_interface.hpp"
#include "solver/simulation.hpp"

namespace slipwave::solver::averaging_test {
namespace {

constexpr Rock soft{2500, 1200, 2000}, hard{4500, 2250, 2500}, water{1500, 0, 1000};
constexpr Rock softer{3000, 1600, 2200}, harder{3600, 1900, 2300};
constexpr double interval_s = 0.002;

/// An explosion 170 m above the interface of two half-spaces and receivers 110 m above and below it, all
/// turned by the dip; the interface passes `shift_m` below a corner of cells.
struct TiltedInterface {
  Rock over, under;
  double dip_deg = 0, shift_m = 0;
  double peak_hz = 10, duration_s = 0.7, zone_m = 200;
  std::size_t count() const { return std::size_t(std::llround(duration_s / interval_s)) + 1; }
  /// Cells of 1200 m of which about `cells` are in a wavelength of the slowest wave at the peak.
  double spacing(double cells) const {
    return 1200 / std::round(1200 * cells * peak_hz / std::min(over.vs, under.vs));
  }
};
constexpr double source_m = 170;
const std::vector<Point<2>> receivers = {{-300, -110}, {-100, -110}, {150, -110}, {300, -110},
                                         {-300, 110},  {-100, 110},  {150, 110},  {300, 110}};
constexpr bool is_above(std::size_t receiver) { return receiver < 4; }

/// Motion along and across the interface at each receiver.
using Motions = std::vector<std::array<std::vector<double>, 2>>;

Motions scattered(const TiltedInterface& scene) {
  Motions motions;
  for (const auto& [a, b] : receivers)
    motions.push_back(PlaneInterface{scene.over, scene.under, source_m}.scattered_ricker(
        scene.peak_hz, interval_s, scene.count(), a, b));
  return motions;
}

Motions direct(const TiltedInterface& scene) {
  Motions motions;
  for (const auto& receiver : receivers) {
    motions.push_back({std::vector<double>(scene.count()), std::vector<double>(scene.count())});
    if (receiver[1] > 0) continue;
    const auto traces =
        ricker_response(scene.peak_hz, interval_s, std::int64_t(scene.count()), [&](double omega) {
          return explosion_motion(scene.over, omega, receiver[0], receiver[1] + source_m);
        });
    motions.back() = {traces[0], traces[1]};
  }
  return motions;
}

Motions computed(const TiltedInterface& interface, double h, Average average) {
  const double size_m = 1200, dip = interface.dip_deg * std::numbers::pi / 180;
  const double x0 = size_m / 2 - 20, z0 = size_m / 2 + interface.shift_m;
  const auto &over = interface.over, &under = interface.under;
  const double top = z0 - x0 * std::tan(dip);
  Scene<2> scene;
  scene.model.medium = layered_medium(
      grid_of_size<2>({size_m, size_m}, h),
      {{-1e6, over.vp, over.vs, over.rho, 0}, {top, under.vp, under.vs, under.rho, interface.dip_deg}},
      average);
  const auto place = [&](const Point<2>& at) {
    return Point<2>{x0 + at[0] * std::cos(dip) - at[1] * std::sin(dip),
                    z0 + at[0] * std::sin(dip) + at[1] * std::cos(dip)};
  };
  scene.survey.sources = {{place({0, -source_m}), parse_mechanism<2>("explosion"),
                           parse_wavelet("ricker:" + std::to_string(interface.peak_hz)), 1e6}};
  for (const auto& receiver : receivers) scene.survey.receivers_m.push_back(place(receiver));
  scene.edges = edges_all(EdgeLaw::absorbing);
  scene.numerics.zone_cells = int(interface.zone_m / h);
  scene.recording = {{Component::vx, Component::vz}, interface.duration_s, interval_s};
  check(scene);
  const Gather gather = shoot(scene, 1);
  Motions motions;
  for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver) {
    motions.push_back({std::vector<double>(interface.count()), std::vector<double>(interface.count())});
    for (std::size_t n = 0; n < interface.count(); ++n) {
      const double vx = gather.traces[receiver].samples[n] / 1e6;
      const double vz = gather.traces[receivers.size() + receiver].samples[n] / 1e6;
      motions.back()[0][n] = vx * std::cos(dip) + vz * std::sin(dip);
      motions.back()[1][n] = -vx * std::sin(dip) + vz * std::cos(dip);
    }
  }
  return motions;
}

/// Percent of the reflected waves in relative L2 above, of the transmitted ones below, and of all traces.
struct Errors {
  double reflected, transmitted, all;
};
std::vector<Errors> errors_of(const TiltedInterface& scene, Average average,
                              const std::vector<double>& spacings) {
  const auto exact = scattered(scene), arriving = direct(scene);
  std::vector<Errors> errors;
  for (const double h : spacings) {
    const auto found = computed(scene, h, average);
    double difference[2] = {}, size[2] = {}, of_all = 0;
    for (std::size_t receiver = 0; receiver < receivers.size(); ++receiver)
      for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t n = 0; n < scene.count(); ++n) {
          const double value = exact[receiver][row][n];
          difference[is_above(receiver)] +=
              std::pow(found[receiver][row][n] - arriving[receiver][row][n] - value, 2);
          size[is_above(receiver)] += value * value;
          of_all += std::pow(value + arriving[receiver][row][n], 2);
        }
    errors.push_back({100 * std::sqrt(difference[1] / size[1]), 100 * std::sqrt(difference[0] / size[0]),
                      100 * std::sqrt((difference[0] + difference[1]) / of_all)});
  }
  return errors;
}

// Proves (M2).
TEST(TiltedInterface, OnFacesOfCellsHasTheErrorsOfTheWayAlone) {
  // The reference itself: the error of a second-order interface at 4.7 and 9.5 cells to the shortest S wave.
  const auto errors = errors_of({soft, hard}, Average::isotropic, {10, 5});
  EXPECT_LT(errors[0].reflected, 5);
  EXPECT_LT(errors[1].reflected, 0.7);
  EXPECT_LT(errors[1].transmitted, 0.12);
  EXPECT_LT(errors_of({water, hard}, Average::isotropic, {5})[0].reflected, 0.4);
}

// Proves (M2).
TEST(AveragedInterface, IsAsGoodWhereverItLiesInItsCells) {
  // A third of a cell off, a top drawn cell by cell lies where the nearest face is: 3.3 m off at 10 m.
  for (const bool strong : {true, false}) {
    if (!long_form() && !strong) continue;
    const TiltedInterface interface { strong ? soft : softer, strong ? hard : harder, 0, 3.3 };
    const auto mean = errors_of(interface, Average::isotropic, {10, 5}),
               steps = errors_of(interface, Average::none, {10, 5});
    EXPECT_GT(steps[0].reflected, (strong ? 1.5 : 3) * mean[0].reflected);
    EXPECT_GT(steps[1].reflected, (strong ? 3.5 : 4.5) * mean[1].reflected);
    EXPECT_GT(steps[1].transmitted, (strong ? 1.5 : 5) * mean[1].transmitted);
    EXPECT_GT(observed_order(mean[0].reflected, mean[1].reflected), strong ? 1.8 : 1.4);
    EXPECT_LT(observed_order(steps[0].reflected, steps[1].reflected), 1.1);
  }
}

// Proves (M2).
TEST(AveragedInterface, HasTheSameErrorAtAnyDipAndPlace) {
  // Cell by cell the errors range over 2.7 to 13 % at 5 m, and are largest at 45 degrees, where whole rows of
  // corners lie on one side.
  for (const double dip : {5., 25.}) {
    if (!long_form() && dip == 5) continue;
    const auto mean = errors_of({soft, hard, dip, 1.3}, Average::isotropic, {10, 5});
    EXPECT_LT(mean[0].reflected, 11) << dip;
    EXPECT_LT(mean[1].reflected, 4.4) << dip;
    EXPECT_LT(mean[0].transmitted, 3.4) << dip;
    EXPECT_LT(mean[1].transmitted, 2.1) << dip;
    EXPECT_GT(observed_order(mean[0].reflected, mean[1].reflected), 1.2) << dip;
  }
  const auto steps = errors_of({soft, hard, 45, 0}, Average::none, {10, 5});
  const auto mean = errors_of({soft, hard, 45, 0}, Average::isotropic, {10, 5});
  EXPECT_LT(mean[1].reflected, 4.4);
  EXPECT_LT(mean[1].transmitted, 2.1);
  EXPECT_GT(steps[0].reflected, 2.5 * mean[0].reflected);
  EXPECT_GT(steps[1].reflected, 3 * mean[1].reflected);
}

TEST(TiltedMeans, HalveTheErrorsOfInterfacesAndRaiseTheirOrder) {
  // 1.35 and 1.53 % with isotropic means at 24 cells, of order 1.5.
  const Rock slow{2000, 1150, 2000}, fast{4000, 2300, 2300};
  for (const auto& [dip, most] : {std::pair{15., 0.6}, std::pair{30., 0.9}}) {
    // In the short form soft rock, below, has the other dip.
    if (!long_form() && dip == 15) continue;
    const TiltedInterface interface { slow, fast, dip, 1.3, 15, 0.6, 100 };
    const auto tilted = errors_of(interface, Average::tilted, {interface.spacing(12), interface.spacing(24)});
    EXPECT_LT(tilted[1].all, most) << dip;
    EXPECT_GT(observed_order(tilted[0].all, tilted[1].all), 1.6) << dip;
  }
}

TEST(TiltedMeans, HoldBesideSoftRock) {
  const TiltedInterface interface { {1600, 400, 1800}, {2500, 1200, 2100}, 15, 1.3, 6, 1.4, 150 };
  EXPECT_LT(errors_of(interface, Average::tilted, {interface.spacing(24)})[0].all, 1.0);
}

// Proves (M2).
TEST(AveragedInterface, OfWaterAndRockStaysAStaircaseOfFirstOrder) {
  const auto errors = errors_of({water, hard, 25, 0}, Average::isotropic, {10, 5});
  EXPECT_LT(errors[0].reflected, 44);
  EXPECT_LT(errors[1].reflected, 20.5);
  EXPECT_LT(errors[1].transmitted, 14.5);
  EXPECT_GT(observed_order(errors[0].reflected, errors[1].reflected), 0.9);
}

}  // namespace
}  // namespace slipwave::solver::averaging_test
