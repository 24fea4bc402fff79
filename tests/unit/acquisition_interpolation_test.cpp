// SPDX-License-Identifier: BSD-3-Clause
#include "acquisition/interpolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace slipwave::acquisition_interpolation_test {
namespace {

constexpr double pi = std::numbers::pi;
const AxisCells everywhere{-1000, 1000};

/// |interpolated - exact| of exp(i k x), any phase, largest over positions from .. to.
double wave_error(double cells_per_wavelength, double from, double to, const AxisCells& usable,
                  int most_cells = 8) {
  const double k = 2 * pi / cells_per_wavelength;
  double largest = 0;
  for (int n = 0; n <= 100; ++n) {
    const double position = from + (to - from) * n / 100;
    std::complex<double> sum = 0;
    for (const auto& [cell, weight] : axis_weights(position, usable, most_cells))
      sum += weight * std::polar(1., k * (double(cell) - position));
    largest = std::max(largest, std::abs(sum - 1.));
  }
  return largest;
}

double weight_sum(const std::vector<CellWeight>& weights) {
  double sum = 0;
  for (const auto& w : weights) sum += w.weight;
  return sum;
}

TEST(AxisWeights, AreOneOnACellCentre) {
  const auto weights = axis_weights(17, everywhere);
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].cell, 17);
  EXPECT_EQ(weights[0].weight, 1);
  // A centre whose coordinate carries rounding is still a centre.
  EXPECT_EQ(axis_weights(17 - 1e-12, everywhere).size(), 1u);
  EXPECT_EQ(axis_weights(17 - 1e-6, everywhere).size(), 8u);
}

// Proves (A1).
TEST(AxisWeights, InterpolateWavesBetweenInterfaces) {
  EXPECT_LT(wave_error(20, 0, 1, everywhere), 1e-5);
  EXPECT_LT(wave_error(10, 0, 1, everywhere), 5e-5);
  EXPECT_LT(wave_error(8, 0, 1, everywhere), 1e-5);
  EXPECT_LT(wave_error(6, 0, 1, everywhere), 1e-5);
  EXPECT_LT(wave_error(5, 0, 1, everywhere), 1.2e-3);
  EXPECT_LT(wave_error(4, 0, 1, everywhere), 0.012);
}

// Proves (A1).
TEST(AxisWeights, BeatTheKaiserWindowedSincOfTheSameWidth) {
  // Half-width 4, beta 6.31, for wavelengths a survey records.
  for (const double cells : {20., 10., 8., 6.}) {
    const double k = 2 * pi / cells;
    double kaiser = 0;
    for (double x = 0.01; x < 1; x += 0.01) {
      std::complex<double> sum = 0;
      for (int i = -3; i <= 4; ++i) {
        const double d = i - x;
        sum += std::sin(pi * d) / (pi * d) * std::cyl_bessel_i(0, 6.31 * std::sqrt(1 - d * d / 16)) /
               std::cyl_bessel_i(0, 6.31) * std::polar(1., k * d);
      }
      kaiser = std::max(kaiser, std::abs(sum - 1.));
    }
    EXPECT_LT(5 * wave_error(cells, 0, 1, everywhere), kaiser) << cells;
  }
}

TEST(AxisWeights, ConvergeWithOrderFour) {
  EXPECT_GT(std::log2(wave_error(40, 0, 1, everywhere) / wave_error(80, 0, 1, everywhere)), 3.9);
}

// Proves (A1).
TEST(AxisWeights, ReproduceCubicsForAnyStencil) {
  for (const auto& usable :
       {everywhere, AxisCells{0, 1000}, AxisCells{-1000, 1}, AxisCells{-2, 2}, AxisCells{0, 3}})
    for (const double position : {0.02, 0.3, 0.5, 0.97, 1.4}) {
      const auto weights = axis_weights(position, usable);
      for (int power = 0; power <= 3; ++power) {
        double sum = 0;
        for (const auto& [cell, weight] : weights) sum += weight * std::pow(double(cell), power);
        EXPECT_NEAR(sum, std::pow(position, power), 1e-8) << position << ' ' << power;
      }
    }
}

// Proves (A2).
TEST(AxisWeights, DegradeGentlyTowardsAnInterface) {
  const AxisCells right_of{0, 1000};
  EXPECT_LT(wave_error(10, 2, 3, right_of), 1e-4);
  EXPECT_LT(wave_error(10, 1, 2, right_of), 2e-4);
  EXPECT_LT(wave_error(10, 0, 1, right_of), 6e-4);
  EXPECT_LT(wave_error(10, -0.5, 0, right_of), 6e-3);
  // The other side is the mirror image.
  const AxisCells left_of{-1000, 0};
  for (const double cells : {8., 12.})
    for (const double position : {-0.5, -0.2, 0.3, 1.8})
      EXPECT_NEAR(wave_error(cells, position, position, right_of),
                  wave_error(cells, -position, -position, left_of), 1e-9);
}

TEST(AxisWeights, TakeOnlyUsableCells) {
  for (const auto& usable :
       {AxisCells{3, 20}, AxisCells{3, 3}, AxisCells{3, 5}, AxisCells{3, 3, Beyond::odd},
        AxisCells{3, 4, Beyond::even, Beyond::odd}, AxisCells{3, 6, Beyond::unknown, Beyond::odd}})
    for (double position = double(usable.low) - 0.5; position <= double(usable.high) + 0.5;
         position += 0.0625)
      for (const auto& [cell, weight] : axis_weights(position, usable)) {
        EXPECT_GE(cell, usable.low);
        EXPECT_LE(cell, usable.high);
        EXPECT_TRUE(std::isfinite(weight));
      }
}

TEST(AxisWeights, OfOneCellAreThatCell) {
  const auto weights = axis_weights(5.3, {5, 5});
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].cell, 5);
  EXPECT_NEAR(weights[0].weight, 1, 1e-14);
}

TEST(AxisWeights, CanBeHeldToFewerCells) {
  for (const int most : {2, 4, 6}) EXPECT_EQ(axis_weights(0.3, everywhere, most).size(), std::size_t(most));
  // Two cells: straight lines.
  EXPECT_NEAR(axis_weights(0.3, everywhere, 2)[0].weight, 0.7, 1e-12);
  EXPECT_LT(wave_error(10, 0, 1, everywhere, 6), 5e-4);
  EXPECT_LT(wave_error(10, 0, 1, everywhere, 4), 5e-3);
}

// Proves (A2).
TEST(AxisWeights, FoldAtAMirrorWithTheParityOfTheField) {
  // The mirror is the face at -1/2: cos(k (x + 1/2)) is even about it, sin(k (x + 1/2)) odd.
  const double k = 2 * pi / 9;
  for (double position = -0.5; position < 4; position += 0.11) {
    double even = 0, odd = 0;
    for (const auto& [cell, weight] : axis_weights(position, {0, 1000, Beyond::even}))
      even += weight * std::cos(k * (double(cell) + 0.5));
    for (const auto& [cell, weight] : axis_weights(position, {0, 1000, Beyond::odd}))
      odd += weight * std::sin(k * (double(cell) + 0.5));
    EXPECT_NEAR(even, std::cos(k * (position + 0.5)), 5e-5) << position;
    EXPECT_NEAR(odd, std::sin(k * (position + 0.5)), 5e-5) << position;
  }
}

// Proves (A2).
TEST(AxisWeights, FoldAtBothEndsOfANarrowSpan) {
  // Three cells between two mirrors at -1/2 and 5/2: cos(pi (x + 1/2)/3) is even about both.
  for (double position = -0.5; position <= 2.5; position += 0.1) {
    double value = 0;
    for (const auto& [cell, weight] : axis_weights(position, {0, 2, Beyond::even, Beyond::even}))
      value += weight * std::cos(pi * (double(cell) + 0.5) / 3);
    EXPECT_NEAR(value, std::cos(pi * (position + 0.5) / 3), 1e-4) << position;
  }
}

// Proves (A2).
TEST(AxisWeights, VanishOnAnOddMirror) {
  const auto weights = axis_weights(-0.5, {0, 1000, Beyond::odd});
  for (const auto& [cell, weight] : weights) EXPECT_NEAR(weight, 0, 1e-9) << cell;
  EXPECT_NEAR(weight_sum(axis_weights(-0.5, {0, 1000, Beyond::even})), 1, 1e-12);
}

/// |derivative - exact|/k of exp(i k x), any phase, largest over positions from .. to.
double slope_error(double cells_per_wavelength, double from, double to, const AxisCells& usable) {
  const double k = 2 * pi / cells_per_wavelength;
  double largest = 0;
  for (int n = 0; n <= 100; ++n) {
    const double position = from + (to - from) * n / 100;
    std::complex<double> sum = 0;
    for (const auto& [cell, weight] : axis_slopes(position, usable))
      sum += weight * std::polar(1., k * (double(cell) - position));
    largest = std::max(largest, std::abs(sum / k - std::complex<double>(0, 1)));
  }
  return largest;
}

// Proves (A10).
TEST(AxisSlopes, DifferentiateWaves) {
  // The table of the header, a tenth above.
  const double cells[] = {20, 16, 10, 8, 6, 5};
  const double inside[] = {9e-5, 1.5e-4, 2.2e-4, 6e-5, 3e-5, 3.5e-3};
  const double on_last[] = {4e-3, 8e-3, 5e-2, 0.1, 0.3, 0.55}, beyond[] = {1.4e-2, 3e-2, 0.14, 0.3, 0.8, 1.5};
  for (std::size_t n = 0; n < std::size(cells); ++n) {
    EXPECT_LT(slope_error(cells[n], 0, 1, everywhere), inside[n]) << cells[n];
    EXPECT_LT(slope_error(cells[n], 0, 0, {0, 1000}), on_last[n]) << cells[n];
    EXPECT_LT(slope_error(cells[n], -0.5, -0.5, {0, 1000}), beyond[n]) << cells[n];
    // The other side is the mirror image.
    EXPECT_NEAR(slope_error(cells[n], 0.3, 0.3, {0, 1000}), slope_error(cells[n], -0.3, -0.3, {-1000, 0}),
                1e-9);
  }
}

// Proves (A10).
TEST(AxisSlopes, ReproduceCubicsForAnyStencil) {
  for (const auto& usable :
       {everywhere, AxisCells{0, 1000}, AxisCells{-1000, 1}, AxisCells{-2, 2}, AxisCells{0, 3}})
    for (const double position : {0., 0.02, 0.3, 0.5, 0.97, 1., 1.4})
      for (int power = 0; power <= 3; ++power) {
        double sum = 0;
        for (const auto& [cell, weight] : axis_slopes(position, usable))
          sum += weight * std::pow(double(cell), power);
        EXPECT_NEAR(sum, power == 0 ? 0 : power * std::pow(position, power - 1), 1e-8)
            << position << ' ' << power;
      }
}

TEST(AxisSlopes, FoldAtAMirrorAndVanishInOneCell) {
  const double k = 2 * pi / 9;
  for (double position = -0.5; position < 4; position += 0.11) {
    double even = 0;
    for (const auto& [cell, weight] : axis_slopes(position, {0, 1000, Beyond::even}))
      even += weight * std::cos(k * (double(cell) + 0.5));
    EXPECT_NEAR(even / k, -std::sin(k * (position + 0.5)), 3e-4) << position;
  }
  EXPECT_TRUE(axis_slopes(5.3, {5, 5}).empty());
}

// Proves (A1).
TEST(PointWeights, SampleAPlaneWaveAnywhereInTheGrid) {
  const Grid<2> grid{{100, 80}, 5, {-20, 0}};
  const double k = 2 * pi / (8 * 5);  // 8 cells per wavelength
  for (const double angle : {0., 0.4, 1.1})
    for (const auto& at :
         {Point<2>{203.1, 177.7}, Point<2>{202.5, 178.9}, Point<2>{-20, 0}, Point<2>{480, 400}}) {
      const auto phase = [&](double x, double z) { return k * (x * std::cos(angle) + z * std::sin(angle)); };
      std::complex<double> sum = 0;
      for (const auto& [cell, weight] : point_weights<2>(grid, at, {{{0, 99}, {0, 79}}}))
        sum += weight *
               std::polar(1., phase(grid.centre(0, cell[0]), grid.centre(1, cell[1])) - phase(at[0], at[1]));
      const bool corner = at[0] == -20 || at[0] == 480;
      EXPECT_LT(std::abs(sum - 1.), corner ? 2e-2 : 2e-3) << at[0] << ' ' << at[1];
    }
}

TEST(PointWeights, AreOneCellInTheMiddleOfIt) {
  const Grid<3> grid{{10, 10, 10}, 2, {}};
  const auto weights = point_weights<3>(grid, {7, 9, 11}, {{{0, 9}, {0, 9}, {0, 9}}});
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].cell, (Index<3>{3, 4, 5}));
  EXPECT_EQ(weights[0].weight, 1);
}

// Proves (A4).
TEST(PointWeights, HaveTheMomentsOfAPointSource) {
  // Spread with these weights a source keeps its strength and place: sum 1, centre of mass at the point, no
  // spread.
  const Grid<2> grid{{40, 40}, 10, {}};
  const Point<2> at{171.7, 203.2};
  double sum = 0, x = 0, z = 0, xx = 0, xz = 0;
  for (const auto& [cell, weight] : point_weights<2>(grid, at, {{{0, 39}, {0, 39}}})) {
    const double dx = grid.centre(0, cell[0]) - at[0], dz = grid.centre(1, cell[1]) - at[1];
    sum += weight, x += weight * dx, z += weight * dz, xx += weight * dx * dx, xz += weight * dx * dz;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(x, 0, 1e-9);
  EXPECT_NEAR(z, 0, 1e-9);
  EXPECT_NEAR(xx, 0, 1e-8);
  EXPECT_NEAR(xz, 0, 1e-8);
}

/// |sum of the weights times exp(i k x)|, less `wanted`, largest over positions in a cell.
double spread_error(double cells_per_wavelength, double wanted, Moment moment = Moment::passing) {
  const double k = 2 * pi / cells_per_wavelength;
  double largest = 0;
  for (int n = 0; n <= 50; ++n) {
    const double position = n / 50.;
    std::complex<double> sum = 0;
    for (const auto& [cell, weight] : spread_weights(position, everywhere, moment))
      sum += weight * std::polar(1., k * (double(cell) - position));
    largest = std::max(largest, std::abs(sum - wanted));
  }
  return largest;
}

// Proves (A8).
TEST(SpreadWeights, KeepLongWavesAndSuppressShortOnes) {
  for (const auto& [cells, bound] :
       {std::pair(24., 5e-5), {15., 6e-4}, {12., 2e-3}, {10., 4e-3}, {8., 6e-3}, {6., 0.03}})
    EXPECT_LT(spread_error(cells, 1), bound) << cells;
  for (const auto& [cells, bound] : {std::pair(3., 0.04), {2.8, 0.01}, {2.4, 0.01}, {2., 0.01}})
    EXPECT_LT(spread_error(cells, 0), bound) << cells;
}

// Proves (A8a).
TEST(SpreadWeights, OfALastingMomentSuppressWavesShorterThanFiveCells) {
  for (const auto& [cells, bound] :
       {std::pair(24., 8e-4), {16., 3e-3}, {12., 0.015}, {10., 0.075}, {8., 0.32}})
    EXPECT_LT(spread_error(cells, 1, Moment::lasting), bound) << cells;
  for (const double cells : {5., 4., 3., 2.4, 2.})
    EXPECT_LT(spread_error(cells, 0, Moment::lasting), 0.025) << cells;
}

// Proves (A8).
TEST(SpreadWeights, HaveTheMomentsOfAPointSource) {
  // Among many cells, beside the last one, in a span of the fewest, and with images beyond a mirror.
  for (const auto& [usable, degree] : {std::pair(AxisCells{-50, 50}, 5), {{0, 50}, 3}, {{-4, 3}, 3}})
    for (const auto& [position, moment] : {std::pair(-0.5, Moment::passing),
                                           {-0.2, Moment::lasting},
                                           {0., Moment::passing},
                                           {0.3, Moment::lasting},
                                           {2.9, Moment::lasting}}) {
      const auto weights = spread_weights(position, usable, moment);
      EXPECT_LE(weights.size(), std::size_t(widest_spread(moment)));
      for (int power = 0; power <= degree; ++power) {
        double sum = 0;
        for (const auto& [cell, weight] : weights) {
          EXPECT_GE(cell, usable.low);
          EXPECT_LE(cell, usable.high);
          sum += weight * std::pow(double(cell) - position, power);
        }
        EXPECT_NEAR(sum, power == 0, 1e-8) << position << ", degree " << power;
      }
    }
  double sum = 0;
  for (const auto& weight : spread_weights(1.3, {0, 50, Beyond::even})) sum += weight.weight;
  EXPECT_NEAR(sum, 1, 1e-12);
}

// Proves (A3).
TEST(TimeWeights, ReproducePolynomialsOfDegreeSevenEverywhere) {
  for (double position = 0; position <= 20; position += 0.173) {
    const auto [first, count, weights] = time_weights(position, 0, 20);
    for (int power = 0; power <= 7; ++power) {
      double sum = 0;
      for (int i = 0; i < count; ++i) sum += weights[i] * std::pow((double(first + i) - 10) / 10, power);
      EXPECT_NEAR(sum, std::pow((position - 10) / 10, power), 1e-11) << position << ' ' << power;
    }
  }
}

TEST(TimeWeights, AreOneOnASampleAndStayInside) {
  const auto on = time_weights(5, 0, 20);
  EXPECT_EQ(on.first, 5);
  EXPECT_EQ(on.count, 1);
  EXPECT_EQ(on.weights[0], 1);
  EXPECT_EQ(time_weights(7.5, 0, 20).first, 4);  // four on each side
  for (double position = 0; position <= 3; position += 0.1) {
    const auto few = time_weights(position, 0, 3);
    EXPECT_GE(few.first, 0);
    EXPECT_LE(few.first + few.count, 4);
  }
}

// Proves (A3).
TEST(TimeWeights, ConvergeWithOrderEight) {
  const auto error = [](double samples_a_period) {
    const double w = 2 * pi / samples_a_period;
    double largest = 0;
    for (double position = 100; position < 101; position += 0.01) {
      const auto [first, count, weights] = time_weights(position, 0, 1000);
      std::complex<double> sum = 0;
      for (int i = 0; i < count; ++i) sum += weights[i] * std::polar(1., w * (double(first + i) - position));
      largest = std::max(largest, std::abs(sum - 1.));
    }
    return largest;
  };
  EXPECT_NEAR(std::log2(error(10) / error(20)), 8, 0.2);
  EXPECT_LT(error(10), 3e-5);
}

// Proves (A9).
TEST(TimeWeights, DifferentiateAndIntegratePolynomialsOfDegreeSeven) {
  const auto applied = [](const TimeWeights& weights, int power) {
    double sum = 0;
    for (int n = 0; n < weights.count; ++n)
      sum += weights.weights[std::size_t(n)] * std::pow(double(weights.first + n) / 8, power);
    return sum;
  };
  for (const double at : {4., 4.3, 4.99, 7.7})
    for (int power = 0; power <= 7; ++power) {
      const double slope = power == 0 ? 0 : power * std::pow(at / 8, power - 1) / 8;
      EXPECT_NEAR(applied(time_slopes(at, 0, 12), power), slope, 1e-11) << at << ' ' << power;
      const double from = std::floor(at);
      EXPECT_NEAR(applied(time_integrals(from, at, 0, 12), power),
                  8 * (std::pow(at / 8, power + 1) - std::pow(from / 8, power + 1)) / (power + 1), 1e-11)
          << at << ' ' << power;
    }
}

}  // namespace
}  // namespace slipwave::acquisition_interpolation_test
